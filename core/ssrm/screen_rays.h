// Rays in screen projection space: the SSRM paper's ray buffers.
//
// A world ray o + t d with view depths w0 (origin) and w1 (of the direction) is, on the screen, a straight
// line in pixels and march depth. Its parameter L runs evenly along that line: t = L / (1 - L k), k = w1 /
// w0, so that near the origin L is the distance in metres; L = 1 / k is infinitely far away.
#pragma once

#include "core/base/ray_stream.h"
#include "core/gbuffer/view.h"
#include "core/ssrm/verdict.h"

#include <span>
#include <vector>

namespace hybray::ssrm {

// One ray; `Real` is float for marching, double (the same float values, promoted) for truth.
template <class Real>
struct ScreenRay {
  Real ox, oy, oz;  // origin: pixels, pixels, march depth
  Real dx, dy, dz;  // change of each by a unit of L; |dx| and |dy| are at least 2^-126, so that division by
                    // them is safe
  Real l_end;  // L where the ray leaves the depth range of the view or the scene's bounds; the screen's sides
               // are found by the march
  Verdict end;  // what leaving there means: viewer, miss or offscreen (far plane)

  // March depth gained since the origin. Stored depths are compared as `stored - oz` against this, which
  // keeps the precision of the difference even where both depths crowd near 1 (standard convention).
  Real rise(Real l) const { return l * dz; }
};

// Structure of arrays, in the order of the world rays they come from.
struct ScreenRays {
  std::vector<float> ox, oy, oz, dx, dy, dz, l_end;
  std::vector<Verdict> end;

  size_t size() const { return end.size(); }
  size_t memory_bytes() const { return size() * (7 * sizeof(float) + sizeof(Verdict)); }
  void resize(size_t n) {
    for (auto* a : {&ox, &oy, &oz, &dx, &dy, &dz, &l_end}) a->resize(n);
    end.resize(n);
  }
  template <class Real>
  ScreenRay<Real> get(size_t i) const {
    return {Real(ox[i]), Real(oy[i]), Real(oz[i]),    Real(dx[i]),
            Real(dy[i]), Real(dz[i]), Real(l_end[i]), end[i]};
  }
};

// How much the scene's bounds are enlarged, as a fraction of their diagonal, before a ray may leave them:
// surfaces that lie on the bounds are crossed first.
constexpr float kBoundsMargin = 0.01f;

// Projects world rays (in double, rounded to float once), all threads. Origins must lie in front of the eye.
// `lengths`, metres, end the rays before they leave: as MISS, since nothing was in the way. Empty: they have
// no end of their own.
ScreenRays project_rays(const RayStream& rays, const View& view, const Bounds3& scene_bounds,
                        std::span<const float> lengths = {});

// Distance t, metres, of screen parameter `l` along world ray `i`.
double distance_of(const RayStream& rays, size_t i, const View& view, double l);

// The other way: L of distance `t`.
double parameter_of(const RayStream& rays, size_t i, const View& view, double t);

}  // namespace hybray::ssrm
