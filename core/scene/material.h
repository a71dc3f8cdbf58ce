// Surface description, in the terms of glTF 2.0's metallic-roughness model and its ior and transmission
// extensions.
#pragma once

#include "core/base/vec.h"

#include <string>

namespace hybray {

struct Material {
  std::string name;
  vec3 base_color{0.8f};      // linear, each in [0, 1]
  float metallic = 0.0f;      // [0, 1]
  float roughness = 1.0f;     // [0, 1]
  float transmission = 0.0f;  // share of light that enters instead of scattering diffusely, [0, 1]
                              // (KHR_materials_transmission)
  float ior = 1.5f;           // index of refraction, >= 1 (KHR_materials_ior)
  vec3 emissive{0.0f};        // emitted radiance, W / (sr m^2)
};

}  // namespace hybray
