// Hair and grass: a circle swept along a cubic Bezier curve, open at both ends. All in double over the float
// control points that the tracer reads too, metres.
//
// The surface is that of Embree's round Bezier curves (RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE): of each point
// C(u) the circle of radius r(u) about it, in the plane across C'(u). A point X near the curve so belongs to
// the u at which its distance from the curve is stationary, (X - C(u)) . C'(u) = 0, and lies on the surface
// where |X - C(u)| = r(u).
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstdint>
#include <optional>

namespace hybray {

struct RoundCurve {
  std::array<vec4, 4> control{};  // Bezier control points: position, and the radius as fourth coordinate
  uint32_t material = 0;          // into Scene::materials
};

// Throws InputError, naming the curve by its `number`, for control points that are not finite, radii that are
// negative or all zero, a curve that stands still, and one that bends more sharply than its radius, whose
// surface would fold.
void check_curve(const RoundCurve& curve, size_t number);

// A box that encloses the curve after rounding to float, and boxes of the pieces that it falls into at u = i
// / 8.
constexpr int kCurvePieces = 8;
Bounds3 bounds(const RoundCurve& curve);
std::array<Bounds3, kCurvePieces> piece_bounds(const RoundCurve& curve);

// Longest side of its box: the scale of its rounding errors.
double extent(const RoundCurve& curve);

// Smallest t in [t_near, t_far] at which o + t d meets the surface, from outside or inside. `d` need not have
// unit length. The curve is halved four times, pieces that the line passes by are left out, and in each of
// the others the meetings are found by Newton's method in (u, t) where the line runs across it, by bisection
// in u where it runs along. Of lines that touch the outline by less than 1e-6 of the radius some are missed.
std::optional<double> nearest_hit(const RoundCurve& curve, const dvec3& o, const dvec3& d, double t_near,
                                  double t_far);

// Unit normal at a point of the surface, away from the curve, with the slope of the radius.
dvec3 outward_normal(const RoundCurve& curve, const dvec3& point);

// The point of the surface next to a `point` near it (nearer to the curve than its radius of curvature).
dvec3 moved_onto(const RoundCurve& curve, const dvec3& point);

// The point of the surface next to the line o + t d where that passes nearest to the curve.
dvec3 beside(const RoundCurve& curve, const dvec3& o, const dvec3& d);

}  // namespace hybray
