// How the paths of one light begin: from the texels of its visibility map, uniformly over everything that it
// lights, or from both at once.
#pragma once

#include "core/caustics/light_source.h"
#include "core/caustics/visibility_map.h"

#include <cstdint>

namespace hybray::caustics {

enum class EmissionKind : uint8_t {
  map,      // only through active texels: what the map misses is lost
  uniform,  // over the whole domain of the light: nothing is lost, little hits
  mixture,  // half of each, weighted by the balance heuristic (Veach and Guibas 1995): nothing is lost
};

struct PathStart {
  dvec3 origin{0.0}, direction{0.0};
  dvec3 flux{0.0};      // W by channel
  bool in_map = false;  // through an active texel
  uint32_t frame = 0;   // of the texel, where in_map
  uint16_t x = 0, y = 0;
};

// Number of paths, as a real number, that `rays_per_texel` asks for: of the active texels of the map, or for
// `uniform` and `mixture` of all texels that a full map has. Throws InputError for a value that is not
// positive and finite, or asks for more than 2^40 paths.
double expected_paths(const VisibilityMap& map, EmissionKind kind, double rays_per_texel);

// The paths that leave through a map. Path i sits at (i + offset) texels_a_path along the list of active
// texels, and in its texel where a sequence of low discrepancy puts it: every texel gets the same number of
// paths on average, evenly spread where that is below one.
struct MapEmission {
  // Dimension of the random numbers that shift the sequence of each texel.
  static constexpr uint32_t kJitter = 2;
  // The sequence's steps: the root of x^3 = x + 1, which plays in two dimensions the golden ratio's part.
  static constexpr double kPlasticX = 0.75487766624669276, kPlasticY = 0.56984029099805327;

  const VisibilityMap& map;
  Intensity intensity;
  uint64_t seed;
  std::vector<FrameRays> frames;  // of the map
  double offset = 0.0;            // in [0, 1)
  double texels_a_path = 0.0;
  double domain_density = 0.0;  // paths that leave otherwise, a unit of the measure
  uint64_t paths = 0;

  PathStart start(uint64_t path) const;
};

// The paths of one light in one pass. Their number is `expected` on average and differs from it by less than
// two.
class Emission {
 public:
  // `expected` > 0. With kind `map` the map must have texels; all three arguments must outlive the emission.
  Emission(const Light& light, const VisibilityMap& map, const Bounds3& scene, EmissionKind kind,
           double expected, uint64_t seed);

  uint64_t paths() const { return from_map_.paths + domain_paths_; }
  // Start of path `path` < paths(): a pure function of it and the seed. Those through the map come first.
  PathStart start(uint64_t path) const;
  const MapEmission& from_map() const { return from_map_; }

 private:
  PathStart from_domain(uint64_t path) const;
  bool find_texel(PathStart& start, dvec2& image) const;

  MapEmission from_map_;
  UniformDomain domain_;
  double map_expected_ = 0.0, domain_expected_ = 0.0;
  double domain_offset_, rotation_;  // uniform in [0, 1)
  uint64_t domain_paths_ = 0;
};

}  // namespace hybray::caustics
