// Which rays are worth a march: those with little chance of a HIT go straight to the general tracer. It
// changes time and alpha, never the verdict of a ray that is marched.
//
// One ray of each block of 4x4 pixels is marched first. The chance of the others is estimated for the block
// as a whole, which costs next to nothing: from the samples in and around it, from rays that run like its own
// (toward the viewer or away, with a long or a short way to the screen's edge), and from what the same part
// of the screen saw in the frame before. A march pays where the trace that it may save costs more than
// itself: chance * T_HW > T_SS.
#pragma once

#include "core/ssrm/march.h"

#include <span>
#include <vector>

namespace hybray::ssrm {

inline constexpr int kSampleBlock = 4;   // pixels along a side, one sampled ray in each
inline constexpr int kHistoryTile = 16;  // pixels along a side

struct PredictorOptions {
  double march_cost = 0.3;  // T_SS / T_HW of a ray: the chance of a HIT from which on it is marched
  bool by_direction = true;
  double prior_weight = 0.25;  // samples that the estimate by direction, or by history, counts as
};

// HIT shares by tile of the frame before; empty where there was none.
struct TileHistory {
  int width = 0;              // tiles
  std::vector<float> chance;  // [0, 1]; negative: no ray started there
};
TileHistory tile_history(const MarchResults& results, const std::vector<uint32_t>& pixels, int width,
                         int height);

// Lists that a prediction fills, kept between runs.
struct Prediction {
  std::vector<uint32_t> sample;      // marched to learn from
  std::vector<uint32_t> worthwhile;  // further rays to march
  std::vector<uint8_t> blocks;       // of each block: state of its sample,
  std::vector<uint8_t> classes;      // its class,
  std::vector<uint8_t> worth;        // and whether its other rays are worth a march
  std::vector<uint32_t> scratch;
  size_t marched() const { return sample.size() + worthwhile.size(); }
};

// The sampled rays, in order: those at the second pixel of the second row of their block.
void choose_sample(const std::vector<uint32_t>& pixels, int width, int height, Prediction& prediction);

// From the samples' verdicts in `results`: which of the others to march. Rays that are not marched get
// Verdict::budget there: a budget of no step at all. Where a block has no sample, its neighbours' stand in;
// where nothing is known, its rays are marched.
void predict(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
             const PredictorOptions& options, const TileHistory& history, MarchResults& results,
             Prediction& prediction);

// Sample, prediction and the march of what is worth it.
void march_predicted(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                     const MarchOptions& march, const PredictorOptions& options, const TileHistory& history,
                     MarchResults& results, Prediction& prediction);

}  // namespace hybray::ssrm
