#include "core/ssrm/predictor.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybray::ssrm {
namespace {

enum BlockState : uint8_t { kNoSample, kNoHit, kHit };

int blocks_across(int pixels) {
  return (pixels + kSampleBlock - 1) / kSampleBlock;
}

// Row and column of a pixel, without a division.
class PixelPlace {
 public:
  explicit PixelPlace(int width) : width_(width), inverse_(1.0 / width) {}
  ivec2 operator()(uint32_t pixel) const {
    // Exact: a half is further from the next whole row than rounding reaches.
    const int row = static_cast<int>((static_cast<double>(pixel) + 0.5) * inverse_);
    return {static_cast<int>(pixel) - row * width_, row};
  }

 private:
  int width_;
  double inverse_;
};

bool is_sampled(ivec2 at) {
  return at.x % kSampleBlock == 1 && at.y % kSampleBlock == 1;
}

// The numbers below n that `wanted` keeps, in order at any number of threads. `scratch` is kept between
// calls.
template <class Wanted>
void list_where(size_t n, const Wanted& wanted, std::vector<uint32_t>& scratch, std::vector<uint32_t>& list) {
  constexpr size_t kBlock = 16384;
  std::vector<size_t> first((n + kBlock - 1) / kBlock + 1, 0);
  scratch.resize(n);
  parallel_blocks(n, kBlock, [&](size_t begin, size_t end) {
    size_t count = 0;
    for (size_t i = begin; i < end; ++i) {
      scratch[begin + count] = static_cast<uint32_t>(i);
      count += wanted(i);
    }
    first[begin / kBlock + 1] = count;
  });
  for (size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
  list.resize(first.back());
  parallel_blocks(n, kBlock, [&](size_t begin, size_t) {
    const size_t b = begin / kBlock;
    std::copy_n(scratch.data() + begin, first[b + 1] - first[b], list.data() + first[b]);
  });
}

// Rays that run alike: by the pixels that they cross until they leave the screen, and by whether they come
// nearer to the viewer.
constexpr size_t kClasses = 16;
size_t class_of(const ScreenRays& rays, size_t i, int width, int height) {
  const auto way = [](float origin, float direction, int size) {
    return ((direction > 0.0f ? static_cast<float>(size) : 0.0f) - origin) / direction;
  };
  const float l = std::min({way(rays.ox[i], rays.dx[i], width), way(rays.oy[i], rays.dy[i], height),
                            std::max(rays.l_end[i], 0.0f)});
  const float crossed = l * std::max(std::abs(rays.dx[i]), std::abs(rays.dy[i]));
  const float share = crossed / static_cast<float>(std::max(width, height));
  const size_t length = share < 0.02f ? 0 : share < 0.06f ? 1 : share < 0.2f ? 2 : 3;
  // March depth at the end of that way relative to that of the origin: 1/w falls or grows.
  const size_t depth = rays.end[i] == Verdict::viewer ? 0
                       : rays.dz[i] < 0.0f            ? 1
                       : rays.end[i] == Verdict::miss ? 2
                                                      : 3;
  return 4 * depth + length;
}

// Share of HITs among the sampled rays of each class.
using Chances = std::array<float, kClasses>;
Chances chances_by_class(const Prediction& p) {
  std::array<uint32_t, kClasses> hits{}, all{};
  for (size_t b = 0; b < p.blocks.size(); ++b) {
    if (p.blocks[b] == kNoSample) continue;
    ++all[p.classes[b]];
    hits[p.classes[b]] += p.blocks[b] == kHit;
  }
  Chances chances{};
  for (size_t c = 0; c < kClasses; ++c)
    chances[c] = (static_cast<float>(hits[c]) + 0.5f) / (static_cast<float>(all[c]) + 1.0f);
  return chances;
}

// Weights of the samples in a block and its eight neighbours, and of those that hit.
struct Around {
  float weight = 0.0f, hits = 0.0f;
};
Around samples_around(const Prediction& p, int bx, int by, int across, int down) {
  constexpr float kWeights[3] = {0.5f, 1.0f, 0.5f};
  Around a;
  for (int y = std::max(0, by - 1); y <= std::min(down - 1, by + 1); ++y)
    for (int x = std::max(0, bx - 1); x <= std::min(across - 1, bx + 1); ++x) {
      const uint8_t state =
          p.blocks[static_cast<size_t>(y) * static_cast<size_t>(across) + static_cast<size_t>(x)];
      const float w = state == kNoSample ? 0.0f : kWeights[x - bx + 1] * kWeights[y - by + 1];
      a.weight += w;
      a.hits += state == kHit ? w : 0.0f;
    }
  return a;
}

}  // namespace

TileHistory tile_history(const MarchResults& results, const std::vector<uint32_t>& pixels, int width,
                         int height) {
  const auto tiles = [](int n) { return (n + kHistoryTile - 1) / kHistoryTile; };
  TileHistory h{tiles(width), {}};
  std::vector<uint32_t> all(static_cast<size_t>(tiles(width)) * static_cast<size_t>(tiles(height))),
      hits(all.size());
  for (size_t i = 0; i < pixels.size(); ++i) {
    const uint32_t x = pixels[i] % static_cast<uint32_t>(width), y = pixels[i] / static_cast<uint32_t>(width);
    const size_t tile = (y / kHistoryTile) * static_cast<size_t>(h.width) + x / kHistoryTile;
    ++all[tile];
    hits[tile] += results.verdict[i] == Verdict::hit;
  }
  h.chance.resize(all.size());
  for (size_t t = 0; t < all.size(); ++t)
    h.chance[t] = all[t] ? static_cast<float>(hits[t]) / static_cast<float>(all[t]) : -1.0f;
  return h;
}

void choose_sample(const std::vector<uint32_t>& pixels, int width, int height, Prediction& p) {
  p.blocks.assign(static_cast<size_t>(blocks_across(width)) * static_cast<size_t>(blocks_across(height)),
                  kNoSample);
  const PixelPlace place(width);
  list_where(
      pixels.size(), [&](size_t i) { return is_sampled(place(pixels[i])); }, p.scratch, p.sample);
}

void predict(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
             const PredictorOptions& options, const TileHistory& history, MarchResults& results,
             Prediction& p) {
  const int width = view.width(), height = view.height(), across = blocks_across(width),
            down = blocks_across(height);
  const PixelPlace place(width);
  const auto block_of = [&](ivec2 at) {
    return static_cast<size_t>(at.y / kSampleBlock) * static_cast<size_t>(across) +
           static_cast<size_t>(at.x / kSampleBlock);
  };
  p.classes.resize(p.blocks.size());
  p.worth.resize(p.blocks.size());
  parallel_blocks(p.sample.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t j = begin; j < end; ++j) {
      const uint32_t i = p.sample[j];
      const size_t block = block_of(place(pixels[i]));
      p.blocks[block] = results.verdict[i] == Verdict::hit ? kHit : kNoHit;
      p.classes[block] = static_cast<uint8_t>(class_of(rays, i, width, height));
    }
  });
  const Chances by_class = chances_by_class(p);
  const auto prior_weight = static_cast<float>(options.prior_weight),
             least = static_cast<float>(options.march_cost);
  parallel_blocks(static_cast<size_t>(down), 8, [&](size_t begin, size_t end) {
    for (int by = static_cast<int>(begin); by < static_cast<int>(end); ++by)
      for (int bx = 0; bx < across; ++bx) {
        const size_t block = block_of({bx * kSampleBlock, by * kSampleBlock});
        auto [weight, hits] = samples_around(p, bx, by, across, down);
        if (options.by_direction && p.blocks[block] != kNoSample)
          weight += prior_weight, hits += prior_weight * by_class[p.classes[block]];
        if (!history.chance.empty()) {
          constexpr int kBlocks = kHistoryTile / kSampleBlock;
          const float chance =
              history.chance[static_cast<size_t>(by / kBlocks) * static_cast<size_t>(history.width) +
                             static_cast<size_t>(bx / kBlocks)];
          if (chance >= 0.0f) weight += prior_weight, hits += prior_weight * chance;
        }
        // Where nothing is known, a march finds out.
        p.worth[block] = hits >= least * weight;
      }
  });
  const auto wanted = [&](size_t i) {
    const ivec2 at = place(pixels[i]);
    if (is_sampled(at)) return false;
    if (p.worth[block_of(at)]) return true;
    results.verdict[i] = Verdict::budget;
    results.pixel[i] = kNoPixel;
    return false;
  };
  list_where(pixels.size(), wanted, p.scratch, p.worthwhile);
}

void march_predicted(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                     const MarchOptions& march, const PredictorOptions& options, const TileHistory& history,
                     MarchResults& results, Prediction& prediction) {
  choose_sample(pixels, view.width(), view.height(), prediction);
  march_some(view, rays, pixels, prediction.sample, march, results);
  const uint64_t sample_steps = results.steps;
  predict(view, rays, pixels, options, history, results, prediction);
  march_some(view, rays, pixels, prediction.worthwhile, march, results);
  results.steps += sample_steps;
}

}  // namespace hybray::ssrm
