#include "core/scene/gltf_properties.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <tiny_gltf.h>

namespace hybray {
namespace {

constexpr double kRounding = 1e-5;  // how far outside its range a factor may be written
constexpr double kUnbounded = 1e30;

float in_range(double value, double lower, double upper, const std::string& where) {
  if (!(value >= lower - kRounding && value <= upper + kRounding))
    throw InputError(where, upper < kUnbounded
                                ? fmt::format("{} is not between {} and {}", value, lower, upper)
                                : fmt::format("{} is below {} or not finite", value, lower));
  return static_cast<float>(std::clamp(value, lower, upper));
}

vec3 color(const std::vector<double>& values, double upper, const std::string& where) {
  vec3 result;
  for (int c = 0; c < 3; ++c) result[c] = in_range(values[static_cast<size_t>(c)], 0.0, upper, where);
  return result;
}

// A number inside a material's extension.
double extension_number(const tinygltf::ExtensionMap& extensions, const char* extension, const char* key,
                        double otherwise) {
  const auto found = extensions.find(extension);
  if (found == extensions.end() || !found->second.Has(key)) return otherwise;
  return found->second.Get(key).GetNumberAsDouble();
}

dvec3 vector_of(const tinygltf::Value& array) {
  return {array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble(),
          array.Get(2).GetNumberAsDouble()};
}

vec3 not_negative(const dvec3& v, const std::string& where) {
  return color({v.x, v.y, v.z}, kUnbounded, where);
}

// KHR_materials_volume, whose thickness makes a body of what is a sheet without it.
void read_volume(const tinygltf::ExtensionMap& extensions, const std::string& at, Material& to) {
  const auto found = extensions.find("KHR_materials_volume");
  to.thin_walled = to.transmission > 0.0f;
  if (found == extensions.end()) return;
  const tinygltf::Value& volume = found->second;
  const auto number = [&](const char* key, double otherwise) {
    return volume.Has(key) ? volume.Get(key).GetNumberAsDouble() : otherwise;
  };
  if (in_range(number("thicknessFactor", 0.0), 0.0, kUnbounded, at + "/thicknessFactor") > 0.0f)
    to.thin_walled = false;
  // Black would absorb without bound; e^-69 of the light is as black as float can tell.
  constexpr double kBlack = 1e-30;
  const double distance = number("attenuationDistance", std::numeric_limits<double>::infinity());
  if (!(distance > 0.0))
    throw InputError(at + "/attenuationDistance", fmt::format("{} is not above 0", distance));
  if (!volume.Has("attenuationColor")) return;
  const dvec3 tint = vector_of(volume.Get("attenuationColor"));
  dvec3 absorption;
  for (int c = 0; c < 3; ++c) {
    in_range(tint[c], 0.0, 1.0, at + "/attenuationColor");
    absorption[c] = std::max(0.0, -std::log(std::max(tint[c], kBlack)) / distance);
  }
  to.absorption = not_negative(absorption, at);
}

void read_our_extras(const tinygltf::Value& extras, const std::string& at, Material& to) {
  if (!extras.IsObject() || !extras.Has("hybray")) return;
  const tinygltf::Value& ours = extras.Get("hybray");
  if (ours.Has("outer_ior"))
    to.outer_ior = in_range(ours.Get("outer_ior").GetNumberAsDouble(), 1.0, kUnbounded, at + "/outer_ior");
  if (ours.Has("thin_walled")) to.thin_walled = ours.Get("thin_walled").Get<bool>();
  const auto vector = [&](const char* key, vec3& target) {
    if (ours.Has(key)) target = not_negative(vector_of(ours.Get(key)), at + "/" + key);
  };
  vector("absorption", to.absorption);
  vector("outer_absorption", to.outer_absorption);
  vector("conductor_eta", to.conductor_eta);
  vector("conductor_k", to.conductor_k);
  if (!ours.Has("cut_out")) return;
  const std::string& name = ours.Get("cut_out").Get<std::string>();
  const std::optional<CutOut> shape = cut_out_named(name);
  if (!shape) throw InputError(at + "/cut_out", fmt::format("'{}' is not none, leaf or fern", name));
  to.cut_out = *shape;
}

vec3 unit(const dvec3& v) {
  return vec3(glm::normalize(v));
}

}  // namespace

Material default_gltf_material() {
  Material material;
  material.name = "default";
  material.base_color = vec3(1.0f);
  material.metallic = 1.0f;
  return material;
}

Material read_material(const GltfFile& file, size_t index) {
  const tinygltf::Material& from = file.model.materials[index];
  const std::string at = file.at(fmt::format("/materials/{}", index));
  const std::string pbr = at + "/pbrMetallicRoughness", extensions = at + "/extensions";
  Material to;
  to.name = from.name.empty() ? fmt::format("material {}", index) : from.name;
  const auto& factors = from.pbrMetallicRoughness;
  to.base_color = color(factors.baseColorFactor, 1.0, pbr + "/baseColorFactor");
  to.metallic = in_range(factors.metallicFactor, 0.0, 1.0, pbr + "/metallicFactor");
  to.roughness = in_range(factors.roughnessFactor, 0.0, 1.0, pbr + "/roughnessFactor");
  to.transmission =
      in_range(extension_number(from.extensions, "KHR_materials_transmission", "transmissionFactor", 0.0),
               0.0, 1.0, extensions + "/KHR_materials_transmission/transmissionFactor");
  to.ior = in_range(extension_number(from.extensions, "KHR_materials_ior", "ior", 1.5), 1.0, kUnbounded,
                    extensions + "/KHR_materials_ior/ior");
  const double strength =
      extension_number(from.extensions, "KHR_materials_emissive_strength", "emissiveStrength", 1.0);
  in_range(strength, 0.0, kUnbounded, extensions + "/KHR_materials_emissive_strength/emissiveStrength");
  std::vector<double> emissive = from.emissiveFactor;
  for (double& e : emissive) e *= strength;
  to.emissive = color(emissive, kUnbounded, at + "/emissiveFactor");
  read_volume(from.extensions, extensions + "/KHR_materials_volume", to);
  read_our_extras(from.extras, at + "/extras/hybray", to);
  return to;
}

Light read_light(const GltfFile& file, size_t index, const dmat4& transform) {
  const tinygltf::Light& from = file.model.lights[index];
  const std::string at = file.at(fmt::format("/extensions/KHR_lights_punctual/lights/{}", index));
  Light to;
  if (from.type == "directional")
    to.kind = LightKind::directional;
  else if (from.type == "point")
    to.kind = LightKind::point;
  else if (from.type == "spot")
    to.kind = LightKind::spot;
  else
    throw InputError(at + "/type", fmt::format("'{}' is not directional, point or spot", from.type));
  to.position = vec3(dvec3(transform[3]));
  to.direction = unit(-dvec3(transform[2]));
  if (!from.color.empty()) to.color = color(from.color, kUnbounded, at + "/color");
  to.intensity = in_range(from.intensity, 0.0, kUnbounded, at + "/intensity");
  to.range = in_range(from.range, 0.0, kUnbounded, at + "/range");
  if (to.kind == LightKind::spot) {
    constexpr double kQuarterTurn = 1.5707963267948966;
    to.inner_cone_angle = in_range(from.spot.innerConeAngle, 0.0, kQuarterTurn, at + "/spot/innerConeAngle");
    to.outer_cone_angle = in_range(from.spot.outerConeAngle, 0.0, kQuarterTurn, at + "/spot/outerConeAngle");
    if (to.inner_cone_angle >= to.outer_cone_angle)
      throw InputError(at + "/spot", "innerConeAngle is not smaller than outerConeAngle");
  }
  return to;
}

std::optional<Camera> read_camera(const GltfFile& file, size_t index, const dmat4& transform) {
  const tinygltf::Camera& from = file.model.cameras[index];
  if (from.type != "perspective") return std::nullopt;
  const double degrees = glm::degrees(from.perspective.yfov);
  if (!(degrees > 0.0 && degrees < 180.0))
    throw InputError(file.at(fmt::format("/cameras/{}/perspective/yfov", index)),
                     fmt::format("{} radians are not between 0 and pi", from.perspective.yfov));
  Camera to;
  to.eye = vec3(dvec3(transform[3]));
  to.target = vec3(dvec3(transform[3]) - glm::normalize(dvec3(transform[2])));
  to.up = unit(dvec3(transform[1]));
  to.vertical_fov = static_cast<float>(degrees);
  return to;
}

}  // namespace hybray
