#include "core/caustics/visibility_map.h"

#include "core/base/error.h"
#include "core/base/morton.h"
#include "core/base/parallel.h"
#include "core/caustics/light_source.h"
#include "core/optics/specular_step.h"

#include <cmath>

#include <fmt/format.h>

namespace hybray::caustics {
namespace {

// Share of the specular flux that a surface mirrors at a texel's centre; negative where it is not specular.
float reflect_share(const Scene& scene, const optics::OpticsTable& optics, const LightTexel& texel,
                    const dvec3& origin, const dvec3& direction) {
  if (texel.primitive == kNoPrimitive) return -1.0f;
  const SurfacePoint point = surface_point(scene, texel.primitive, texel.u, texel.v,
                                           origin + static_cast<double>(texel.distance) * direction);
  const optics::SurfaceOptics& s = optics.materials[point.material];
  if (!s.specular) return -1.0f;
  const optics::Facing f = optics::facing(point, direction);
  const optics::SpecularSplit split = optics::split(s, f.cos_incident, f.from_inner);
  const double back = optics::mean(split.reflectance), through = optics::mean(split.transmittance);
  return back + through > 0.0 ? static_cast<float>(back / (back + through)) : -1.0f;
}

// Finds the active texels of one frame and appends them to the map; a frame without any is dropped.
void add_frame(VisibilityMap& map, const Scene& scene, const optics::OpticsTable& optics, LightBuffer buffer,
               std::span<const uint8_t> tiles) {
  constexpr size_t kBlock = 16;  // tiles
  struct Block {
    std::vector<MapTexel> texels;
    double flux = 0.0;
  };
  const LightFrame& frame = buffer.frame;
  const Intensity intensity(scene.lights[map.light]);
  const auto number = static_cast<uint16_t>(map.frames.size());
  MapFrame result{frame, std::move(buffer.texels), TiledImage<uint8_t>(frame.width, frame.height, tiles)};
  const auto visit = [&](int x, int y, Block& block) {
    const dvec3 direction = frame.ray_direction(x + 0.5, y + 0.5);
    const double shines = optics::mean(intensity(direction));
    if (!(shines > 0.0)) return;
    const float share =
        reflect_share(scene, optics, result.surface(x, y), frame.ray_origin(x + 0.5, y + 0.5), direction);
    if (share < 0.0f) return;
    result.active.at(x, y) = 1;
    block.texels.push_back({static_cast<uint16_t>(x), static_cast<uint16_t>(y), number, share});
    block.flux += shines * frame.texel_measure(x, y);
  };
  const int tiles_x = (frame.width + kMortonTile - 1) / kMortonTile;
  std::vector<Block> blocks((tiles.size() + kBlock - 1) / kBlock);
  parallel_blocks(tiles.size(), kBlock, [&](size_t begin, size_t end) {
    for (size_t tile = begin; tile < end; ++tile) {
      if (!tiles[tile]) continue;
      const int tx = static_cast<int>(tile) % tiles_x * kMortonTile,
                ty = static_cast<int>(tile) / tiles_x * kMortonTile;
      for (uint32_t i = 0; i < kMortonTile * kMortonTile; ++i) {
        const int x = tx + morton_x(i), y = ty + morton_y(i);
        if (x < frame.width && y < frame.height) visit(x, y, blocks[begin / kBlock]);
      }
    }
  });
  const size_t before = map.texels.size();
  for (const Block& block : blocks) {
    map.texels.insert(map.texels.end(), block.texels.begin(), block.texels.end());
    map.covered_flux += block.flux;
  }
  if (map.texels.size() > before) map.frames.push_back(std::move(result));
}

// Frames that the light has when nothing is culled: those that see a box around it.
size_t full_frames(const Light& light) {
  const vec3 reach = 1.0f + 0.5f * glm::abs(light.position);
  const Bounds3 around{light.position - reach, light.position + reach};
  return light_frames(light, {&around, 1}, around, 1).size();
}

}  // namespace

SpecularTargets specular_targets(const Scene& scene, const optics::OpticsTable& optics) {
  SpecularTargets targets;
  for (const SceneObject& object : scene.objects) {
    if (!optics.materials[object.material].specular || object.triangle_count == 0) continue;
    Bounds3 box;
    for (uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count; ++t)
      for (const uint32_t v : {scene.triangles[t].x, scene.triangles[t].y, scene.triangles[t].z})
        box.extend(scene.positions[v]);
    targets.boxes.push_back(box);
  }
  for (const AnalyticSurface& surface : scene.analytic)
    if (optics.materials[surface.material].specular) targets.boxes.push_back(bounds(surface));
  Bounds3 curves;
  for (const RoundCurve& curve : scene.curves) {
    if (!optics.materials[curve.material].specular) continue;
    const Bounds3 box = bounds(curve);
    curves.extend(box.lower), curves.extend(box.upper);
  }
  if (!curves.empty()) targets.boxes.push_back(curves);
  return targets;
}

VisibilityMap make_visibility_map(const Tracer& tracer, const optics::OpticsTable& optics,
                                  const SpecularTargets& targets, uint32_t light_index, int resolution) {
  if (resolution < 1 || resolution > 65535)
    throw InputError("map_resolution", fmt::format("{} is not between 1 and 65535 texels", resolution));
  const Scene& scene = tracer.scene();
  const Light& light = scene.lights[light_index];
  VisibilityMap map;
  map.light = light_index;
  map.texels_total = static_cast<uint64_t>(full_frames(light)) * static_cast<uint64_t>(resolution) *
                     static_cast<uint64_t>(resolution);
  if (!emits(light)) return map;
  const std::vector<LightFrame> frames = light_frames(light, targets.boxes, scene.bounds, resolution);
  map.frames.reserve(frames.size());
  for (const LightFrame& frame : frames) {
    const std::vector<uint8_t> tiles = tiles_that_may_see(frame, targets.boxes);
    LightBuffer buffer = make_light_buffer(tracer, frame, tiles);
    map.texels_traced += buffer.traced;
    add_frame(map, scene, optics, std::move(buffer), tiles);
  }
  return map;
}

MapSet make_visibility_maps(const Tracer& tracer, const optics::OpticsTable& optics,
                            const SpecularTargets& targets, std::span<const uint32_t> lights, int resolution,
                            bool keep_empty) {
  MapSet set;
  for (const uint32_t light : lights) {
    VisibilityMap map = make_visibility_map(tracer, optics, targets, light, resolution);
    set.texels_total += map.texels_total;
    set.texels_traced += map.texels_traced;
    set.texels_used += map.texels.size();
    if (map.texels.empty() && !(keep_empty && emits(tracer.scene().lights[light])))
      ++set.lights_skipped;
    else
      set.maps.push_back(std::move(map));
  }
  return set;
}

}  // namespace hybray::caustics
