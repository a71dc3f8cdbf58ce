#include "core/truth/exact_frame.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/gbuffer/triangle_plane.h"
#include "core/scene/surface_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hybray::truth {
namespace {

using ssrm::Verdict;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Neighbouring pixels of one surface have one plane but for the last bits.
constexpr double kSlack = 0x1p-44;

// Interpolated normal of a triangle at a point in its plane, by areas.
dvec3 shading_normal(const Scene& scene, uint32_t triangle, const dvec3& point) {
  const uvec3& tri = scene.triangles[triangle];
  const dvec3 a(scene.positions[tri.x]), b(scene.positions[tri.y]), c(scene.positions[tri.z]);
  const dvec3 n = glm::cross(b - a, c - a);
  const double area = glm::dot(n, n);
  const double u = glm::dot(glm::cross(point - a, c - a), n) / area;
  const double v = glm::dot(glm::cross(b - a, point - a), n) / area;
  const dvec3 sum = (1.0 - u - v) * dvec3(scene.normals[tri.x]) + u * dvec3(scene.normals[tri.y]) +
                    v * dvec3(scene.normals[tri.z]);
  const double length = glm::length(sum);
  return length > 1e-6 ? sum / length : glm::normalize(n);
}

dvec3 mirrored(const dvec3& d, const dvec3& n) {
  return glm::normalize(d - 2.0 * glm::dot(d, n) * n);
}

// Where a border across one axis is met; infinity if never.
double crossing(int border, double origin, double direction) {
  return direction == 0.0 ? kInfinity : (border - origin) / direction;
}

}  // namespace

ExactFrame::ExactFrame(const Scene& scene, const View& view, Image2D<uint32_t> primitive)
    : scene_(scene),
      view_(view),
      primitive_(std::move(primitive)),
      planes_(view.width(), view.height(), {kInfinity, 0.0, 0.0}) {
  HYBRAY_CHECK_EQ(primitive_.width(), view_.width());
  HYBRAY_CHECK_EQ(primitive_.height(), view_.height());
  parallel_blocks(static_cast<size_t>(view_.height()), 8, [&](size_t first, size_t last) {
    for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y)
      for (int x = 0; x < view_.width(); ++x) {
        if (primitive_(x, y) == kNoPrimitive) continue;
        const TrianglePlane p = tangent_plane(view_, scene_, primitive_(x, y), x + 0.5, y + 0.5);
        if (p.inverse_w > 0.0 && std::isfinite(p.inverse_w))
          planes_(x, y) = {-p.inverse_w, -p.slope_x, -p.slope_y};
      }
  });
}

std::optional<ExactFrame::Ray> ExactFrame::mirror_ray(uint32_t pixel) const {
  const int x = static_cast<int>(pixel) % view_.width(), y = static_cast<int>(pixel) / view_.width();
  const uint32_t primitive = primitive_(x, y);
  HYBRAY_CHECK(primitive != kNoPrimitive);
  if (std::isinf(planes_(x, y).center)) return std::nullopt;
  const double w = view_depth(pixel);
  const dvec3 to_surface = view_.ray_direction(x + 0.5, y + 0.5), incoming = glm::normalize(to_surface);

  Ray ray;
  ray.pixel = pixel;
  ray.origin = view_.eye() + w * to_surface;
  dvec3 ng = geometric_normal(scene_, primitive, ray.origin);
  dvec3 ns = scene_.is_triangle(primitive) ? shading_normal(scene_, primitive, ray.origin) : ng;
  if (glm::dot(ng, incoming) > 0.0) ng = -ng, ns = -ns;
  ray.direction = mirrored(incoming, ns);
  if (glm::dot(incoming, ns) >= 0.0 || glm::dot(ray.direction, ng) <= 0.0)
    ray.direction = mirrored(incoming, ng);

  const double w1 = glm::dot(ray.direction, view_.forward()), k = w1 / w, scale = view_.focal() / w;
  const dvec2 p(x + 0.5, y + 0.5), from_axis = p - view_.center();
  ray.screen.ox = p.x, ray.screen.oy = p.y, ray.screen.oz = planes_(x, y).center;
  ray.screen.dx = scale * glm::dot(ray.direction, view_.right()) - from_axis.x * k;
  ray.screen.dy = scale * glm::dot(ray.direction, view_.down()) - from_axis.y * k;
  ray.screen.dz = k / w;
  end_ray(ray);
  return ray;
}

// Where the ray leaves the depth range or the scene's bounds, and what that means.
void ExactFrame::end_ray(Ray& ray) const {
  const Bounds3 box = scene_.bounds.enlarged(ssrm::kBoundsMargin);
  double t = kInfinity;
  for (int axis = 0; axis < 3; ++axis)
    if (ray.direction[axis] != 0.0) {
      const double side = ray.direction[axis] > 0.0 ? box.upper[axis] : box.lower[axis];
      t = std::min(t, (side - ray.origin[axis]) / ray.direction[axis]);
    }
  ray.screen.end = Verdict::miss;
  const double w0 = -1.0 / ray.screen.oz, w1 = glm::dot(ray.direction, view_.forward());
  const double plane = w1 < 0.0 ? view_.near() : view_.far();
  if (w1 != 0.0 && (plane - w0) / w1 < t) {
    t = (plane - w0) / w1;
    ray.screen.end = w1 < 0.0 ? Verdict::viewer : Verdict::offscreen;
  }
  ray.screen.l_end = t / (1.0 + t * w1 / w0);
}

