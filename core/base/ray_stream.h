// Lists of world-space rays and of what they hit, as structures of arrays: the form both tracers read and
// write.
#pragma once

#include "core/base/vec.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace hybray {

constexpr uint32_t kNoPrimitive = 0xffffffffu;  // of a ray that hits nothing, and of a background pixel

// Rays in world space. Directions have unit length, so that distances along them are metres.
struct RayStream {
  std::vector<float> ox, oy, oz;  // origin
  std::vector<float> dx, dy, dz;  // direction
  std::vector<uint32_t> pixel;    // row-major index of the pixel that the ray belongs to

  size_t size() const { return pixel.size(); }
  size_t memory_bytes() const { return size() * (6 * sizeof(float) + sizeof(uint32_t)); }
  vec3 origin(size_t i) const { return vec3(ox[i], oy[i], oz[i]); }
  vec3 direction(size_t i) const { return vec3(dx[i], dy[i], dz[i]); }
  void resize(size_t n) {
    for (auto* a : {&ox, &oy, &oz, &dx, &dy, &dz}) a->resize(n);
    pixel.resize(n);
  }
  void set(size_t i, const vec3& o, const vec3& d, uint32_t p) {
    ox[i] = o.x, oy[i] = o.y, oz[i] = o.z;
    dx[i] = d.x, dy[i] = d.y, dz[i] = d.z;
    pixel[i] = p;
  }
};

// Nearest hits of a RayStream, index by index.
struct HitStream {
  std::vector<float> t;             // distance, metres; +infinity where nothing is hit
  std::vector<uint32_t> primitive;  // scene-wide triangle number (Scene::first_primitive), or kNoPrimitive

  size_t size() const { return t.size(); }
  void resize(size_t n) {
    t.resize(n, std::numeric_limits<float>::infinity());
    primitive.resize(n, kNoPrimitive);
  }
};

}  // namespace hybray
