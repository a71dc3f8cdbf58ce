#include "core/scene/overlay_parts.h"

#include "core/base/nearest_name.h"
#include "core/scene/shapes.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using nlohmann::json;

constexpr double kLargest = 1e30;

// A direction of unit length.
vec3 direction(const JsonObject& object, const char* key) {
  const dvec3 v(object.vector(key));
  if (!(glm::length(v) > 0.0)) object.fail(key, "has no length");
  return vec3(glm::normalize(v));
}

}  // namespace

Material overlay_material(const json& value, const std::string& file, const std::string& pointer,
                          const Material& base) {
  const JsonObject object(
      value, file, pointer,
      {"base_color", "metallic", "roughness", "transmission", "ior", "outer_ior", "absorption",
       "outer_absorption", "thin_walled", "conductor_eta", "conductor_k", "emissive", "cut_out"});
  constexpr Range kUnit{0.0, 1.0}, kIndex{1.0, 100.0}, kNotNegative{0.0, kLargest};
  Material material = base;
  material.base_color = object.vector("base_color", base.base_color, kUnit);
  material.metallic = static_cast<float>(object.number("metallic", base.metallic, kUnit));
  material.roughness = static_cast<float>(object.number("roughness", base.roughness, kUnit));
  material.transmission = static_cast<float>(object.number("transmission", base.transmission, kUnit));
  material.ior = static_cast<float>(object.number("ior", base.ior, kIndex));
  material.outer_ior = static_cast<float>(object.number("outer_ior", base.outer_ior, kIndex));
  material.absorption = object.vector("absorption", base.absorption, kNotNegative);
  material.outer_absorption = object.vector("outer_absorption", base.outer_absorption, kNotNegative);
  material.thin_walled = object.boolean("thin_walled", base.thin_walled);
  material.conductor_eta = object.vector("conductor_eta", base.conductor_eta, kNotNegative);
  material.conductor_k = object.vector("conductor_k", base.conductor_k, kNotNegative);
  material.emissive = object.vector("emissive", base.emissive, kNotNegative);
  if (object.has("cut_out")) {
    const std::optional<CutOut> shape = cut_out_named(object.text("cut_out"));
    if (!shape) object.fail("cut_out", fmt::format("'{}' is not none, leaf or fern", object.text("cut_out")));
    material.cut_out = *shape;
  }
  return material;
}

Light overlay_light(const json& value, const std::string& file, const std::string& pointer) {
  const JsonObject object(value, file, pointer,
                          {"name", "kind", "position", "direction", "color", "intensity", "range",
                           "inner_cone_angle", "outer_cone_angle"});
  const auto only = [&](const char* key, bool allowed) {
    if (object.has(key) && !allowed) object.fail(key, "a light of this kind has none");
  };
  Light light;
  light.name = object.text("name");
  const std::string kind = object.text("kind");
  if (kind == "directional")
    light.kind = LightKind::directional;
  else if (kind == "spot")
    light.kind = LightKind::spot;
  else if (kind != "point")
    object.fail("kind", fmt::format("'{}' is not point, spot or directional", kind));
  const bool placed = light.kind != LightKind::directional, spot = light.kind == LightKind::spot;
  only("position", placed);
  only("range", placed);
  only("direction", light.kind != LightKind::point);
  only("inner_cone_angle", spot);
  only("outer_cone_angle", spot);
  if (placed) light.position = object.vector("position");
  if (light.kind != LightKind::point) light.direction = direction(object, "direction");
  light.color = object.vector("color", light.color, {0.0, kLargest});
  light.intensity = static_cast<float>(object.number("intensity", Range{0.0, kLargest}));
  light.range = static_cast<float>(object.number("range", 0.0, {0.0, kLargest}));
  if (spot) {
    const double inner = object.number("inner_cone_angle", 0.0, {0.0, 90.0});
    const double outer = object.number("outer_cone_angle", 45.0, {0.0, 90.0});
    if (!(inner < outer)) object.fail("inner_cone_angle", "not smaller than outer_cone_angle");
    light.inner_cone_angle = static_cast<float>(glm::radians(inner));
    light.outer_cone_angle = static_cast<float>(glm::radians(outer));
  }
  return light;
}

Camera overlay_camera(const json& value, const std::string& file, const std::string& pointer) {
  const JsonObject object(value, file, pointer, {"name", "eye", "target", "up", "vertical_fov"});
  Camera camera;
  camera.name = object.text("name");
  camera.eye = object.vector("eye");
  camera.target = object.vector("target");
  const dvec3 axis = dvec3(camera.target) - dvec3(camera.eye);
  if (!(glm::length(axis) > 0.0)) object.fail("target", "is the eye");
  if (object.has("up")) camera.up = direction(object, "up");
  if (glm::length(glm::cross(glm::normalize(axis), dvec3(camera.up))) < 1e-4)
    object.fail(object.has("up") ? "up" : "target", "the view axis is parallel to up");
  camera.vertical_fov = static_cast<float>(object.number("vertical_fov", camera.vertical_fov, {1.0, 170.0}));
  return camera;
}

dmat4 overlay_transform(const JsonObject& object) {
  dvec3 scale(1.0);
  if (object.has("scale"))
    scale = object.value("scale").is_array() ? dvec3(object.vector("scale")) : dvec3(object.number("scale"));
  if (scale.x * scale.y * scale.z == 0.0) object.fail("scale", "a scale of zero leaves nothing");
  const dvec3 degrees(object.vector("rotate", vec3(0.0f)));
  dmat4 m = glm::translate(dmat4(1.0), dvec3(object.vector("translate", vec3(0.0f))));
  for (const int axis : {2, 1, 0}) {
    dvec3 about(0.0);
    about[axis] = 1.0;
    if (degrees[axis] != 0.0) m = glm::rotate(m, glm::radians(degrees[axis]), about);
  }
  return glm::scale(m, scale);
}

Mesh overlay_shape(const JsonObject& object) {
  const std::string shape = object.text("shape");
  if (std::find(shape_names().begin(), shape_names().end(), shape) == shape_names().end()) {
    const std::string nearest = nearest_name(shape, shape_names());
    object.fail("shape", fmt::format("no shape is named '{}'; {}", shape,
                                     nearest.empty() ? "there are: sphere, box, plane, cylinder"
                                                     : fmt::format("did you mean '{}'?", nearest)));
  }
  const int standard = default_tessellation(shape);
  const double least = standard > 1 ? 3 : 1;
  return make_shape(shape, static_cast<int>(object.integer("tessellation", standard, {least, 4096})));
}

}  // namespace hybray
