// Bodies given by a function f of space that is negative inside, positive outside, and never changes by more
// than the distance walked (its Lipschitz bound is 1). Rays meet them by sphere tracing (Hart 1996), in
// double, metres, about the body's centre.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <optional>

namespace hybray {

struct DistanceField {
  enum class Shape : uint8_t { torus, gyroid, blob };

  Shape shape = Shape::torus;
  double radius = 1.0;     // of the circle inside a torus; of the ball that a gyroid or blob fills
  double thickness = 0.1;  // radius of a torus' tube; of a gyroid, |g| of its sheet's faces, in (0, 1.5); of
                           // a blob, how widely its balls melt into each other
  double period = 1.0;     // of a gyroid
  dvec3 axis{0, 1, 0};     // of a torus, unit
};

const char* label(DistanceField::Shape shape);

// f at p: of a torus and of single balls the distance. A gyroid is the sheet |g| <= thickness with g = sin x
// cos y + sin y cos z + sin z cos x (Schoen 1970), x = 2 pi p.x / period and so on, whose slope is at most
// sqrt(3) 2 pi / period, cut to a ball. A blob is the smooth minimum (Quilez's polynomial one, which mixes
// slopes, so that the bound stays) of the distances from seven balls.
double value(const DistanceField& field, const dvec3& p);

// Direction of the slope of f, of unit length; not at the centre of a ball nor on the circle of a torus,
// where there is none.
dvec3 gradient(const DistanceField& field, const dvec3& p);

// Radius of a ball about the centre that holds the body.
double reach(const DistanceField& field);

// Smallest t in [t_near, t_far] at which o + t d enters or leaves the body, to kFieldAccuracy x reach.
// `d` need not have unit length. No chord longer than that is passed over: every step is at most as long as
// |f| allows, or that short.
constexpr double kFieldAccuracy = 1e-10;
std::optional<double> nearest_hit(const DistanceField& field, const dvec3& o, const dvec3& d, double t_near,
                                  double t_far);

// The point of the surface next to p, for points beside it.
dvec3 moved_onto(const DistanceField& field, const dvec3& p);

// A point of the surface next to where the line o + t d passes nearest to it (to about reach / 1000).
dvec3 beside(const DistanceField& field, const dvec3& o, const dvec3& d);

}  // namespace hybray
