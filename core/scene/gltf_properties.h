// Materials, lights and cameras out of a glTF file: the factors only, textures are not read.
#pragma once

#include "core/scene/camera.h"
#include "core/scene/gltf_accessor.h"
#include "core/scene/light.h"
#include "core/scene/material.h"

#include <optional>

namespace hybray {

// Factors of the metallic-roughness model, emissiveFactor times KHR_materials_emissive_strength,
// KHR_materials_ior, _transmission and _volume: absorption = -ln(attenuationColor) / attenuationDistance, and
// a transmitting material without a thickness is thin_walled. What glTF has no words for stands in the
// material's extras, as {"hybray": {...}} with the keys outer_ior, absorption, outer_absorption, thin_walled,
// conductor_eta, conductor_k and cut_out; they win over the extensions. Throws InputError for a factor
// outside its range (rounding errors of exporters are forgiven).
Material read_material(const GltfFile& file, size_t material);

// What a primitive without a material is made of (glTF 2.0 specification, section 3.9): all factors at their
// defaults.
Material default_gltf_material();

// A light of KHR_lights_punctual at a node: it shines along the node's -Z axis. Throws InputError for an
// unknown type or a value out of range.
Light read_light(const GltfFile& file, size_t light, const dmat4& transform);

// A perspective camera at a node: it looks along the node's -Z axis, +Y up; nothing for an orthographic one.
std::optional<Camera> read_camera(const GltfFile& file, size_t camera, const dmat4& transform);

}  // namespace hybray
