// A procedural scene under construction at one level of detail, and the search for the level that meets a
// wanted number of triangles.
//
// Every curved shape asks its Lod for segments, base * level of them; small objects appear from some level
// on. Both are offset by a random number of the object's own, so that objects change one after the other and
// the total grows in small steps. What the level leaves over goes to the `fill` factor (leaves, in scenes
// with plants). Nothing else depends on either: large structures stay where they are.
#pragma once

#include "core/base/hash.h"
#include "core/scene/procedural/generators.h"
#include "core/scene/procedural/mesh_builder.h"
#include "core/scene/scene.h"

#include <cmath>
#include <cstdint>
#include <string>

namespace hybray::procedural {

// Random numbers of one object: a function of the scene's seed, the object's key and the position in its
// sequence.
class Dice {
 public:
  Dice(uint64_t seed, uint64_t key) : seed_(seed), key_(key) {}
  double operator()(double low, double high) {
    return low + (high - low) * random_unit(key_, next_++, 0, seed_);
  }
  int pick(int count) { return static_cast<int>((*this)(0.0, count)); }

 private:
  uint64_t seed_, key_;
  uint32_t next_ = 0;
};

// Level of detail of one object.
struct Lod {
  double level = 1.0, fill = 1.0;
  double offset = 0.5;  // in [0, 1), the object's own

  // Segments of a curve that has `base` of them at level 1.
  int segments(double base, int minimum) const {
    return std::max(minimum, static_cast<int>(base * level + offset));
  }
  // The same, in an even number.
  int even_segments(double base, int minimum) const { return 2 * segments(0.5 * base, (minimum + 1) / 2); }
  // Whether an object that appears at about `threshold` is there.
  bool wants(double threshold) const { return level >= threshold * (0.75 + 0.5 * offset); }
  // Number of leaves or other filling of which there are `base` at level 1.
  int filling(double base) const { return static_cast<int>(base * std::pow(level, 1.3) * fill + offset); }
};

class Model {
 public:
  Model(double level, double fill, uint64_t seed, bool counting);

  uint64_t seed() const { return seed_; }
  bool counting() const { return counting_; }
  Lod lod(uint64_t key) const;
  Dice dice(uint64_t key) const { return Dice(seed_, mix_bits(key)); }

  // Adds a material and returns its number.
  uint32_t material(const Material& material);

  MeshBuilder part() const { return MeshBuilder(counting_); }
  // Adds a finished part as one object; an empty part is left out.
  void add(MeshBuilder&& part, uint32_t material, const std::string& name,
           const dmat4& transform = dmat4(1.0));

  // Adds a curve; none while counting, when count_curves() says how many there would be. A curve counts like
  // a triangle.
  void curve(const RoundCurve& curve);
  void count_curves(size_t curves) { count_ += curves; }

  // Adds an analytic surface, which counts as none.
  void surface(const AnalyticSurface& surface);

  void light(const Light& light) { scene_.lights.push_back(light); }
  void camera(const std::string& name, const vec3& eye, const vec3& target, float vertical_fov);

  size_t primitive_count() const { return count_; }
  Scene take() { return std::move(scene_); }

 private:
  double level_, fill_;
  uint64_t seed_;
  bool counting_;
  size_t count_ = 0;
  Scene scene_;
};

// Key of an object from its kind and its number.
inline uint64_t key(const char* kind, uint64_t number = 0) {
  return hash_text(kind, number);
}

// Runs `layout` at the level and fill that meet parameters.triangles (or `default_triangles`). Throws
// InputError for a number below what the coarsest layout has, or above 2^27.
Scene build(const std::string& name, const Parameters& parameters, uint32_t default_triangles,
            void (*layout)(Model&));

}  // namespace hybray::procedural
