// A few rays and what they meet, as structures of arrays: the form in which packets and vector code read and
// write them.
#pragma once

#include "core/base/ray_stream.h"
#include "core/base/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace hybray {

// Nearest hit of one ray.
struct Hit {
  float t = std::numeric_limits<float>::infinity();  // metres along the (unit) direction
  uint32_t primitive = kNoPrimitive;                 // its id in the scene
  float u = 0.0f, v = 0.0f;  // barycentric weights of a triangle's second and third vertex
  bool valid() const { return primitive != kNoPrimitive; }
};

// Where the rays of a batch lie, and where their hits go. As in RayStream, but borrowed.
struct RayLanes {
  const float *ox, *oy, *oz;  // origins
  const float *dx, *dy, *dz;  // directions, unit length
};
struct HitLanes {
  float* t;
  uint32_t* primitive;
  float *u, *v;
};

template <size_t kSize>
struct RayBatch {
  alignas(64) std::array<float, kSize> ox, oy, oz;
  alignas(64) std::array<float, kSize> dx, dy, dz;

  vec3 origin(size_t i) const { return {ox[i], oy[i], oz[i]}; }
  vec3 direction(size_t i) const { return {dx[i], dy[i], dz[i]}; }
  void set(size_t i, const vec3& o, const vec3& d) {
    ox[i] = o.x, oy[i] = o.y, oz[i] = o.z;
    dx[i] = d.x, dy[i] = d.y, dz[i] = d.z;
  }
  RayLanes lanes() const { return {ox.data(), oy.data(), oz.data(), dx.data(), dy.data(), dz.data()}; }
};

template <size_t kSize>
struct HitBatch {
  alignas(64) std::array<float, kSize> t;
  alignas(64) std::array<uint32_t, kSize> primitive;
  alignas(64) std::array<float, kSize> u, v;

  Hit operator[](size_t i) const { return {t[i], primitive[i], u[i], v[i]}; }
  void set(size_t i, const Hit& hit) {
    t[i] = hit.t, primitive[i] = hit.primitive, u[i] = hit.u, v[i] = hit.v;
  }
  HitLanes lanes() { return {t.data(), primitive.data(), u.data(), v.data()}; }
};

}  // namespace hybray
