#include "core/scene/overlay.h"

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/scene/file_input.h"
#include "core/scene/gltf.h"
#include "core/scene/json_object.h"
#include "core/scene/json_text.h"
#include "core/scene/mesh_cleanup.h"
#include "core/scene/overlay_parts.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using nlohmann::json;

constexpr size_t kMaxOverlayBytes = size_t{1} << 26;

json read_document(const std::filesystem::path& file) {
  const auto bytes = read_file_bytes(file, file.string(), kMaxOverlayBytes);
  return parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

JsonObject overlay_object(const json& document, const std::filesystem::path& file) {
  return JsonObject(document, file.string(), "",
                    {"$schema", "title", "source", "remove_materials", "materials", "replace_lights",
                     "lights", "objects", "cameras"});
}

SceneSource read_source(const JsonObject& overlay) {
  const json& value = overlay.value("source");
  const JsonObject source(value, overlay.file(), "/source", {"gltf", "generator", "triangles", "seed"});
  if (source.has("gltf") == source.has("generator"))
    overlay.fail("source", "expected either \"gltf\" or \"generator\"");
  SceneSource result;
  if (source.has("gltf")) {
    for (const char* key : {"triangles", "seed"})
      if (source.has(key)) source.fail(key, "only a generator has it");
    result.gltf = source.text("gltf");
    return result;
  }
  result.generator = source.text("generator");
  result.parameters.triangles = static_cast<uint32_t>(source.integer("triangles", 0, {1, double(1u << 28)}));
  result.parameters.seed = static_cast<uint32_t>(source.integer("seed", 1, {0, 4294967295.0}));
  find_generator(result.generator, source.where("generator"));
  return result;
}

// A glTF scene: a file beside the overlay, or one found by name.
Scene load_gltf_source(const std::string& gltf, const std::filesystem::path& overlay,
                       const std::string& where, const LoadNamedGltf& load_named_gltf) {
  const SceneSource source{gltf, "", {}};
  return source.is_file() ? load_gltf(confined_path(overlay.parent_path(), gltf, where))
                          : load_named_gltf(gltf, where);
}

// Numbers of the materials called `name`. Throws with the nearest name if there is none.
std::vector<uint32_t> materials_called(const Scene& scene, const std::string& name,
                                       const std::string& where) {
  std::vector<uint32_t> found;
  std::vector<std::string> names;
  for (uint32_t m = 0; m < scene.materials.size(); ++m) {
    names.push_back(scene.materials[m].name);
    if (names.back() == name) found.push_back(m);
  }
  if (!found.empty()) return found;
  const std::string nearest = nearest_name(name, names);
  throw InputError(where,
                   fmt::format("no material is named '{}'; {}", name,
                               nearest.empty() ? fmt::format("the materials are: {}", fmt::join(names, ", "))
                                               : fmt::format("did you mean '{}'?", nearest)));
}

void remove_materials(Scene& scene, const JsonObject& overlay) {
  const auto names = overlay.elements("remove_materials");
  if (names.empty()) return;
  std::vector<bool> removed(scene.materials.size());
  for (size_t i = 0; i < names.size(); ++i) {
    const std::string where = overlay.file() + ": " + overlay.pointer("remove_materials", i);
    if (!names[i]->is_string()) throw InputError(where, "expected the name of a material");
    for (const uint32_t m : materials_called(scene, names[i]->get<std::string>(), where)) removed[m] = true;
  }
  Scene kept;
  kept.name = scene.name;
  kept.materials = scene.materials;
  kept.lights = scene.lights;
  kept.cameras = scene.cameras;
  for (const SceneObject& object : scene.objects)
    if (!removed[object.material])
      append_mesh(kept, object_mesh(scene, object), mat4(1.0f), object.material, object.name);
  for (const AnalyticSurface& surface : scene.analytic)
    if (!removed[surface.material]) append_analytic(kept, surface);
  for (const RoundCurve& curve : scene.curves)
    if (!removed[curve.material]) append_curve(kept, curve);
  scene = std::move(kept);
}

void override_materials(Scene& scene, const JsonObject& overlay) {
  if (!overlay.has("materials")) return;
  const json& overrides = overlay.value("materials");
  if (!overrides.is_object()) overlay.fail("materials", "expected an object of materials by name");
  for (const auto& [name, value] : overrides.items()) {
    const std::string pointer = overlay.pointer("materials") + "/" + name;
    for (const uint32_t m : materials_called(scene, name, overlay.file() + ": " + pointer))
      scene.materials[m] = overlay_material(value, overlay.file(), pointer, scene.materials[m]);
  }
}

void add_lights(Scene& scene, const JsonObject& overlay) {
  if (overlay.boolean("replace_lights", false)) scene.lights.clear();
  const auto lights = overlay.elements("lights");
  for (size_t i = 0; i < lights.size(); ++i)
    scene.lights.push_back(overlay_light(*lights[i], overlay.file(), overlay.pointer("lights", i)));
}

void add_cameras(Scene& scene, const JsonObject& overlay) {
  const auto cameras = overlay.elements("cameras");
  std::vector<std::string> added;
  for (size_t i = 0; i < cameras.size(); ++i) {
    const Camera camera = overlay_camera(*cameras[i], overlay.file(), overlay.pointer("cameras", i));
    if (std::find(added.begin(), added.end(), camera.name) != added.end())
      throw InputError(overlay.file() + ": " + overlay.pointer("cameras", i) + "/name",
                       fmt::format("two cameras are named '{}'", camera.name));
    added.push_back(camera.name);
    std::erase_if(scene.cameras, [&](const Camera& other) { return other.name == camera.name; });
    scene.cameras.push_back(camera);
  }
}

// The material of an added object: one of the scene by name, or a new one given in place.
std::optional<uint32_t> object_material(Scene& scene, const JsonObject& object,
                                        const std::string& object_name) {
  if (!object.has("material")) return std::nullopt;
  const json& value = object.value("material");
  if (value.is_string())
    return materials_called(scene, value.get<std::string>(), object.where("material")).front();
  Material base;
  base.name = object_name;
  scene.materials.push_back(overlay_material(value, object.file(), object.pointer("material"), base));
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

// An added object: where it stands, what it is made of, and how its entry is named in messages.
struct Placement {
  std::string name, where;
  dmat4 transform;
  std::optional<uint32_t> material;
};

void add_mesh(Scene& scene, const Mesh& mesh, const Placement& placement, uint32_t material,
              const std::string& name) {
  Mesh world = transformed(mesh, placement.transform);
  if (!all_finite(world)) throw InputError(placement.where, "a vertex lies beyond the range of float");
  remove_zero_area(world);
  append_mesh(scene, world, mat4(1.0f), material, name);
}

void add_scene(Scene& scene, const Scene& added, const Placement& placement) {
  const auto first = static_cast<uint32_t>(scene.materials.size());
  if (!placement.material)
    for (const Material& material : added.materials) {
      scene.materials.push_back(material);
      scene.materials.back().name = placement.name + "/" + material.name;
    }
  for (const SceneObject& object : added.objects)
    add_mesh(scene, object_mesh(added, object), placement,
             placement.material ? *placement.material : first + object.material,
             placement.name + "/" + object.name);
}

void add_shape(Scene& scene, const JsonObject& object, const Placement& placement) {
  uint32_t material = placement.material.value_or(static_cast<uint32_t>(scene.materials.size()));
  if (!placement.material) scene.materials.emplace_back().name = placement.name;
  add_mesh(scene, overlay_shape(object), placement, material, placement.name);
}

void add_objects(Scene& scene, const JsonObject& overlay, const std::filesystem::path& file,
                 const LoadNamedGltf& load_named_gltf) {
  const auto objects = overlay.elements("objects");
  for (size_t i = 0; i < objects.size(); ++i) {
    const std::string pointer = overlay.pointer("objects", i);
    const JsonObject object(
        *objects[i], overlay.file(), pointer,
        {"name", "shape", "gltf", "translate", "rotate", "scale", "material", "tessellation"});
    Placement placement{object.text("name"), overlay.file() + ": " + pointer, overlay_transform(object), {}};
    if (object.has("shape") == object.has("gltf"))
      throw InputError(placement.where, "expected either \"shape\" or \"gltf\"");
    placement.material = object_material(scene, object, placement.name);
    if (object.has("shape")) {
      add_shape(scene, object, placement);
    } else {
      if (object.has("tessellation")) object.fail("tessellation", "only a shape has it");
      add_scene(scene, load_gltf_source(object.text("gltf"), file, object.where("gltf"), load_named_gltf),
                placement);
    }
  }
}

}  // namespace

const procedural::Generator& find_generator(const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const procedural::Generator& generator : procedural::generators()) {
    if (generator.name == name) return generator;
    names.emplace_back(generator.name);
  }
  const std::string nearest = nearest_name(name, names);
  throw InputError(where, fmt::format("no generator is named '{}'; {}", name,
                                      nearest.empty() ? fmt::format("there are: {}", fmt::join(names, ", "))
                                                      : fmt::format("did you mean '{}'?", nearest)));
}

SceneSource read_overlay_source(const std::filesystem::path& file) {
  const json document = read_document(file);
  return read_source(overlay_object(document, file));
}

Scene load_overlay(const std::filesystem::path& file, const LoadNamedGltf& load_named_gltf) {
  const json document = read_document(file);
  const JsonObject overlay = overlay_object(document, file);
  overlay.text("title", "");
  const SceneSource source = read_source(overlay);
  Scene scene = source.generator.empty()
                    ? load_gltf_source(source.gltf, file, overlay.where("source"), load_named_gltf)
                    : find_generator(source.generator, file.string()).generate(source.parameters);
  scene.name = file.stem().string();
  remove_materials(scene, overlay);
  override_materials(scene, overlay);
  add_lights(scene, overlay);
  add_objects(scene, overlay, file, load_named_gltf);
  add_cameras(scene, overlay);
  if (scene.primitive_count() == 0) throw InputError(file.string(), "the scene has no surfaces");
  update_content_hash(scene);
  return scene;
}

}  // namespace hybray
