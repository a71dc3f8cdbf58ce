// Caustic visibility maps: for each light, the specular surfaces that it sees directly, as the probability
// density of caustic transport (caustics paper, "Illumination caustics"; Figure 3).
#pragma once

#include "core/gbuffer/light_buffer.h"
#include "core/optics/surface_optics.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hybray::caustics {

// One image plane of a map.
struct MapFrame {
  LightFrame frame;
  TiledImage<LightTexel> surface;  // what each texel's centre sees, of any material; in traced tiles
  TiledImage<uint8_t> active;      // 1 where that is a specular surface and the light shines there
};

// One texel of non-zero probability.
struct MapTexel {
  uint16_t x = 0, y = 0, frame = 0;
  float reflect = 0.0f;  // share of the specular flux that is mirrored at the texel's centre, [0, 1]; the
                         // rest is refracted
};

struct VisibilityMap {
  uint32_t light = 0;  // into Scene::lights
  std::vector<MapFrame> frames;
  std::vector<MapTexel> texels;  // active texels only, in tiles of 8x8 along Morton curves
  double covered_flux = 0.0;     // W, mean of the channels, that leaves through the active texels
  uint64_t texels_total = 0;     // of a map of all frames that the light would need without culling
  uint64_t texels_traced = 0;
};

// The specular geometry of a scene, once a scene.
struct SpecularTargets {
  std::vector<Bounds3> boxes;  // one an object or analytic surface, one for all curves
};
SpecularTargets specular_targets(const Scene& scene, const optics::OpticsTable& optics);

// The map of one light. `resolution` in [1, 65535] texels along one side of a frame; throws InputError
// otherwise. The map has no texels where the light sees nothing specular or emits nothing.
VisibilityMap make_visibility_map(const Tracer& tracer, const optics::OpticsTable& optics,
                                  const SpecularTargets& targets, uint32_t light, int resolution);

// Maps of the lights listed that see a specular surface; the others drop out, and `lights_skipped` counts
// them. With `keep_empty` the maps of lights that emit stay even where they have no texel: uniform emission
// needs no map, and finds what the maps miss.
struct MapSet {
  std::vector<VisibilityMap> maps;
  uint32_t lights_skipped = 0;
  uint64_t texels_total = 0, texels_traced = 0, texels_used = 0;  // of all lights, skipped ones included
};
MapSet make_visibility_maps(const Tracer& tracer, const optics::OpticsTable& optics,
                            const SpecularTargets& targets, std::span<const uint32_t> lights, int resolution,
                            bool keep_empty = false);

}  // namespace hybray::caustics
