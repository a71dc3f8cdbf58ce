#include "core/scene/analytic_surface.h"

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/float_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace hybray {
namespace {

using Kind = AnalyticSurface::Kind;

dvec3 across(const dvec3& v) {  // without the component along the axis
  return {v.x, 0.0, v.z};
}

// Roots of a t^2 + 2 b t + c, `discriminant` = b^2 - a c, ascending, by the form that loses no digits to
// cancellation. Where a is (nearly) zero one of them is not finite.
LineHits roots(double a, double b, double c, double discriminant) {
  if (!(discriminant >= 0.0)) return {};
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  LineHits hits;
  for (const double t : {q / a, c / q})
    if (std::isfinite(t)) hits.t[hits.count++] = t;
  if (hits.count == 2 && hits.t[0] > hits.t[1]) std::swap(hits.t[0], hits.t[1]);
  return hits;
}

// Where |o + t d| = radius. The discriminant comes from the point of the line next to the centre: b^2 - a c
// would lose the digits that decide at grazing incidence.
LineHits round_hits(const dvec3& o, const dvec3& d, double radius) {
  const double a = glm::dot(d, d), b = glm::dot(o, d);
  if (!(a > 0.0)) return {};
  const dvec3 nearest = o - (b / a) * d;
  const double distance = glm::length(nearest);
  return roots(a, b, (glm::length(o) - radius) * (glm::length(o) + radius),
               a * (radius - distance) * (radius + distance));
}

template <class Keep>
LineHits filtered(const LineHits& all, const Keep& keep) {
  LineHits kept;
  for (int i = 0; i < all.count; ++i)
    if (keep(all.t[i])) kept.t[kept.count++] = all.t[i];
  return kept;
}

// Half the gradient of x^2 + z^2 - 4 f y, which grows toward the convex side.
dvec3 half_gradient(const AnalyticSurface& s, const dvec3& from_vertex) {
  return {from_vertex.x, -2.0 * s.focal_length, from_vertex.z};
}

}  // namespace

AnalyticSurface analytic_sphere(const std::string& name, uint32_t material, const dvec3& center,
                                double radius) {
  AnalyticSurface s;
  s.name = name, s.material = material, s.kind = Kind::sphere, s.center = center, s.radius = radius;
  return s;
}

AnalyticSurface analytic_cylinder(const std::string& name, uint32_t material, const dvec3& axis,
                                  double radius, double y0, double y1) {
  AnalyticSurface s = analytic_sphere(name, material, axis, radius);
  s.kind = Kind::cylinder, s.y0 = y0, s.y1 = y1;
  return s;
}

AnalyticSurface analytic_paraboloid(const std::string& name, uint32_t material, const dvec3& vertex,
                                    double focal_length, double rim_radius) {
  AnalyticSurface s = analytic_sphere(name, material, vertex, rim_radius);
  s.kind = Kind::paraboloid, s.focal_length = focal_length;
  return s;
}

AnalyticSurface analytic_field(const std::string& name, uint32_t material, const dvec3& center,
                               const DistanceField& field) {
  AnalyticSurface s = analytic_sphere(name, material, center, reach(field));
  s.kind = Kind::field, s.field = field;
  return s;
}

void check_surface(const AnalyticSurface& s) {
  const auto require = [&](bool condition, const char* property, double value, const char* range) {
    if (!condition)
      throw InputError(fmt::format("analytic surface '{}'", s.name),
                       fmt::format("{} is {}; it must be {}", property, value, range));
  };
  for (int k = 0; k < 3; ++k)
    require(std::isfinite(s.center[k]), "a coordinate of its centre", s.center[k], "finite");
  require(s.radius > 0.0 && std::isfinite(s.radius), "radius", s.radius, "positive");
  if (s.kind == Kind::cylinder)
    require(s.y1 > s.y0 && std::isfinite(s.y1 - s.y0), "its height", s.y1 - s.y0, "positive");
  if (s.kind == Kind::paraboloid)
    require(s.focal_length != 0.0 && std::isfinite(s.focal_length), "focal_length", s.focal_length,
            "finite and not zero");
  if (s.kind != Kind::field) return;
  const DistanceField& f = s.field;
  const bool gyroid = f.shape == DistanceField::Shape::gyroid;
  require(f.radius > 0.0 && std::isfinite(f.radius), "its field's radius", f.radius, "positive");
  require(f.thickness > 0.0 && std::isfinite(f.thickness), "thickness", f.thickness, "positive");
  if (gyroid) {
    require(f.thickness < 1.5, "thickness", f.thickness, "less than 1.5, which fills the ball");
    require(f.period > 0.0 && std::isfinite(f.period), "period", f.period, "positive");
  }
  require(std::abs(glm::length(f.axis) - 1.0) < 1e-9, "the length of its axis", glm::length(f.axis), "1");
}

Bounds3 bounds(const AnalyticSurface& s) {
  dvec3 lower = s.center - dvec3(s.radius), upper = s.center + dvec3(s.radius);
  if (s.kind == Kind::cylinder) lower.y = s.y0, upper.y = s.y1;
  if (s.kind == Kind::paraboloid) {
    const double rim = s.center.y + 0.25 * s.radius * s.radius / s.focal_length;
    lower.y = std::min(s.center.y, rim), upper.y = std::max(s.center.y, rim);
  }
  return enclosing_box(lower, upper);
}

double extent(const AnalyticSurface& s) {
  switch (s.kind) {
    case Kind::sphere:
    case Kind::field:
      return 2.0 * s.radius;
    case Kind::cylinder:
      return std::max(2.0 * s.radius, s.y1 - s.y0);
    case Kind::paraboloid:
      return std::max(2.0 * s.radius, 0.25 * s.radius * s.radius / std::abs(s.focal_length));
  }
  return 0.0;
}

LineHits line_hits(const AnalyticSurface& s, const dvec3& origin, const dvec3& d) {
  const dvec3 o = origin - s.center;
  switch (s.kind) {
    case Kind::sphere:
      return round_hits(o, d, s.radius);
    case Kind::cylinder:
      return filtered(round_hits(across(o), across(d), s.radius), [&](double t) {
        const double y = origin.y + t * d.y;
        return y >= s.y0 && y <= s.y1;
      });
    case Kind::paraboloid: {
      const double a = d.x * d.x + d.z * d.z, b = o.x * d.x + o.z * d.z - 2.0 * s.focal_length * d.y;
      const double c = o.x * o.x + o.z * o.z - 4.0 * s.focal_length * o.y;
      return filtered(roots(a, b, c, b * b - a * c),
                      [&](double t) { return glm::length(across(o + t * d)) <= s.radius; });
    }
    case Kind::field:
      HYBRAY_CHECK(s.kind != Kind::field);
  }
  return {};
}

std::optional<double> nearest_hit(const AnalyticSurface& s, const dvec3& origin, const dvec3& d,
                                  double t_near, double t_far) {
  if (s.kind == Kind::field) return nearest_hit(s.field, origin - s.center, d, t_near, t_far);
  const LineHits hits = line_hits(s, origin, d);
  for (int i = 0; i < hits.count; ++i)
    if (hits.t[i] >= t_near && hits.t[i] <= t_far) return hits.t[i];
  return std::nullopt;
}

dvec3 outward_normal(const AnalyticSurface& s, const dvec3& point) {
  const dvec3 p = point - s.center;
  switch (s.kind) {
    case Kind::sphere:
      return glm::normalize(p);
    case Kind::cylinder:
      return glm::normalize(across(p));
    case Kind::paraboloid:
      return glm::normalize(half_gradient(s, p));
    case Kind::field:
      return gradient(s.field, p);
  }
  return {};
}

dvec3 moved_onto(const AnalyticSurface& s, const dvec3& point) {
  const dvec3 p = point - s.center;
  switch (s.kind) {
    case Kind::sphere:
      return s.center + p * (s.radius / glm::length(p));
    case Kind::cylinder: {
      const double scale = s.radius / glm::length(across(p));
      return {s.center.x + scale * p.x, point.y, s.center.z + scale * p.z};
    }
    case Kind::paraboloid: {
      dvec3 on = p;
      for (int i = 0; i < 3; ++i) {  // Newton's method along the gradient; quadratic from rounding errors
        const dvec3 g = half_gradient(s, on);
        on -= g * (0.5 * (on.x * on.x + on.z * on.z - 4.0 * s.focal_length * on.y) / glm::dot(g, g));
      }
      return s.center + on;
    }
    case Kind::field:
      return s.center + moved_onto(s.field, p);
  }
  return point;
}

}  // namespace hybray
