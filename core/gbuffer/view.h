// A camera at a resolution: the mapping between world space, view depth, pixels and device depth. All in
// double; buffers round to float.
//
// Pixels: (0, 0) is the top left corner, pixel (x, y) covers [x, x+1) x [y, y+1), its centre is (x + 1/2, y +
// 1/2). View depth w is the distance along the view axis, metres. Device depth is a + b / w, affine on the
// screen across a plane and along a ray.
#pragma once

#include "core/base/vec.h"
#include "core/scene/camera.h"

#include <cstdint>

namespace hybray {

enum class DepthConvention {
  standard,  // 0 at the near plane, 1 at the far plane
  reversed,  // 1 at the near plane, 0 at the far plane: float spacing then follows 1/w
};

class View {
 public:
  struct Settings {
    int width = 0, height = 0;  // pixels, each at least 1
    double near = 0.1;          // metres, > 0
    double far = 0.0;  // metres, > near, may be infinity; 0: just beyond the farthest corner of `bounds`
    DepthConvention convention = DepthConvention::reversed;
    dvec2 jitter{0.0};  // pixels by which the view axis is moved on the screen, for anti-aliasing over time
  };

  // Throws InputError for settings out of range and for a camera whose axes are degenerate.
  View(const Camera& camera, const Settings& settings, const Bounds3& bounds);

  // The same camera with `x` more pixels on the left and on the right and `y` above and below: the screen
  // point (px, py) becomes (px + x, py + y), whose ray is the same to the last bit.
  View with_margin(int x, int y) const;

  int width() const { return width_; }
  int height() const { return height_; }
  double near() const { return near_; }
  double far() const { return far_; }
  DepthConvention convention() const { return convention_; }
  uint32_t pixel_index(int x, int y) const {  // row-major
    return static_cast<uint32_t>(y) * static_cast<uint32_t>(width_) + static_cast<uint32_t>(x);
  }
  const dvec3& eye() const { return eye_; }
  const dvec3& right() const { return right_; }      // unit, toward +x on the screen
  const dvec3& down() const { return down_; }        // unit, toward +y on the screen
  const dvec3& forward() const { return forward_; }  // unit, view axis
  double focal() const { return focal_; }            // focal length in pixels
  const dvec2& center() const { return center_; }    // screen point of the view axis

  // Direction through screen point (px, py) whose component along the view axis is 1: eye + w * ray_direction
  // is the point at view depth w.
  dvec3 ray_direction(double px, double py) const {
    return forward_ + ((px - center_.x) / focal_) * right_ + ((py - center_.y) / focal_) * down_;
  }
  double view_depth(const dvec3& world) const { return glm::dot(world - eye_, forward_); }

  // Screen point of a world point in front of the eye.
  dvec2 project(const dvec3& world) const {
    const dvec3 d = world - eye_;
    const double scale = focal_ / glm::dot(d, forward_);
    return {center_.x + scale * glm::dot(d, right_), center_.y + scale * glm::dot(d, down_)};
  }

  // Device depth a + b / w and its inverse.
  double depth_a() const { return a_; }
  double depth_b() const { return b_; }
  double device_depth(double w) const { return a_ + b_ / w; }
  double view_depth_of(double device_depth) const { return b_ / (device_depth - a_); }
  float background_depth() const { return convention_ == DepthConvention::standard ? 1.0f : 0.0f; }

  // +1 where greater device depth is farther, -1 where it is nearer. sign * depth always grows with distance
  // ("march depth").
  int depth_sign() const { return convention_ == DepthConvention::standard ? 1 : -1; }

 private:
  int width_, height_;
  double near_, far_, focal_, a_, b_;
  DepthConvention convention_;
  dvec2 center_;
  dvec3 eye_, right_, down_, forward_;
};

}  // namespace hybray
