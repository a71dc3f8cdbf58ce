#include "core/base/error.h"
#include "core/scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include <fmt/format.h>
#include <glm/exponential.hpp>
#include <glm/trigonometric.hpp>
#include <tiny_gltf.h>

namespace hybray {
namespace {

template <class T>
int add_accessor(tinygltf::Model& model, const std::vector<T>& values, int type, int component_type,
                 int count, int target) {
  auto& bytes = model.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes.size();
  view.byteLength = values.size() * sizeof(T);
  view.target = target;
  bytes.resize(view.byteOffset + view.byteLength);
  std::memcpy(bytes.data() + view.byteOffset, values.data(), view.byteLength);
  model.bufferViews.push_back(view);

  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
  accessor.componentType = component_type;
  accessor.count = static_cast<size_t>(count);
  accessor.type = type;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

int add_vectors(tinygltf::Model& model, const std::vector<vec3>& values) {
  return add_accessor(model, values, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT,
                      static_cast<int>(values.size()), TINYGLTF_TARGET_ARRAY_BUFFER);
}

// Bounds of the positions, which glTF asks for.
void set_bounds(tinygltf::Accessor& accessor, const std::vector<vec3>& positions) {
  Bounds3 bounds;
  for (const vec3& p : positions) bounds.extend(p);
  accessor.minValues = {bounds.lower.x, bounds.lower.y, bounds.lower.z};
  accessor.maxValues = {bounds.upper.x, bounds.upper.y, bounds.upper.z};
}

tinygltf::Mesh gltf_mesh(tinygltf::Model& model, const Scene& scene, const SceneObject& object) {
  const Mesh mesh = object_mesh(scene, object);
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = static_cast<int>(object.material);
  const int positions = add_vectors(model, mesh.positions);
  set_bounds(model.accessors[static_cast<size_t>(positions)], mesh.positions);
  primitive.attributes["POSITION"] = positions;
  primitive.attributes["NORMAL"] = add_vectors(model, mesh.normals);
  primitive.indices =
      add_accessor(model, mesh.triangles, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                   static_cast<int>(3 * mesh.triangles.size()), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  tinygltf::Mesh result;
  result.name = object.name;
  result.primitives.push_back(primitive);
  return result;
}

tinygltf::Value number_object(const char* key, double value) {
  return tinygltf::Value(tinygltf::Value::Object{{key, tinygltf::Value(value)}});
}

tinygltf::Value vector_value(const dvec3& v) {
  return tinygltf::Value(
      tinygltf::Value::Array{tinygltf::Value(v.x), tinygltf::Value(v.y), tinygltf::Value(v.z)});
}

// A transmitting body in glTF's words, for other programs: how thick it is is the geometry's to say, and its
// colour is given at the depth where the strongest absorption leaves 1/e.
tinygltf::Value volume_object(const Material& from) {
  tinygltf::Value::Object volume{{"thicknessFactor", tinygltf::Value(1.0)}};
  const dvec3 absorption(from.absorption);
  if (const double most = std::max({absorption.x, absorption.y, absorption.z}); most > 0.0) {
    volume["attenuationDistance"] = tinygltf::Value(1.0 / most);
    volume["attenuationColor"] = vector_value(glm::exp(-absorption / most));
  }
  return tinygltf::Value(volume);
}

// The counterpart of the loader's read_our_extras; what is at its default is left out. The absorption stands
// here besides in the extension, which cannot say it to the last bit.
tinygltf::Value our_extras(const Material& from) {
  const Material standard;
  tinygltf::Value::Object ours;
  if (from.outer_ior != standard.outer_ior)
    ours["outer_ior"] = tinygltf::Value(static_cast<double>(from.outer_ior));
  if (from.thin_walled && from.transmission == 0.0f) ours["thin_walled"] = tinygltf::Value(true);
  const auto vector = [&](const char* key, const vec3& value) {
    if (value != vec3(0.0f)) ours[key] = vector_value(dvec3(value));
  };
  vector("absorption", from.absorption);
  vector("outer_absorption", from.outer_absorption);
  vector("conductor_eta", from.conductor_eta);
  vector("conductor_k", from.conductor_k);
  if (from.cut_out != CutOut::none) ours["cut_out"] = tinygltf::Value(std::string(label(from.cut_out)));
  if (ours.empty()) return {};
  return tinygltf::Value(tinygltf::Value::Object{{"hybray", tinygltf::Value(ours)}});
}

tinygltf::Material gltf_material(const Material& from) {
  tinygltf::Material to;
  to.name = from.name;
  to.pbrMetallicRoughness.baseColorFactor = {from.base_color.x, from.base_color.y, from.base_color.z, 1.0};
  to.pbrMetallicRoughness.metallicFactor = from.metallic;
  to.pbrMetallicRoughness.roughnessFactor = from.roughness;
  // The factor may not exceed 1; a strength that is a power of two keeps every bit.
  double strength = 1.0;
  while (std::max({from.emissive.x, from.emissive.y, from.emissive.z}) > strength) strength *= 2.0;
  to.emissiveFactor = {from.emissive.x / strength, from.emissive.y / strength, from.emissive.z / strength};
  if (strength > 1.0)
    to.extensions["KHR_materials_emissive_strength"] = number_object("emissiveStrength", strength);
  to.extensions["KHR_materials_ior"] = number_object("ior", from.ior);
  if (from.transmission > 0.0f)
    to.extensions["KHR_materials_transmission"] = number_object("transmissionFactor", from.transmission);
  if (from.transmission > 0.0f && !from.thin_walled)
    to.extensions["KHR_materials_volume"] = volume_object(from);
  to.extras = our_extras(from);
  return to;
}

// A transform whose -Z axis is `forward` and whose +Y axis is nearest to `up`.
std::vector<double> looking(const dvec3& eye, const dvec3& forward, const dvec3& up) {
  const dvec3 z = -glm::normalize(forward);
  const dvec3 helper = std::abs(z.y) < 0.99 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0);
  const dvec3 side = glm::cross(up, z);
  const dvec3 x = glm::normalize(glm::length(side) > 1e-6 ? side : glm::cross(helper, z));
  const dvec3 y = glm::cross(z, x);
  return {x.x, x.y, x.z, 0.0, y.x, y.y, y.z, 0.0, z.x, z.y, z.z, 0.0, eye.x, eye.y, eye.z, 1.0};
}

void add_node(tinygltf::Model& model, tinygltf::Node node, const std::string& name) {
  node.name = name;
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
  model.nodes.push_back(std::move(node));
}

// The counterpart of the loader's light_of.
template <class Node>
void set_light(Node& node, int index) {
  if constexpr (requires { node.light; }) {
    node.light = index;
  } else {
    node.extensions["KHR_lights_punctual"] =
        tinygltf::Value(tinygltf::Value::Object{{"light", tinygltf::Value(index)}});
  }
}

void add_light(tinygltf::Model& model, const Light& from) {
  tinygltf::Light to;
  to.name = from.name;
  to.type = from.kind == LightKind::directional ? "directional"
            : from.kind == LightKind::point     ? "point"
                                                : "spot";
  to.color = {from.color.x, from.color.y, from.color.z};
  to.intensity = from.intensity;
  to.range = from.range;
  to.spot.innerConeAngle = from.inner_cone_angle;
  to.spot.outerConeAngle = from.outer_cone_angle;
  tinygltf::Node node;
  node.matrix = looking(dvec3(from.position), dvec3(from.direction), dvec3(0.0, 1.0, 0.0));
  set_light(node, static_cast<int>(model.lights.size()));
  model.lights.push_back(to);
  add_node(model, node, from.name);
}

void add_camera(tinygltf::Model& model, const Camera& from) {
  tinygltf::Camera to;
  to.name = from.name;
  to.type = "perspective";
  to.perspective.yfov = glm::radians(static_cast<double>(from.vertical_fov));
  to.perspective.znear = 0.01;
  to.perspective.aspectRatio = 16.0 / 9.0;
  to.perspective.zfar = 1e4;
  tinygltf::Node node;
  node.matrix = looking(dvec3(from.eye), dvec3(from.target) - dvec3(from.eye), dvec3(from.up));
  node.camera = static_cast<int>(model.cameras.size());
  model.cameras.push_back(to);
  add_node(model, node, from.name);
}

void name_extensions(tinygltf::Model& model) {
  if (!model.lights.empty()) model.extensionsUsed.emplace_back("KHR_lights_punctual");
  for (const char* name : {"KHR_materials_emissive_strength", "KHR_materials_ior",
                           "KHR_materials_transmission", "KHR_materials_volume"})
    if (std::any_of(model.materials.begin(), model.materials.end(),
                    [&](const tinygltf::Material& m) { return m.extensions.count(name) > 0; }))
      model.extensionsUsed.emplace_back(name);
}

tinygltf::Model gltf_model(const Scene& scene) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "hybray";
  model.defaultScene = 0;
  model.scenes.resize(1);
  model.scenes[0].name = scene.name;
  model.buffers.resize(1);
  for (const Material& material : scene.materials) model.materials.push_back(gltf_material(material));
  for (const SceneObject& object : scene.objects) {
    if (object.triangle_count == 0) continue;
    tinygltf::Node node;
    node.mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(gltf_mesh(model, scene, object));
    add_node(model, node, object.name);
  }
  for (const Light& light : scene.lights) add_light(model, light);
  for (const Camera& camera : scene.cameras) add_camera(model, camera);
  name_extensions(model);
  return model;
}

}  // namespace

void save_gltf(const Scene& scene, const std::filesystem::path& file) {
  if (!scene.analytic.empty())
    throw InputError(file.string(),
                     fmt::format("glTF has triangles only; the analytic surface '{}' of scene '{}' has none",
                                 scene.analytic.front().name, scene.name));
  if (!scene.curves.empty())
    throw InputError(file.string(), fmt::format("glTF has triangles only; scene '{}' has {} curves",
                                                scene.name, scene.curves.size()));
  const tinygltf::Model model = gltf_model(scene);
  if (model.buffers[0].data.size() > 0xf0000000u)
    throw InputError(file.string(), "the scene does not fit into the 4 GiB that binary glTF allows");
  std::filesystem::path part = file;
  part += ".part";
  {
    std::ofstream stream(part, std::ios::binary);
    tinygltf::TinyGLTF writer;
    const bool written = stream && writer.WriteGltfSceneToStream(&model, stream, false, true);
    stream.close();
    if (!written || !stream) {
      std::error_code ignored;
      std::filesystem::remove(part, ignored);
      throw RuntimeError(fmt::format("cannot write '{}'", file.string()));
    }
  }
  std::error_code error;
  std::filesystem::rename(part, file, error);
  if (error) throw RuntimeError(fmt::format("cannot write '{}': {}", file.string(), error.message()));
}

}  // namespace hybray
