// The chance that a march ends as HIT, by blocks of 8x8 pixels: as marches have found it, and looked up from
// another view.
#pragma once

#include "core/gbuffer/view.h"

#include <limits>
#include <optional>
#include <vector>

namespace hybray::ssrm {

class BlockChances {
 public:
  static constexpr int kSide = 8;          // pixels
  static constexpr uint32_t kWhole = 255;  // chances are given in parts of it
  static constexpr float kUnknown = -1.0f;

  // Nothing is known of a screen of that many pixels.
  void reset(int width, int height);

  // One more chance, `part` / kWhole, for the block of pixel (x, y), that counts `weight` times. From any
  // threads.
  void add(int x, int y, uint32_t part, uint32_t weight);

  // To be called once all is added: what around() answers from.
  void spread();

  // Chance around a point of the screen, [0, 1]: mean over its block, those beside it (which count half) and
  // diagonal to it (a quarter). kUnknown where nothing was added, and off the screen.
  float around(float x, float y) const {
    if (!(x >= 0.0f && x < width_ && y >= 0.0f && y < height_)) return kUnknown;
    return around_[block(static_cast<int>(x) / kSide, static_cast<int>(y) / kSide)];
  }

 private:
  // Cells of a row, with one beyond each end that stays empty; so do the rows above and below.
  size_t row() const { return static_cast<size_t>(across_) + 2; }
  size_t block(int bx, int by) const {
    return static_cast<size_t>(by + 1) * row() + static_cast<size_t>(bx + 1);
  }

  float width_ = 0.0f, height_ = 0.0f;
  int across_ = 0, down_ = 0;
  // Weighted sum of parts, and from bit 40 on the sum of weights: integers, so that the order in which
  // threads add does not show.
  std::vector<uint64_t> cells_;
  std::vector<float> around_;
};

// Where points of one view are on the screen of another: reverse reprojection (Nehab et al., "Accelerating
// Real-Time Shading with Reverse Reprojection Caching", Graphics Hardware 2007). Device depth is affine in
// 1/w, so that screen place and depth together map by one projective matrix.
class Reprojection {
 public:
  Reprojection(const View& from, const View& to);

  // Of screen point (x, y) with device depth `depth`, to some 1e-6 of the screen's size; not finite, or off
  // the screen, if it lies behind the other eye.
  vec2 operator()(float x, float y, float depth) const {
    const vec3 p = base_ + x * by_x_ + y * by_y_ + depth * by_depth_;
    const float scale = p.z > 0.0f ? 1.0f / p.z : std::numeric_limits<float>::infinity();
    return {p.x * scale, p.y * scale};
  }

 private:
  vec3 base_, by_x_, by_y_, by_depth_;
};

// What the frames of a camera path have found so far.
struct ChanceHistory {
  std::optional<View> view;  // of the last frame; none: there was no frame
  size_t frames = 0;
  BlockChances chances;  // on that frame's screen
};

}  // namespace hybray::ssrm
