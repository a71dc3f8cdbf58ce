// Which marcher, and how it goes.
#pragma once

#include <cstdint>

namespace hybray::ssrm {

enum class Marcher : uint8_t {
  paper,  // of the SSRM paper (march_paper.h)
  plane,  // pixels and cells as slanted planes (march_plane.h)
};

// Scalar code, the reference; or vector lanes, which give the same verdicts, pixels and steps on every
// instruction set.
enum class MarchCode : uint8_t { scalar, lanes };

// When a march goes a level up.
enum class Ascent : uint8_t {
  iteration,  // after an iteration without intersection (the paper)
  parent,     // where it leaves the cell of that level
};

// Depth samples in one iteration, between changes of level: the paper's balance of arithmetic against memory.
inline constexpr int kSamplesPerIteration = 4;

struct MarchOptions {
  uint64_t step_budget = 0;  // depth samples a ray may read; 0 = as many as it needs (it always ends)
  MarchCode code = MarchCode::scalar;
  Marcher marcher = Marcher::paper;
  bool correct = true;  // false: a ray that stops is left at `correction`, with the pixel that stopped it
  Ascent ascent = Ascent::parent;  // of marcher `plane`; the paper's goes by iterations
};

}  // namespace hybray::ssrm
