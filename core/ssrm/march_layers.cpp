#include "core/ssrm/march_layers.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/ssrm/cell_walk.h"
#include "core/ssrm/march_options.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

namespace hybray::ssrm {
namespace {

// A layer next to a ray's slot, in one pixel.
struct Side {
  int layer = -1;  // none
  uint32_t primitive = kNoPrimitive;
  PixelPlane plane{};
  PlaneGap gap{};

  bool exists() const { return layer >= 0; }
  double slopes() const { return std::abs(plane.slope_x) + std::abs(plane.slope_y); }
};

// Where a ray is among the layers of a pixel: behind `front`, in front of `back`.
struct Slot {
  int count = 0;       // layers in front of the ray
  bool sorted = true;  // no layer behind `back` is in front of the ray
  Side front, back;
};

bool may_be_one_surface(const Side& front, const Side& back, double l) {
  if (front.primitive == back.primitive) return true;
  const double apart = front.gap.at(l) - back.gap.at(l);
  return apart < kContinuation * 0.5 * (front.slopes() + back.slopes());
}

// Whether a ray that was in `before` and, across the border at l, is in `now` has crossed nothing: a surface
// that it was in front of does not go on as one that it is behind, nor the other way round.
bool goes_on(const Slot& before, const Slot& now, double l) {
  if (now.front.exists() && before.back.exists() && may_be_one_surface(now.front, before.back, l))
    return false;
  return !(now.back.exists() && before.front.exists() && may_be_one_surface(before.front, now.back, l));
}

class LayerMarch {
 public:
  LayerMarch(const LayeredView& view, const ScreenRay<float>& ray, uint32_t pixel,
             const LayerOptions& options, uint64_t& steps)
      : view_(view),
        ray_(ray),
        exact_{ray.ox, ray.oy, ray.oz, ray.dx, ray.dy, ray.dz, ray.l_end, ray.end},
        origin_(static_cast<int>(pixel % static_cast<uint32_t>(view.first.width())),
                static_cast<int>(pixel / static_cast<uint32_t>(view.first.width()))),
        options_(options),
        steps_(steps),
        walk_(ray, view.first.width(), view.first.height(), origin_.x, origin_.y) {}

  LayerHit march() {
    if (const auto end = step_pixel()) return *end;
    for (bool late = false;; late = true) {
      if (const auto end = to_first_stop()) return *end;
      const ivec2 previous = walk_.previous();
      const Correction c = correct(view_.first, exact_, {walk_.px, walk_.py}, previous, origin_);
      if (c.verdict == Verdict::hit) return {c.verdict, c.pixel, 0, late};
      if (c.verdict == Verdict::correction) {
        if (!options_.march_on) return {c.verdict};
        if (const auto end = step_pixel()) return *end;
      } else {
        if (view_.count() == 1) return {c.verdict};
        if (const auto end = behind(slot_in_front(previous))) return *end;
      }
    }
  }

 private:
  size_t index(ivec2 p) const {
    return static_cast<size_t>(p.y) * static_cast<size_t>(view_.first.width()) + static_cast<size_t>(p.x);
  }

  // To the next pixel, unless the ray ends before.
  std::optional<LayerHit> step_pixel() {
    const auto exit = walk_.exit(0);
    if (ray_.l_end <= exit.l()) return LayerHit{ray_.end};
    if (!walk_.advance(exit)) return LayerHit{Verdict::offscreen};
    return std::nullopt;
  }

  // The paper's march, to the first pixel whose stored depth the ray gets behind.
  std::optional<LayerHit> to_first_stop() {
    const DepthPyramid& pyramid = view_.first.pyramid;
    const int top = pyramid.levels() - 1;
    for (int level = 0;;) {
      bool intersects = false;
      for (int sample = 0; sample < kSamplesPerIteration && !intersects; ++sample) {
        ++steps_;
        const auto exit = walk_.exit(level);
        const bool ends = ray_.l_end <= exit.l();
        const float leave = ends ? ray_.l_end : exit.l();
        const float farthest = std::max(ray_.rise(walk_.l), ray_.rise(leave));
        if (farthest > pyramid.at(level, walk_.px >> level, walk_.py >> level) - ray_.oz) {
          intersects = true;
        } else {
          if (ends) return LayerHit{ray_.end};
          if (!walk_.advance(exit)) return LayerHit{Verdict::offscreen};
        }
      }
      if (!intersects)
        level = std::min(level + 1, top);
      else if (level > 0)
        walk_.descend(level--);
      else
        return std::nullopt;
    }
  }

  Side side(ivec2 p, int layer) {
    ++steps_;
    const PixelPlane plane = view_.plane(layer, p.x, p.y);
    return {layer, view_.primitive_of(layer, index(p)), plane, plane_gap(plane, exact_, p.x, p.y)};
  }

  Slot slot_in_front(ivec2 p) {
    Slot slot;
    if (view_.has(0, index(p))) slot.back = side(p, 0);
    return slot;
  }

