#include "core/ssrm/screen_rays.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybray::ssrm {
namespace {

// A component of the screen direction, rounded to float and never zero.
float nonzero(double d) {
  const float f = static_cast<float>(d);
  constexpr float kSmallest = std::numeric_limits<float>::min();
  return std::abs(f) >= kSmallest ? f : std::copysign(kSmallest, f);
}

// Distance at which o + t d leaves the box.
double exit_distance(const Bounds3& box, const dvec3& o, const dvec3& d) {
  double t = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0.0) continue;
    const double side = d[axis] > 0.0 ? box.upper[axis] : box.lower[axis];
    t = std::min(t, (side - o[axis]) / d[axis]);
  }
  return t;
}

}  // namespace

ScreenRays project_rays(const RayStream& rays, const View& view, const Bounds3& scene_bounds,
                        std::span<const float> lengths) {
  const Bounds3 box = scene_bounds.enlarged(kBoundsMargin);
  const double sign = view.depth_sign();
  ScreenRays out;
  out.resize(rays.size());
  parallel_blocks(rays.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const dvec3 o(rays.origin(i)), d(rays.direction(i));
      const double w0 = view.view_depth(o), w1 = glm::dot(d, view.forward()), k = w1 / w0;
      const dvec2 p = view.project(o);
      const dvec2 center = view.center();
      const double scale = view.focal() / w0;
      out.ox[i] = static_cast<float>(p.x);
      out.oy[i] = static_cast<float>(p.y);
      out.oz[i] = static_cast<float>(sign * view.device_depth(w0));
      // d(p)/dL = focal / w0 * (direction across) - (p - center) * k, and 1/w falls by k / w0 with each unit
      // of L.
      out.dx[i] = nonzero(scale * glm::dot(d, view.right()) - (p.x - center.x) * k);
      out.dy[i] = nonzero(scale * glm::dot(d, view.down()) - (p.y - center.y) * k);
      out.dz[i] = static_cast<float>(-sign * view.depth_b() * k / w0);

      const auto l_of = [&](double t) { return std::isinf(t) ? 1.0 / k : t / (1.0 + t * k); };
      double t = exit_distance(box, o, d);
      Verdict event = Verdict::miss;
      if (w1 < 0.0 && (view.near() - w0) / w1 < t) t = (view.near() - w0) / w1, event = Verdict::viewer;
      if (w1 > 0.0 && (view.far() - w0) / w1 < t) t = (view.far() - w0) / w1, event = Verdict::offscreen;
      if (!lengths.empty() && static_cast<double>(lengths[i]) < t)
        t = static_cast<double>(lengths[i]), event = Verdict::miss;
      out.l_end[i] = static_cast<float>(l_of(t));
      out.end[i] = event;
    }
  });
  return out;
}

namespace {

// k of t = L / (1 - L k).
double depth_rate(const RayStream& rays, size_t i, const View& view) {
  return glm::dot(dvec3(rays.direction(i)), view.forward()) / view.view_depth(dvec3(rays.origin(i)));
}

}  // namespace

double distance_of(const RayStream& rays, size_t i, const View& view, double l) {
  return l / (1.0 - l * depth_rate(rays, i, view));
}

double parameter_of(const RayStream& rays, size_t i, const View& view, double t) {
  return t / (1.0 + t * depth_rate(rays, i, view));
}

}  // namespace hybray::ssrm
