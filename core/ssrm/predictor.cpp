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

using Chances = std::array<float, kClasses>;
Chances chances_by_class(const ScreenRays& rays, const MarchResults& results, const Prediction& p, int width,
                         int height) {
  std::array<uint32_t, kClasses> hits{}, all{};
  for (const uint32_t i : p.sample) {
    const size_t c = class_of(rays, i, width, height);
    ++all[c];
    hits[c] += results.verdict[i] == Verdict::hit;
  }
  Chances chances{};
  for (size_t c = 0; c < kClasses; ++c)
    chances[c] = (static_cast<float>(hits[c]) + 0.5f) / (static_cast<float>(all[c]) + 1.0f);
  return chances;
}

// Sum of bilinear weights of the samples around a pixel, and of those that hit.
struct Around {
  float weight = 0.0f, hits = 0.0f;
};
Around samples_around(const Prediction& p, int x, int y, int across, int down) {
  // In blocks, from the place of a block's sample.
  const float fx = (static_cast<float>(x) - 1.0f) / kSampleBlock,
              fy = (static_cast<float>(y) - 1.0f) / kSampleBlock;
  const int bx = static_cast<int>(std::floor(fx)), by = static_cast<int>(std::floor(fy));
  const float ax = fx - static_cast<float>(bx), ay = fy - static_cast<float>(by);
  Around a;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const int cx = bx + i, cy = by + j;
      if (cx < 0 || cy < 0 || cx >= across || cy >= down) continue;
      const uint8_t state =
          p.blocks[static_cast<size_t>(cy) * static_cast<size_t>(across) + static_cast<size_t>(cx)];
      if (state == kNoSample) continue;
      const float w = (i ? ax : 1.0f - ax) * (j ? ay : 1.0f - ay);
      a.weight += w;
      if (state == kHit) a.hits += w;
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
  const auto w32 = static_cast<uint32_t>(width);
  for (const uint32_t i : p.sample) {
    const uint32_t x = pixels[i] % w32 / kSampleBlock, y = pixels[i] / w32 / kSampleBlock;
    p.blocks[y * static_cast<size_t>(across) + x] = results.verdict[i] == Verdict::hit ? kHit : kNoHit;
  }
  const Chances by_class = chances_by_class(rays, results, p, width, height);
  const auto prior_weight = static_cast<float>(options.prior_weight),
             least = static_cast<float>(options.march_cost);
  const auto worthwhile = [&](uint32_t i, int x, int y) {
    const Around a = samples_around(p, x, y, across, down);
    float weight = a.weight, hits = a.hits;
    if (options.by_direction || a.weight == 0.0f) {
      weight += prior_weight;
      hits += prior_weight * by_class[class_of(rays, i, width, height)];
    }
    if (!history.chance.empty()) {
      const float chance =
          history.chance[static_cast<size_t>(y / kHistoryTile) * static_cast<size_t>(history.width) +
                         static_cast<size_t>(x / kHistoryTile)];
      if (chance >= 0.0f) weight += prior_weight, hits += prior_weight * chance;
    }
    return hits >= least * weight;
  };
  const PixelPlace place(width);
  const auto wanted = [&](size_t i) {
    const ivec2 at = place(pixels[i]);
    if (is_sampled(at)) return false;
    if (worthwhile(static_cast<uint32_t>(i), at.x, at.y)) return true;
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
