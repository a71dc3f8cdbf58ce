// Round curves by brute force in double: the nearest point of the curve by sampling and bisection, and a ray
// by steps no longer than the distance from the surface allows.
#pragma once

#include "core/scene/round_curve.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hybray::test {

class CurveTruth {
 public:
  explicit CurveTruth(const RoundCurve& curve) : curve_(curve) {}

  // Bernstein's form and its derivative.
  dvec4 at(double u) const {
    const double v = 1.0 - u;
    return v * v * v * c(0) + 3.0 * v * v * u * c(1) + 3.0 * v * u * u * c(2) + u * u * u * c(3);
  }
  dvec4 slope(double u) const {
    const double v = 1.0 - u;
    return 3.0 * (v * v * (c(1) - c(0)) + 2.0 * v * u * (c(2) - c(1)) + u * u * (c(3) - c(2)));
  }

  double nearest_parameter(const dvec3& x) const {
    constexpr int kSamples = 100;
    const auto distance = [&](int i) { return glm::length(x - dvec3(at(i / double{kSamples}))); };
    int best = 0;
    for (int i = 1; i <= kSamples; ++i)
      if (distance(i) < distance(best)) best = i;
    double low = std::max(0, best - 1) / double{kSamples},
           high = std::min(kSamples, best + 1) / double{kSamples};
    for (int i = 0; i < 60; ++i) {
      const double u = 0.5 * (low + high);
      (glm::dot(x - dvec3(at(u)), dvec3(slope(u))) > 0.0 ? low : high) = u;
    }
    return 0.5 * (low + high);
  }

  // Distance from the curve less its radius there: zero on the surface, and of slope at most `lipschitz`.
  double field(const dvec3& x) const {
    const dvec4 p = at(nearest_parameter(x));
    return glm::length(x - dvec3(p)) - p.w;
  }

  // First t in [0, t_far] at which the field of o + t d (d of unit length) changes its sign and the curve's
  // nearest point is not one of its ends. Chords shorter than `shortest` may be passed over.
  std::optional<double> first_hit(const dvec3& o, const dvec3& d, double t_far, double lipschitz,
                                  double shortest = 1e-6) const {
    double t = 0.0, f = field(o);
    while (t < t_far) {
      const double next = t + std::max(std::abs(f) / lipschitz, shortest), g = field(o + next * d);
      if ((f < 0.0) != (g < 0.0)) {
        double low = t, high = next;
        for (int i = 0; i < 50; ++i) {
          const double middle = 0.5 * (low + high);
          ((field(o + middle * d) < 0.0) == (f < 0.0) ? low : high) = middle;
        }
        const double u = nearest_parameter(o + high * d);
        if (u > 1e-9 && u < 1.0 - 1e-9) return high;
      }
      t = next, f = g;
    }
    return std::nullopt;
  }

 private:
  dvec4 c(size_t i) const { return dvec4(curve_.control[i]); }
  RoundCurve curve_;
};

// A curve about 1.5 long through the cube [-1, 1]^3 that bends gently and tapers.
template <class Unit>
RoundCurve random_curve(const Unit& unit, double thickness) {
  const dvec3 a(0.9 * unit(0), 0.9 * unit(1), 0.9 * unit(2));
  const dvec3 along = 0.5 * glm::normalize(dvec3(unit(3), unit(4), unit(5)) + dvec3(0, 1e-3, 0));
  dvec3 p = a - 1.5 * along;
  RoundCurve curve;
  for (uint32_t i = 0; i < 4; ++i) {
    const double radius = thickness * (0.6 + 0.35 * unit(6 + i));
    curve.control[i] = vec4(vec3(p), static_cast<float>(radius));
    p += along + 0.16 * dvec3(unit(10 + 3 * i), unit(11 + 3 * i), unit(12 + 3 * i));
  }
  return curve;
}

}  // namespace hybray::test