  // The slot of the ray in pixel p at parameter l.
  Slot slot(ivec2 p, double l) {
    Slot slot;
    for (int layer = 0; layer < view_.count() && view_.has(layer, index(p)); ++layer) {
      const Side s = side(p, layer);
      const bool passed = s.gap.at(l) > 0.0;
      if (slot.back.exists()) {
        if (passed) slot.sorted = false;
      } else if (passed) {
        slot.front = s;
        ++slot.count;
      } else {
        slot.back = s;
      }
    }
    return slot;
  }

  // Whether the ray is in space that it can only have come to through a surface.
  bool inside_something(const Slot& s, size_t pixel) const {
    return !is_free(options_.free_space, view_.layers.shows_front(pixel, s.front.layer),
                    view_.layers.shows_front(pixel, s.back.layer));
  }

  // The walk behind the first layer, from the pixel that the ray is in; nothing where it has come in front
  // again.
  std::optional<LayerHit> behind(Slot before) {
    constexpr LayerHit kLost{Verdict::behind};
    int level = 0, skipped = 0;
    for (;;) {
      if (level > 0) {
        steps_ += 2;
        const auto exit = walk_.exit(level);
        const bool ends = ray_.l_end <= exit.l();
        const float a = ray_.rise(walk_.l), b = ray_.rise(ends ? ray_.l_end : exit.l());
        if (view_.slots->clear(level, walk_.px >> level, walk_.py >> level, ray_.oz + std::min(a, b),
                               ray_.oz + std::max(a, b))) {
          if (ends) return ray_.end == Verdict::miss ? kLost : LayerHit{ray_.end};
          if (!walk_.advance(exit)) return LayerHit{Verdict::offscreen};
          if (++skipped % kSamplesPerIteration == 0) level = std::min(level + 1, view_.slots->levels() - 1);
        } else {
          walk_.descend(level--);
          if (level == 0 && skipped > 0) {
            const ivec2 p = walk_.previous();
            before.count = 1, before.front = side(p, 0), before.back = side(p, 1);
          }
        }
        continue;
      }
      const ivec2 p(walk_.px, walk_.py);
      const PixelSpan span = pixel_span(view_.first, exact_, p.x, p.y);
      const Slot now = slot(p, span.enter);
      if (!now.sorted || !goes_on(before, now, span.enter)) return kLost;
      if (now.count == 0) return std::nullopt;
      if (!now.back.exists() || inside_something(now, index(p))) return kLost;
      const bool far = now.back.gap.at(span.leave) >= 0.0, near = now.front.gap.at(span.leave) <= 0.0;
      if (far || near) {
        const bool far_first = far && (!near || now.back.gap.crossing() <= now.front.gap.crossing());
        return LayerHit{Verdict::hit, static_cast<uint32_t>(index(p)),
                        (far_first ? now.back : now.front).layer, true};
      }
      if (auto end = step_pixel()) return end->verdict == Verdict::miss ? kLost : *end;
      before = now;
      if (view_.slots && now.count == 1 && view_.slots->levels() > 1) level = 1, skipped = 0;
    }
  }

  const LayeredView& view_;
  const ScreenRay<float> ray_;
  const ScreenRay<double> exact_;
  const ivec2 origin_;
  const LayerOptions& options_;
  uint64_t& steps_;
  CellWalk<float> walk_;
};

}  // namespace

PixelPlane LayeredView::plane(int layer, int x, int y) const {
  if (layer == 0) return pixel_plane(first, x, y);
  const GBuffer& g = layers.further[layer - 1];
  const double sign = first.depth_sign;
  const vec2 d = g.depth_derivatives(x, y);
  return {sign * static_cast<double>(g.depth(x, y)), sign * static_cast<double>(d.x),
          sign * static_cast<double>(d.y)};
}

LayerHit march_layers_ray(const LayeredView& view, const ScreenRay<float>& ray, uint32_t pixel,
                          const LayerOptions& options, uint64_t& steps) {
  return LayerMarch(view, ray, pixel, options, steps).march();
}

void march_layers(const LayeredView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                  const LayerOptions& options, LayerResults& results) {
  HYBRAY_CHECK_EQ(rays.size(), pixels.size());
  HYBRAY_CHECK_EQ(rays.size(), results.layer.size());
  std::atomic<uint64_t> steps{0};
  parallel_blocks(rays.size(), 1024, [&](size_t begin, size_t end) {
    uint64_t mine = 0;
    for (size_t i = begin; i < end; ++i) {
      const LayerHit hit = march_layers_ray(view, rays.get<float>(i), pixels[i], options, mine);
      results.march.verdict[i] = hit.verdict;
      results.march.pixel[i] = hit.pixel;
      results.layer[i] = static_cast<uint8_t>(hit.layer);
      results.late[i] = hit.late;
    }
    steps += mine;
  });
  results.march.steps = steps;
}

}  // namespace hybray::ssrm
