// Surfaces given by an equation instead of triangles, so that what is measured on them is not tessellation:
// spheres, upright cylinders without caps, upright paraboloids of revolution, and bodies given by a distance
// field. All in double, metres.
#pragma once

#include "core/base/vec.h"
#include "core/scene/distance_field.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace hybray {

struct AnalyticSurface {
  enum class Kind : uint8_t { sphere, cylinder, paraboloid, field };

  std::string name;
  uint32_t material = 0;  // into Scene::materials
  Kind kind = Kind::sphere;
  dvec3 center{0.0};          // centre; of a cylinder any point of its axis, of a paraboloid its vertex
  double radius = 1.0;        // of a paraboloid: of its rim
  double y0 = 0.0, y1 = 0.0;  // lower and upper end of a cylinder, in world space
  double focal_length = 1.0;  // of a paraboloid: its height over the vertex is r^2 / (4 focal_length); it
                              // opens up where this is positive, down where it is negative
  DistanceField field;        // about `center`; its own sizes are the ones that count
};

AnalyticSurface analytic_sphere(const std::string& name, uint32_t material, const dvec3& center,
                                double radius);
// The side of a cylinder about the vertical line through (axis.x, axis.z), from y0 up to y1.
AnalyticSurface analytic_cylinder(const std::string& name, uint32_t material, const dvec3& axis,
                                  double radius, double y0, double y1);
AnalyticSurface analytic_paraboloid(const std::string& name, uint32_t material, const dvec3& vertex,
                                    double focal_length, double rim_radius);

AnalyticSurface analytic_field(const std::string& name, uint32_t material, const dvec3& center,
                               const DistanceField& field);

// Throws InputError, naming the surface, for sizes that are not positive and finite.
void check_surface(const AnalyticSurface& surface);

// A box that encloses the surface after rounding to float.
Bounds3 bounds(const AnalyticSurface& surface);

// Largest distance between two points of it along an axis: the scale of its rounding errors.
double extent(const AnalyticSurface& surface);

// The parameters t, ascending, at which the line origin + t direction meets the surface. The direction need
// not have unit length. Not for fields, which a line may meet any number of times.
struct LineHits {
  int count = 0;
  std::array<double, 2> t{};
};
LineHits line_hits(const AnalyticSurface& surface, const dvec3& origin, const dvec3& direction);

// The smallest of them in [t_near, t_far].
std::optional<double> nearest_hit(const AnalyticSurface& surface, const dvec3& origin, const dvec3& direction,
                                  double t_near, double t_far);

// Unit normal at a point of the surface, on its outer side: away from the centre of a sphere and from the
// axis of a cylinder; on a paraboloid the convex side, away from its focus; out of a field's body.
dvec3 outward_normal(const AnalyticSurface& surface, const dvec3& point);

// The point of the surface (of the whole cylinder or paraboloid, ends not regarded) next to a `point` that
// lies beside it by no more than rounding.
dvec3 moved_onto(const AnalyticSurface& surface, const dvec3& point);

}  // namespace hybray
