// What shading needs of each triangle, computed once and packed together: a path that lands on a flat
// triangle reads half a cache line instead of eight.
#pragma once

#include "core/scene/surface_point.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace hybray {

class SurfaceTable {
 public:
  SurfaceTable() = default;
  // `scene` must outlive the table and not change. Without entries every point is worked out anew.
  SurfaceTable(const Scene& scene, bool with_entries);

  // As surface_point() does, with the point taken from `hit`, moved onto the triangle's plane, and normals of
  // float precision.
  SurfacePoint point(uint32_t primitive, float u, float v, const dvec3& hit,
                     LeavingOffset leaving = LeavingOffset::largest) const {
    if (primitive >= entries_.size()) return surface_point(*scene_, primitive, u, v, hit, leaving);
    const Entry& e = entries_[primitive];
    SurfacePoint p;
    p.primitive = primitive;
    p.material = e.material();
    p.geometric_normal = dvec3(e.normal);
    p.position = hit - (glm::dot(p.geometric_normal, hit) - e.plane) * p.geometric_normal;
    p.shading_normal = e.flat() ? p.geometric_normal : interpolated(primitive, u, v, e.normal);
    const dvec3 size = glm::abs(p.position);
    const double largest = std::max({size.x, size.y, size.z}), reach = static_cast<double>(e.reach);
    p.offset = leaving == LeavingOffset::largest
                   ? kSurfaceOffset * std::max(largest, reach)
                   : kNormalOffset * std::max({glm::dot(glm::abs(p.geometric_normal), size),
                                               static_cast<double>(e.normal_reach), kLeastOfEdge * reach,
                                               kLeastOfPosition * largest});
    return p;
  }

  // What the table keeps of a triangle, for code that works out many points at once.
  struct alignas(32) Entry {
    static constexpr uint32_t kFlat = uint32_t{1} << 31;  // the vertices' normals are the triangle's own
    double plane = 0.0;                                   // dot(normal, x) of the points x of the triangle
    vec3 normal{0.0f};                                    // geometric
    float reach = 0.0f;          // largest coordinate of the two edges from the first vertex
    uint32_t material_flat = 0;  // material, and kFlat
    float normal_reach = 0.0f;   // what |normal| and the largest coordinates of the edges have in common:
                                 // their scalar product
    uint32_t material() const { return material_flat & ~kFlat; }
    bool flat() const { return (material_flat & kFlat) != 0; }
  };
  std::span<const Entry> entries() const { return entries_; }
  const Scene& scene() const { return *scene_; }

  // Fetches what point() will read of a triangle: its entry, or what the entry points to.
  void prefetch_entry(uint32_t primitive) const {
    if (primitive >= entries_.size()) return;
    __builtin_prefetch(&entries_[primitive]);
    __builtin_prefetch(&scene_->triangles[primitive]);
  }
  void prefetch_normals(uint32_t primitive) const {
    if (primitive >= entries_.size() || entries_[primitive].flat()) return;
    const uvec3& t = scene_->triangles[primitive];
    for (const uint32_t vertex : {t.x, t.y, t.z}) __builtin_prefetch(&scene_->normals[vertex]);
  }

 private:
  dvec3 interpolated(uint32_t primitive, float u, float v, const vec3& geometric) const {
    const uvec3& t = scene_->triangles[primitive];
    const std::vector<vec3>& normals = scene_->normals;
    const vec3 n = (1.0f - u - v) * normals[t.x] + u * normals[t.y] + v * normals[t.z];
    const float length = glm::length(n);
    return dvec3(length > 1e-6f ? n * (1.0f / length) : geometric);
  }

  const Scene* scene_ = nullptr;
  std::vector<Entry> entries_;
};

}  // namespace hybray
