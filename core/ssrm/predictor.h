// Which rays are worth a march: those with little chance of a HIT go straight to the general tracer. It
// changes time and alpha, never the verdict of a ray that is marched.
//
// Rays are taken or left in runs of the stream (ray_choice.h), which costs nothing: no list of rays is made
// and none is gathered. Mirror rays of a covered block of 8x8 pixels are one run. The chance of a run is
// estimated from rays sampled in this frame, or from what the frames before found there (block_chances.h).
#pragma once

#include "core/ssrm/block_chances.h"
#include "core/ssrm/march.h"

#include <vector>

namespace hybray::ssrm {

// n / (c - m + n): the least chance of a HIT that pays for a march, where c is the time of tracing a ray that
// SSRM would resolve, m of marching it, and n of marching one that it would not: chance * (c - m) > (1 -
// chance) * n. Infinite where a march costs no less than the trace.
double least_chance(double trace_of_hit, double march_of_hit, double march_of_other);

struct MarchInput {
  const DepthView& depth;
  const ScreenRays& rays;
  const std::vector<uint32_t>& pixels;
  MarchOptions options;
};

// What a prediction fills, kept between frames.
struct Prediction {
  std::vector<uint32_t> runs;    // all of whose rays are marched, in order
  std::vector<uint32_t> sample;  // rays marched to learn from
  size_t marched = 0;            // rays, sampled ones included
  std::vector<float> chance;     // of each run
  std::vector<ivec2> start;      // of each run: the pixel of its sampled ray
  BlockChances found;            // by the sample
  std::vector<uint32_t> scratch;
};

// In each of the following the rays that are not marched get Verdict::budget: a budget of no step at all. A
// `least` above 1 leaves all.

// Marches the rays of runs with worth[run] != 0.
void march_runs(const MarchInput& input, const std::vector<uint8_t>& worth, MarchResults& results,
                Prediction& prediction);

// Marches one ray of each run, then the others of the runs around whose block of pixels at least the share
// `least` of the sampled rays hit.
void march_by_sample(const MarchInput& input, double least, MarchResults& results, Prediction& prediction);

// Marches the runs that the frames before give a chance of at least `least`, those of which they know
// nothing, and one in kExplore of the others, in turn from frame to frame. Then the history knows this frame
// too, seen by `view`; where it did not march, it keeps what it believed.
inline constexpr size_t kExplore = 32;
void march_by_history(const MarchInput& input, const View& view, double least, ChanceHistory& history,
                      MarchResults& results, Prediction& prediction);

}  // namespace hybray::ssrm
