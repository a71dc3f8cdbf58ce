// The single entries of a scene overlay: a material, a light, a camera, an added object's shape and place.
#pragma once

#include "core/scene/camera.h"
#include "core/scene/json_object.h"
#include "core/scene/light.h"
#include "core/scene/material.h"
#include "core/scene/mesh.h"

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

// `base` with the properties that `value` gives. All throw InputError("file: pointer", ...).
Material overlay_material(const nlohmann::json& value, const std::string& file, const std::string& pointer,
                          const Material& base);
Light overlay_light(const nlohmann::json& value, const std::string& file, const std::string& pointer);
Camera overlay_camera(const nlohmann::json& value, const std::string& file, const std::string& pointer);

// Scale, then rotation about x, y and z in this order (degrees), then translation.
dmat4 overlay_transform(const JsonObject& object);
Mesh overlay_shape(const JsonObject& object);

}  // namespace hybray
