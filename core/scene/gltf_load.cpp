#include "core/base/error.h"
#include "core/scene/gltf.h"
#include "core/scene/gltf_check.h"
#include "core/scene/gltf_mesh.h"
#include "core/scene/gltf_nodes.h"
#include "core/scene/gltf_properties.h"
#include "core/scene/json_text.h"
#include "core/scene/mesh_cleanup.h"

#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

namespace hybray {
namespace {

// Index of a node's light, or -1. tinygltf before 2.9 leaves the extension as it is; later ones move it into
// a member of its own.
template <class Node>
int light_of(const Node& node) {
  if constexpr (requires { node.light; }) {
    return node.light;
  } else {
    const auto extension = node.extensions.find("KHR_lights_punctual");
    return extension == node.extensions.end() ? -1 : extension->second.Get("light").GetNumberAsInt();
  }
}

// tinygltf turns the document into structs, and no more: it opens no file and sees neither buffers nor
// images, so that a scene whose textures are missing or cannot be decoded still loads.
tinygltf::Model parse_model(nlohmann::json document, const std::string& file) {
  for (const char* part : {"buffers", "images", "textures", "samplers", "skins", "animations"})
    document.erase(part);
  tinygltf::TinyGLTF parser;
  tinygltf::Model model;
  std::string errors, warnings;
  const std::string text = document.dump();
  bool good = false;
  try {
    good = parser.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                      static_cast<unsigned>(text.size()), "");
  } catch (const std::exception& error) {
    errors += error.what();
  }
  while (!errors.empty() && errors.back() == '\n') errors.pop_back();
  if (!good) throw InputError(file, errors.empty() ? "not a valid glTF file" : errors);
  return model;
}

// Assembles the scene node by node. Meshes are read once, however many nodes place them.
class Assembler {
 public:
  Assembler(const GltfFile& file, size_t max_triangles, Scene& scene)
      : file_(file), max_triangles_(max_triangles), scene_(scene), meshes_(file.model.meshes.size()) {
    for (size_t m = 0; m < file.model.materials.size(); ++m)
      scene_.materials.push_back(read_material(file, m));
  }

  void add(const PlacedNode& placed) {
    const tinygltf::Node& node = file_.model.nodes[placed.node];
    if (node.mesh >= 0) add_mesh(placed, node, static_cast<size_t>(node.mesh));
    if (node.camera >= 0) add_camera(placed, node, static_cast<size_t>(node.camera));
    if (const int light = light_of(node); light >= 0) {
      const auto index = static_cast<size_t>(light);
      Light added = read_light(file_, index, placed.transform);
      added.name = first_name({node.name, file_.model.lights[index].name, fmt::format("light {}", index)});
      scene_.lights.push_back(added);
    }
  }

 private:
  static std::string first_name(std::initializer_list<std::string> names) {
    for (const std::string& name : names)
      if (!name.empty()) return name;
    return {};
  }

  void add_mesh(const PlacedNode& placed, const tinygltf::Node& node, size_t mesh) {
    const size_t count = file_.model.meshes[mesh].primitives.size();
    const std::string name =
        first_name({node.name, file_.model.meshes[mesh].name, fmt::format("mesh {}", mesh)});
    for (size_t p = 0; p < count; ++p) check_triangle_count(mesh, p);
    if (!meshes_[mesh]) {
      meshes_[mesh].emplace();
      for (size_t p = 0; p < count; ++p) meshes_[mesh]->push_back(read_primitive(file_, mesh, p));
    }
    for (size_t p = 0; p < count; ++p) {
      Mesh world = transformed((*meshes_[mesh])[p], placed.transform);
      if (!all_finite(world))
        throw InputError(file_.at(fmt::format("/nodes/{}", placed.node)),
                         "the transform takes a vertex beyond the range of float");
      remove_zero_area(world);
      if (!world.triangles.empty())
        append_mesh(scene_, world, mat4(1.0f), material_of(mesh, p),
                    count == 1 ? name : fmt::format("{}#{}", name, p));
    }
  }

  void check_triangle_count(size_t mesh, size_t primitive) {
    stated_ += stated_triangles(file_, mesh, primitive);
    if (stated_ > max_triangles_)
      throw InputError(file_.at(fmt::format("/meshes/{}/primitives/{}", mesh, primitive)),
                       fmt::format("the scene has more than {} triangles", max_triangles_));
  }

  uint32_t material_of(size_t mesh, size_t primitive) {
    const int material = file_.model.meshes[mesh].primitives[primitive].material;
    if (material >= 0) return static_cast<uint32_t>(material);
    if (!default_material_) {
      default_material_ = static_cast<uint32_t>(scene_.materials.size());
      scene_.materials.push_back(default_gltf_material());
    }
    return *default_material_;
  }

  void add_camera(const PlacedNode& placed, const tinygltf::Node& node, size_t index) {
    std::optional<Camera> camera = read_camera(file_, index, placed.transform);
    if (!camera) return;
    const std::string name =
        first_name({node.name, file_.model.cameras[index].name, fmt::format("camera {}", index)});
    camera->name = name;
    for (int copy = 2; !camera_names_.insert(camera->name).second; ++copy)
      camera->name = fmt::format("{} {}", name, copy);
    scene_.cameras.push_back(*camera);
  }

  const GltfFile& file_;
  const size_t max_triangles_;
  Scene& scene_;
  std::vector<std::optional<std::vector<Mesh>>> meshes_;  // by mesh, its primitives
  std::optional<uint32_t> default_material_;
  std::set<std::string> camera_names_;
  size_t stated_ = 0;
};

}  // namespace

Scene load_gltf(const std::filesystem::path& path, size_t max_triangles) {
  const GltfContainer container = read_gltf_container(path);
  const nlohmann::json document = parse_json(container.json, path.string());
  check_gltf_json(document, path.string());
  const GltfBuffers buffers(document, container, path);
  const tinygltf::Model model = parse_model(document, path.string());
  const GltfFile file{model, buffers, path.string()};

  Scene scene;
  scene.name = path.stem().string();
  Assembler assembler(file, max_triangles, scene);
  for (const PlacedNode& node : placed_nodes(file)) assembler.add(node);
  if (scene.triangles.empty()) throw InputError(path.string(), "the scene has no triangles");
  update_content_hash(scene);
  return scene;
}

}  // namespace hybray
