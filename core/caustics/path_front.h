// Paths under way, and what they leave at diffuse surfaces: structures of arrays, which the tracer and the
// vector code of path_walk_lanes.cpp read and write many lanes at a time.
#pragma once

#include "core/base/vec.h"
#include "core/caustics/photon.h"
#include "core/optics/surface_optics.h"
#include "core/tracer/ray_batch.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hybray::caustics {

struct Path {
  dvec3 weight{0.0};     // flux or importance, by channel
  double initial = 0.0;  // mean weight at the start
  double length = 0.0;   // metres gone
  uint64_t number = 0;   // counter of the random numbers
  uint32_t pixel = 0;    // of camera paths
  uint16_t medium = 0;
  uint16_t events = 0;  // specular events so far, < 2^15
  bool in_map = false;  // of light paths: left through an active texel
};

// What a path counts and carries along, in one word.
namespace path_tag {
inline constexpr int kMediumShift = 16, kPixelShift = 32;
inline constexpr uint64_t kEvents = 0x7fff, kInMap = 0x8000, kMedium = 0xffff;

inline uint64_t of(const Path& path) {
  return uint64_t{path.events} | (path.in_map ? kInMap : 0) | uint64_t{path.medium} << kMediumShift |
         uint64_t{path.pixel} << kPixelShift;
}
inline uint16_t events(uint64_t tag) {
  return static_cast<uint16_t>(tag & kEvents);
}
inline bool in_map(uint64_t tag) {
  return (tag & kInMap) != 0;
}
inline uint16_t medium(uint64_t tag) {
  return static_cast<uint16_t>(tag >> kMediumShift & kMedium);
}
inline uint32_t pixel(uint64_t tag) {
  return static_cast<uint32_t>(tag >> kPixelShift);
}
}  // namespace path_tag

// Paths that go together, each with its next segment.
struct PathFront {
  static constexpr size_t kSize = 128;              // fills packets for several events, and fits the L1 cache
  static constexpr size_t kAllocated = kSize + 16;  // vectors are read and written whole
  template <class T>
  using Lanes = std::array<T, kAllocated>;

  RayBatch<kAllocated> rays;
  HitBatch<kAllocated> hits;
  alignas(64) Lanes<double> red, green, blue;  // of Path::weight
  alignas(64) Lanes<double> initial, length;
  alignas(64) Lanes<uint64_t> number, tag;
  size_t count = 0;

  void push(const dvec3& origin, const dvec3& direction, const Path& path) {
    set(count++, origin, direction, path);
  }
  void set(size_t i, const dvec3& origin, const dvec3& direction, const Path& path) {
    rays.set(i, vec3(origin), vec3(direction));
    red[i] = path.weight.x, green[i] = path.weight.y, blue[i] = path.weight.z;
    initial[i] = path.initial, length[i] = path.length;
    number[i] = path.number, tag[i] = path_tag::of(path);
  }

  dvec3 weight(size_t i) const { return {red[i], green[i], blue[i]}; }
  Path path(size_t i) const {
    return {weight(i),
            initial[i],
            length[i],
            number[i],
            path_tag::pixel(tag[i]),
            path_tag::medium(tag[i]),
            path_tag::events(tag[i]),
            path_tag::in_map(tag[i])};
  }
};

// Paths that met a diffuse part after a specular event, each as it was on arrival; the photon's flux is the
// path's weight.
struct Arrivals {
  Arrivals() = default;
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  Photon* photons = own.data();  // room for a front's; a list of photons may stand in for the own memory
  alignas(64) PathFront::Lanes<double> length;
  alignas(64) PathFront::Lanes<uint64_t> tag;
  size_t count = 0;
  alignas(64) PathFront::Lanes<Photon> own;

  void push(const Photon& photon, const Path& path) {
    photons[count] = photon, length[count] = path.length, tag[count] = path_tag::of(path);
    ++count;
  }
};

}  // namespace hybray::caustics
