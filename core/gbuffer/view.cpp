#include "core/gbuffer/view.h"

#include "core/base/error.h"

#include <cmath>

#include <fmt/format.h>

namespace hybray {
namespace {

// View depth of the farthest corner of the scene's box, enlarged so that rays that leave the box do so inside
// the view; at least twice `near`.
double automatic_far(const Bounds3& scene, const dvec3& eye, const dvec3& forward, double near) {
  const Bounds3 bounds = scene.enlarged(0.02f);
  double far = 2.0 * near;
  for (int corner = 0; corner < 8 && !bounds.empty(); ++corner) {
    const dvec3 p(corner & 1 ? bounds.upper.x : bounds.lower.x, corner & 2 ? bounds.upper.y : bounds.lower.y,
                  corner & 4 ? bounds.upper.z : bounds.lower.z);
    far = std::max(far, glm::dot(p - eye, forward));
  }
  return far;
}

}  // namespace

View::View(const Camera& camera, const Settings& s, const Bounds3& bounds)
    : width_(s.width),
      height_(s.height),
      near_(s.near),
      far_(s.far),
      convention_(s.convention),
      center_(dvec2(0.5 * s.width, 0.5 * s.height) + s.jitter),
      eye_(camera.eye) {
  const std::string where = "camera " + camera.name;
  if (s.width < 1 || s.height < 1)
    throw InputError(where, fmt::format("resolution {}x{} has no pixels", s.width, s.height));
  if (!(s.near > 0.0) || !std::isfinite(s.near))
    throw InputError(where, fmt::format("near is {}; it must be positive", s.near));
  if (!(camera.vertical_fov > 0.0f && camera.vertical_fov < 180.0f))
    throw InputError(
        where, fmt::format("vertical_fov is {}; it must lie between 0 and 180 degrees", camera.vertical_fov));

  const dvec3 axis = dvec3(camera.target) - eye_;
  const dvec3 side = glm::cross(axis, dvec3(camera.up));
  if (!(glm::dot(axis, axis) > 0.0)) throw InputError(where, "eye and target are the same point");
  if (!(glm::dot(side, side) > 0.0)) throw InputError(where, "up is parallel to the view axis");
  forward_ = glm::normalize(axis);
  right_ = glm::normalize(side);
  down_ = glm::cross(forward_, right_);
  focal_ = 0.5 * height_ / std::tan(0.5 * camera.vertical_fov * 3.14159265358979323846 / 180.0);

  if (far_ == 0.0) far_ = automatic_far(bounds, eye_, forward_, near_);
  if (!(far_ > near_))
    throw InputError(where, fmt::format("far is {}; it must be greater than near, {}", far_, near_));
  const double share =
      std::isinf(far_) ? 0.0 : near_ / (far_ - near_);  // n / (f - n); f / (f - n) is 1 + share
  if (convention_ == DepthConvention::standard) {
    a_ = 1.0 + share;
    b_ = -near_ * (1.0 + share);
  } else {
    a_ = -share;
    b_ = near_ * (1.0 + share);
  }
}

View View::with_margin(int x, int y) const {
  View larger = *this;
  larger.width_ += 2 * x;
  larger.height_ += 2 * y;
  larger.center_ += dvec2(x, y);
  return larger;
}

}  // namespace hybray
