// The general ray tracer over Embree. One source folder, this one, knows Embree's API; everything else sees
// this header.
#pragma once

#include "core/base/ray_stream.h"
#include "core/scene/scene.h"
#include "core/tracer/ray_batch.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hybray {

// How a list of rays is handed to Embree. Packets take neighbours in the list; `coherent` sets Embree's flag
// of that name.
enum class TraceMode : uint8_t {
  single,
  packet4,
  packet8,
  packet16,
  packet4_coherent,
  packet8_coherent,
  packet16_coherent,
};
inline constexpr TraceMode kAllTraceModes[] = {TraceMode::single,           TraceMode::packet4,
                                               TraceMode::packet8,          TraceMode::packet16,
                                               TraceMode::packet4_coherent, TraceMode::packet8_coherent,
                                               TraceMode::packet16_coherent};
const char* label(TraceMode mode);

// Primitives that a ray has gone through.
struct PassedPrimitives {
  static constexpr int kMost = 8;
  uint32_t primitive[kMost];
  int count = 0;
  bool has(uint32_t p) const {
    for (int i = 0; i < count; ++i)
      if (primitive[i] == p) return true;
    return false;
  }
};

class Tracer {
 public:
  struct Config {
    bool robust = false;       // watertight, slower traversal (RTC_SCENE_FLAG_ROBUST)
    bool layers = false;       // next_hits16 may be asked for
    bool high_quality = true;  // spatial-split BVH: slower to build, faster to trace
  };

  // Builds the acceleration structure; `scene` must outlive the tracer and not change. Throws RuntimeError
  // with Embree's own message.
  Tracer(const Scene& scene, const Config& config);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  const Scene& scene() const;
  size_t memory_bytes() const;  // of the acceleration structure

  // Nearest hit with t in [t_near, t_far]. Safe to call from many threads.
  Hit intersect(const vec3& origin, const vec3& direction, float t_near = 0.0f,
                float t_far = std::numeric_limits<float>::infinity()) const;

  // Whether anything is hit with t in [t_near, t_far].
  bool occluded(const vec3& origin, const vec3& direction, float t_near, float t_far) const;

  // Nearest hits of rays.size() rays into `hits` (resized by the caller, same size), all threads. Rays start
  // at t = 0.
  void trace(const RayStream& rays, HitStream& hits, TraceMode mode) const;

  // The same for the rays listed in `which` (indices into `rays`), each result written to its own place in
  // `hits`. `t_near`, if given, holds the distance from which on each ray of the stream looks for hits,
  // metres, >= 0.
  void trace_some(const RayStream& rays, std::span<const uint32_t> which, HitStream& hits, TraceMode mode,
                  std::span<const float> t_near = {}) const;

  // Whether anything is in the way of each of rays.size() rays, all threads: 1 or 0 into `occluded` (resized
  // by the caller, same size). Rays start at t = 0 and end at their `lengths`, metres, or, where that is
  // empty, nowhere.
  void occlude(const RayStream& rays, std::span<const float> lengths, std::vector<uint8_t>& occluded,
               TraceMode mode) const;

  // The same for the rays listed in `which`, each answer written to its own place.
  void occlude_some(const RayStream& rays, std::span<const float> lengths, std::span<const uint32_t> which,
                    std::vector<uint8_t>& occluded, TraceMode mode) const;

  // Nearest hits of `count` rays on the calling thread alone, for callers inside a parallel loop. Directions
  // have unit length, and rays start at t = 0. Allocates nothing.
  void intersect_batch(const RayLanes& rays, size_t count, const HitLanes& hits, TraceMode mode) const;

  // Nearest hits with t in [t_near, t_far] of `count` <= 16 rays from one common origin, as one coherent
  // packet (primary rays of a tile). Directions need not have unit length; t is in units of their length.
  void intersect_packet16(const vec3& origin, const vec3* directions, int count, float t_near, float t_far,
                          Hit* hits) const;

  // The same for the surfaces behind those that were hit before: nearest hits with t in [t_near of its lane,
  // t_far] on primitives that the lane has not passed yet, so that coincident surfaces all have their turn.
  // Analytic surfaces are always hit, curves once. Needs Config::layers.
  void next_hits16(const vec3& origin, const vec3* directions, int count, const float* t_near, float t_far,
                   const PassedPrimitives* passed, Hit* hits) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Embree's version ("3.13.5") and the widest instruction set it uses here.
std::string embree_version();

}  // namespace hybray
