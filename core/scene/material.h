// Surface description, in the terms of glTF 2.0's metallic-roughness model and its ior, transmission and
// volume extensions, with what exact optics needs besides: the medium on the outer side, and the complex
// index of metals.
#pragma once

#include "core/base/vec.h"
#include "core/scene/cut_out.h"

#include <string>

namespace hybray {

struct Material {
  std::string name;
  vec3 base_color{0.8f};        // linear, each in [0, 1]
  float metallic = 0.0f;        // [0, 1]
  float roughness = 1.0f;       // [0, 1]
  float transmission = 0.0f;    // share of light that enters instead of scattering diffusely, [0, 1]
                                // (KHR_materials_transmission)
  float ior = 1.5f;             // index of refraction of the inner medium, >= 1 (KHR_materials_ior)
  float outer_ior = 1.0f;       // of the medium on the side that the geometric normal points to, >= 1
  vec3 absorption{0.0f};        // of the inner medium, 1/m: light falls by exp(-absorption * distance)
  vec3 outer_absorption{0.0f};  // of the outer medium, 1/m
  bool thin_walled = false;  // a transmitting sheet without thickness: light goes straight on. Otherwise the
                             // surfaces of a transmitting material must close (KHR_materials_volume)
  vec3 conductor_eta{0.0f};  // complex index of refraction of a metal, eta + i k, by channel. Where both are
  vec3 conductor_k{0.0f};    // zero its reflectance is base_color at every angle
  vec3 emissive{0.0f};       // emitted radiance, W / (sr m^2)
  CutOut cut_out = CutOut::none;  // which parts of each triangle are there
};

}  // namespace hybray
