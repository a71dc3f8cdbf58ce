// What the marchers in vector lanes share (march_wave-inl.h has the code): rays of one block in waves. A wave
// moves every ray by some steps, and those that have ended drop out of the next, so that few lanes idle.
#pragma once

#include "core/base/check.h"
#include "core/ssrm/march_options.h"
#include "core/ssrm/ray_choice.h"
#include "core/ssrm/screen_rays.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hybray::ssrm {

struct MarchWave {
  static constexpr size_t kSize = 2048, kAllocated = kSize + 64;
  template <class T>
  using Lanes = std::array<T, kAllocated>;

  // Rays under way. ix, iy: inverse directions; l_end: not beyond the screen's edge; x, y: cell of the level;
  // samples: of this iteration; taken: of a budget.
  alignas(64) Lanes<float> ox, oy, oz, dx, dy, dz, ix, iy, l_end, l;
  alignas(64) Lanes<int32_t> x, y, level, samples, taken;
  alignas(64) Lanes<uint32_t> ray;
  size_t count = 0;

  // Rays that left the wave, with what became of them. l: L up to which the ray was followed.
  struct Ended {
    alignas(64) Lanes<uint32_t> ray;
    alignas(64) Lanes<int32_t> how, x, y, samples, taken;
    alignas(64) Lanes<float> l;
    size_t count = 0;
  } ended;
};

// How a march in lanes ended: at l_end, out of budget, or at a pixel whose stored depth the ray may be
// behind. Marchers replace `stopped` by what a closer look finds.
enum WaveEnd : int32_t { kAtEnd, kOutOfBudget, kStopped, kHit, kBehind, kFailed, kCleared };

constexpr size_t kMostLevels = 16;  // as many as a vector of the widest machine holds
using LevelTable = std::array<int32_t, kMostLevels>;

struct WaveJob {
  const ScreenRays& rays;
  const std::vector<uint32_t>& pixels;
  RayChoice choice;
  int32_t width, height, levels;
  int32_t step_budget;  // 0: none
  Ascent ascent;
  bool correct;
  alignas(64) LevelTable first_texel{}, row{};  // of each level; row: texels from one row to the next

  // No ray takes that many samples.
  static constexpr uint64_t kUnlimited = uint64_t{1} << 30;
  template <class Pyramid>
  WaveJob(const ScreenRays& r, const std::vector<uint32_t>& p, const RayChoice& c, const Pyramid& pyramid,
          const MarchOptions& options)
      : rays(r),
        pixels(p),
        choice(c),
        width(pyramid.width()),
        height(pyramid.height()),
        levels(pyramid.levels()),
        step_budget(options.step_budget < kUnlimited ? static_cast<int32_t>(options.step_budget) : 0),
        ascent(options.ascent),
        correct(options.correct) {
    HYBRAY_CHECK_LE(static_cast<size_t>(levels), kMostLevels);
    for (int level = 0; level < levels; ++level) {
      first_texel[static_cast<size_t>(level)] = static_cast<int32_t>(pyramid.first_texel(level));
      row[static_cast<size_t>(level)] = pyramid.row_length(level);
    }
  }
};

// Writes what became of the rays of `ended`, each at its own place; returns how many of them are kCleared,
// whose results are still to come. `width` of the screen.
size_t write_results(const ScreenRays& rays, int width, const MarchWave::Ended& ended, MarchResults& results);

// Marches the chosen rays of `job` in blocks, all threads: `block` leaves those of the parts from begin on
// and before end in wave.ended, writes their results, and returns the samples read, whose sum this returns.
uint64_t march_in_blocks(const WaveJob& job,
                         const std::function<uint64_t(size_t begin, size_t end, MarchWave& wave)>& block);

}  // namespace hybray::ssrm
