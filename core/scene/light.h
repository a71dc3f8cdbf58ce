// Lights, in the terms of KHR_lights_punctual. Intensities are radiometric here: glTF's photometric numbers
// are taken as they stand.
#pragma once

#include "core/base/vec.h"

#include <string>

namespace hybray {

enum class LightKind { directional, point, spot };

struct Light {
  std::string name;
  LightKind kind = LightKind::point;
  vec3 position{0.0f};                   // metres (point, spot)
  vec3 direction{0.0f, -1.0f, 0.0f};     // unit, the way the light travels (directional, spot)
  vec3 color{1.0f};                      // linear
  float intensity = 1.0f;                // W/sr (point, spot), W/m^2 on a facing surface (directional)
  float inner_cone_angle = 0.0f;         // radians from the axis, spot
  float outer_cone_angle = 0.78539816f;  // radians from the axis, spot
  float range = 0.0f;                    // metres beyond which it may be ignored; 0 = unlimited
};

}  // namespace hybray
