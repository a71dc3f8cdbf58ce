#include "core/scene/mesh_cleanup.h"

#include <algorithm>
#include <cmath>

namespace hybray {

dvec3 double_area_vector(const Mesh& mesh, const uvec3& triangle) {
  const dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]), c(mesh.positions[triangle.z]);
  return glm::cross(b - a, c - a);
}

bool all_finite(const Mesh& mesh) {
  return std::all_of(mesh.positions.begin(), mesh.positions.end(), [](const vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
}

size_t remove_zero_area(Mesh& mesh) {
  const auto flat = [&](const uvec3& tri) {
    const dvec3 a(mesh.positions[tri.x]), b(mesh.positions[tri.y]), c(mesh.positions[tri.z]);
    const dvec3 n = glm::cross(b - a, c - a);
    const double edges = glm::dot(b - a, b - a) + glm::dot(c - a, c - a);
    return !(glm::dot(n, n) > 1e-30 * edges * edges);
  };
  const size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, flat);
  return before - mesh.triangles.size();
}

void remove_unused_vertices(Mesh& mesh) {
  constexpr uint32_t kUnused = 0xffffffffu;
  std::vector<uint32_t> renumbered(mesh.positions.size(), kUnused);
  for (const uvec3& tri : mesh.triangles)
    for (const uint32_t v : {tri.x, tri.y, tri.z}) renumbered[v] = 0;
  uint32_t kept = 0;
  for (size_t v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] == kUnused) continue;
    mesh.positions[kept] = mesh.positions[v];
    if (!mesh.normals.empty()) mesh.normals[kept] = mesh.normals[v];
    renumbered[v] = kept++;
  }
  mesh.positions.resize(kept);
  if (!mesh.normals.empty()) mesh.normals.resize(kept);
  for (uvec3& tri : mesh.triangles) tri = uvec3(renumbered[tri.x], renumbered[tri.y], renumbered[tri.z]);
}

}  // namespace hybray