ExactFrame::Span ExactFrame::span(const ssrm::ScreenRay<double>& ray, int x, int y) const {
  const auto axis = [](double origin, double direction, int pixel) {
    const double a = crossing(direction > 0.0 ? pixel : pixel + 1, origin, direction);
    return std::pair(direction == 0.0 ? -kInfinity : a,
                     crossing(direction > 0.0 ? pixel + 1 : pixel, origin, direction));
  };
  const auto [in_x, out_x] = axis(ray.ox, ray.dx, x);
  const auto [in_y, out_y] = axis(ray.oy, ray.dy, y);
  return {std::max(in_x, in_y), std::min({out_x, out_y, ray.l_end})};
}

double ExactFrame::gap(const ssrm::ScreenRay<double>& ray, int x, int y, double l) const {
  const ssrm::PixelPlane& p = planes_(x, y);
  if (std::isinf(p.center)) return -kInfinity;
  const double plane = p.center + p.slope_x * (ray.ox + l * ray.dx - (x + 0.5)) +
                       p.slope_y * (ray.oy + l * ray.dy - (y + 0.5));
  return ray.oz + l * ray.dz - plane;
}

double ExactFrame::slack(int x, int y) const {
  const ssrm::PixelPlane& p = planes_(x, y);
  return std::isinf(p.center) ? 0.0
                              : kSlack * (std::abs(p.center) + std::abs(p.slope_x) + std::abs(p.slope_y));
}

bool ExactFrame::passes(const ssrm::ScreenRay<double>& ray, int x, int y) const {
  const Span s = span(ray, x, y);
  return gap(ray, x, y, s.enter) <= 0.0 && gap(ray, x, y, s.leave) >= 0.0;
}

ssrm::Correction ExactFrame::march(const Ray& r, ssrm::Marcher marcher) const {
  const ssrm::ScreenRay<double>& ray = r.screen;
  const int width = view_.width(), height = view_.height();
  const int origin_x = static_cast<int>(r.pixel) % width, origin_y = static_cast<int>(r.pixel) / width;
  int x = origin_x, y = origin_y, before_x = x, before_y = y;
  double l = 0.0;
  for (bool at_origin = true;; at_origin = false) {
    const double lx = crossing(ray.dx > 0.0 ? x + 1 : x, ray.ox, ray.dx);
    const double ly = crossing(ray.dy > 0.0 ? y + 1 : y, ray.oy, ray.dy);
    const bool ends = ray.l_end <= std::min(lx, ly);
    const double leave = ends ? ray.l_end : std::min(lx, ly);
    if (!at_origin && marcher == ssrm::Marcher::plane) {
      const double entered = gap(ray, x, y, l);
      if (entered > slack(x, y)) return {Verdict::behind, ssrm::kNoPixel};
      if (gap(ray, x, y, leave) > slack(x, y)) {
        if (entered > 0.0) return {Verdict::behind, ssrm::kNoPixel};
        return {Verdict::hit, index(x, y)};
      }
    } else if (!at_origin && ray.oz + std::max(l * ray.dz, leave * ray.dz) > planes_(x, y).center) {
      const double entered = gap(ray, x, y, l);
      if (entered <= 0.0 && gap(ray, x, y, leave) >= 0.0) return {Verdict::hit, index(x, y)};
      if ((before_x != origin_x || before_y != origin_y) && passes(ray, before_x, before_y))
        return {Verdict::hit, index(before_x, before_y)};
      return {entered <= 0.0 ? Verdict::correction : Verdict::behind, ssrm::kNoPixel};
    }
    if (ends) return {ray.end, ssrm::kNoPixel};
    before_x = x, before_y = y;
    l = leave;
    if (lx <= l) x += ray.dx > 0.0 ? 1 : -1;
    if (ly <= l) y += ray.dy > 0.0 ? 1 : -1;
    if (x < 0 || x >= width || y < 0 || y >= height) return {Verdict::offscreen, ssrm::kNoPixel};
  }
}

double ExactFrame::distance(const Ray& r, uint32_t pixel) const {
  const int x = static_cast<int>(pixel) % view_.width(), y = static_cast<int>(pixel) / view_.width();
  const Span s = span(r.screen, x, y);
  const double at_enter = gap(r.screen, x, y, s.enter), at_leave = gap(r.screen, x, y, s.leave);
  const double share = at_leave == at_enter ? 0.0 : std::clamp(-at_enter / (at_leave - at_enter), 0.0, 1.0);
  const double l = s.enter + share * (s.leave - s.enter);
  const double k = glm::dot(r.direction, view_.forward()) * -r.screen.oz;
  return l / (1.0 - l * k);
}

}  // namespace hybray::truth
