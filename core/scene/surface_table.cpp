#include "core/scene/surface_table.h"

#include "core/base/parallel.h"

namespace hybray {

SurfaceTable::SurfaceTable(const Scene& scene, bool with_entries)
    : scene_(&scene), entries_(with_entries ? scene.triangles.size() : 0) {
  parallel_blocks(entries_.size(), 8192, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      Entry& e = entries_[i];
      const uvec3& t = scene.triangles[i];
      const dvec3 a(scene.positions[t.x]);
      const vec3 ab(dvec3(scene.positions[t.y]) - a), ac(dvec3(scene.positions[t.z]) - a);
      e.normal = vec3(geometric_normal(scene, static_cast<uint32_t>(i)));
      e.plane = glm::dot(dvec3(e.normal), a);
      for (const vec3& edge : {ab, ac})
        e.reach = std::max({e.reach, std::abs(edge.x), std::abs(edge.y), std::abs(edge.z)});
      e.normal_reach = glm::dot(glm::abs(e.normal), glm::max(glm::abs(ab), glm::abs(ac)));
      // One minus half the square of a float's rounding cannot be told from one: a few ulps are "the same".
      bool flat = true;
      for (const uint32_t v : {t.x, t.y, t.z})
        flat = flat && glm::length(scene.normals[v] - e.normal) < 4e-7f;
      e.material_flat = scene.triangle_material[i] | (flat ? Entry::kFlat : 0);
    }
  });
}

}  // namespace hybray
