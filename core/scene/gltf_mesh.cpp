#include "core/scene/gltf_mesh.h"

#include "core/base/error.h"
#include "core/scene/mesh_cleanup.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <tiny_gltf.h>

namespace hybray {
namespace {

std::string place(const GltfFile& file, size_t mesh, size_t primitive) {
  return file.at(fmt::format("/meshes/{}/primitives/{}", mesh, primitive));
}

// Index of the accessor of an attribute, or -1.
int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

// Vertices along the primitive -> triangles. Strips alternate so that all keep the winding of the first
// (section 3.7.2.1).
std::vector<uvec3> assemble(const std::vector<uint32_t>& v, int mode) {
  std::vector<uvec3> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    triangles.reserve(v.size() / 3);
    for (size_t i = 0; i + 2 < v.size(); i += 3) triangles.emplace_back(v[i], v[i + 1], v[i + 2]);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (size_t i = 0; i + 2 < v.size(); ++i)
      triangles.emplace_back(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]);
  } else {
    for (size_t i = 0; i + 2 < v.size(); ++i) triangles.emplace_back(v[i + 1], v[i + 2], v[0]);
  }
  return triangles;
}

// Unit length for normals that are not so already: those that are stay as they are, to the last bit.
void normalize_normals(Mesh& mesh) {
  std::vector<bool> missing(mesh.normals.size());
  for (size_t i = 0; i < mesh.normals.size(); ++i) {
    const dvec3 n(mesh.normals[i]);
    const double length = glm::length(n);
    missing[i] = length < 1e-20;
    if (!missing[i] && std::abs(length - 1.0) > 1e-6) mesh.normals[i] = vec3(n / length);
  }
  for (const uvec3& tri : mesh.triangles)
    for (const uint32_t v : {tri.x, tri.y, tri.z})
      if (missing[v]) {
        mesh.normals[v] = vec3(glm::normalize(double_area_vector(mesh, tri)));
        missing[v] = false;
      }
}

}  // namespace

size_t stated_triangles(const GltfFile& file, size_t mesh, size_t primitive_index) {
  const tinygltf::Primitive& primitive = file.model.meshes[mesh].primitives[primitive_index];
  const std::string where = place(file, mesh, primitive_index);
  if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
    throw InputError(where + "/mode", fmt::format("{} is not a primitive mode", primitive.mode));
  if (primitive.mode < TINYGLTF_MODE_TRIANGLES) return 0;
  const int position = attribute(primitive, "POSITION");
  if (position < 0) throw InputError(where + "/attributes", "there is no POSITION");
  const int source = primitive.indices >= 0 ? primitive.indices : position;
  const size_t count = file.model.accessors[static_cast<size_t>(source)].count;
  if (primitive.mode != TINYGLTF_MODE_TRIANGLES) return count < 3 ? 0 : count - 2;
  if (count % 3 != 0)
    throw InputError(where, fmt::format("{} vertices are no whole number of triangles", count));
  return count / 3;
}

Mesh read_primitive(const GltfFile& file, size_t mesh_index, size_t primitive_index) {
  const tinygltf::Primitive& primitive = file.model.meshes[mesh_index].primitives[primitive_index];
  Mesh mesh;
  if (stated_triangles(file, mesh_index, primitive_index) == 0) return mesh;
  mesh.positions = read_vec3(file, static_cast<size_t>(attribute(primitive, "POSITION")));
  if (const int normal = attribute(primitive, "NORMAL"); normal >= 0) {
    mesh.normals = read_vec3(file, static_cast<size_t>(normal));
    if (mesh.normals.size() != mesh.positions.size())
      throw InputError(
          place(file, mesh_index, primitive_index) + "/attributes/NORMAL",
          fmt::format("{} normals for {} positions", mesh.normals.size(), mesh.positions.size()));
  }
  std::vector<uint32_t> order;
  if (primitive.indices >= 0) {
    order = read_indices(file, static_cast<size_t>(primitive.indices), mesh.positions.size());
  } else {
    order.resize(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0u);
  }
  mesh.triangles = assemble(order, primitive.mode);
  remove_zero_area(mesh);
  remove_unused_vertices(mesh);
  if (!mesh.normals.empty()) normalize_normals(mesh);
  return mesh;
}

}  // namespace hybray
