// A light as a source of flux: its intensity by direction, and the whole domain that it emits into.
//
// Point and spot lights emit into solid angle (sr), directional lights through area (m^2); both are called
// the measure here.
#pragma once

#include "core/gbuffer/light_frame.h"
#include "core/scene/light.h"

#include <algorithm>

namespace hybray::caustics {

// Intensity by channel, W/sr along unit `direction` for point and spot lights, W/m^2 for directional ones.
// Spot lights fall off between their cones as KHR_lights_punctual says. `range` is not applied: light does
// not end.
struct Intensity {
  dvec3 full, axis;
  bool spot;
  double outer = 0.0, scale = 0.0;  // cosine of the outer cone, 1 / difference of the cones' cosines

  explicit Intensity(const Light& light);
  dvec3 operator()(const dvec3& direction) const {
    if (!spot) return full;
    const double falloff = std::clamp((glm::dot(direction, axis) - outer) * scale, 0.0, 1.0);
    return full * (falloff * falloff);
  }
};
inline dvec3 intensity(const Light& light, const dvec3& direction) {
  return Intensity(light)(direction);
}

// Whether the light emits anything at all: a cone without width does not.
bool emits(const Light& light);

// Uniform sampling of the whole domain: the sphere, the cone of a spot light, or for a directional light the
// rectangle that covers the scene's bounds.
class UniformDomain {
 public:
  UniformDomain(const Light& light, const Bounds3& scene);
  double measure() const { return measure_; }
  // A ray for (u, v) in [0, 1)^2, uniform in the measure.
  void sample(double u, double v, dvec3& origin, dvec3& direction) const;

 private:
  LightKind kind_;
  double measure_, cos_cone_ = -1.0;
  dvec3 origin_, axis_, right_, down_;
  LightFrame plane_;  // directional
};

}  // namespace hybray::caustics
