// Shapes that the procedural scenes share: surfaces of revolution, swept tubes, mouldings, walls with
// openings, arches, cloth, leaves. All are closed or meant to be seen from their front only, wound
// counter-clockwise, in metres with y up.
#pragma once

#include "core/scene/procedural/mesh_builder.h"

#include <functional>
#include <numbers>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace hybray::procedural {

constexpr double kPi = std::numbers::pi;
using Curve2 = std::vector<dvec2>;
using Curve3 = std::vector<dvec3>;

inline dmat4 moved(const dvec3& by) {
  return glm::translate(dmat4(1.0), by);
}
inline dmat4 turned(double angle, const dvec3& axis = dvec3(0, 1, 0)) {
  return glm::rotate(dmat4(1.0), angle, axis);
}

// `segments` + 1 points along the smooth (Catmull-Rom) curve through `points`.
Curve2 smooth(const Curve2& points, int segments);
Curve3 smooth(const Curve3& points, int segments);

// Revolves a profile of (radius, y) about the y axis. Bottom to top faces outward; smooth along the whole
// profile. A radius of zero at an end closes it.
void lathe(MeshBuilder& part, const Curve2& profile, int sides);

// The same with a crease between the pieces, each of which is revolved by itself.
void lathe_pieces(MeshBuilder& part, const std::vector<Curve2>& pieces, int sides);

void ball(MeshBuilder& part, const dvec3& center, double radius, int sides, int rings);

// A round tube along `path`, its radius going from `radius` to `end_radius`, with flat caps; a closed path
// joins its ends.
void tube(MeshBuilder& part, const Curve3& path, double radius, double end_radius, int sides,
          bool closed = false);
inline void tube(MeshBuilder& part, const Curve3& path, double radius, int sides) {
  tube(part, path, radius, radius, sides);
}

// `segments` + 1 points of an arc about `center`, from angle `from` to `to`, in the plane of the unit vectors
// `a` and `b`.
Curve3 arc(const dvec3& center, const dvec3& a, const dvec3& b, double radius, double from, double to,
           int segments);
// A closed ring, and a torus along it.
void ring(MeshBuilder& part, const dvec3& center, const dvec3& a, const dvec3& b, double radius,
          double thickness, int segments, int sides);

// A moulding: the profile of (z, y), from the wall's foot outward and up to the wall again, swept along x
// from x0 to x1, with end caps. Flat facets; `rounded` smooths along the profile. All
// of the profile must be in sight of its last point.
void moulding(MeshBuilder& part, const Curve2& profile, double x0, double x1, bool rounded = false);

// A flat wall in the plane z = 0, facing +z, over x0..x1 and y0..y1 without the given openings, which must
// not overlap.
struct Opening {
  double x0, x1, y0, y1;
};
void wall_with_openings(MeshBuilder& part, double x0, double x1, double y0, double y1,
                        const std::vector<Opening>& openings);

// One bay of an arcade: a wall of `thickness` about z = 0 from -width/2 to width/2, y0 to y1, cut by a round
// arch of `radius` that springs at y0. Its ends, top and foot stay open: they belong inside the neighbours,
// the floor above and the capitals. `segments` is even.
struct ArchBay {
  double width, y0, y1, radius, thickness;
};
void arch_bay(MeshBuilder& part, const ArchBay& bay, int segments);

// A cloth of `thickness` about the surface middle(u, v), front at dP/du x dP/dv, closed around its border.
void cloth(MeshBuilder& part, int nu, int nv, double thickness,
           const std::function<dvec3(double, double)>& middle);

// A leaf from the origin along +z, its upper side toward +y, bent down by `droop` (metres at the tip): 8 nv -
// 8 triangles, nv >= 2.
void leaf(MeshBuilder& part, double length, double width, double droop, int nv);

// A disc in the plane z = 0 facing +z raised by radius * height(x, y), where x and y are of the unit disc.
void relief(MeshBuilder& part, double radius, int sides, int rings,
            const std::function<double(double, double)>& height);

}  // namespace hybray::procedural
