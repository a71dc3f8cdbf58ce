#include "core/gbuffer/light_buffer.h"

#include "core/base/check.h"
#include "core/base/morton.h"
#include "core/base/parallel.h"

#include <array>
#include <atomic>

namespace hybray {
namespace {

constexpr uint32_t kTile = kMortonTile * kMortonTile;

// Traces one tile; returns the number of its texels.
size_t trace_tile(const Tracer& tracer, LightBuffer& buffer, int tile_x, int tile_y) {
  RayBatch<kTile> rays;
  HitBatch<kTile> hits;
  std::array<ivec2, kTile> places;
  size_t count = 0;
  const LightFrame& frame = buffer.frame;
  for (uint32_t i = 0; i < kTile; ++i) {
    const int x = tile_x + morton_x(i), y = tile_y + morton_y(i);
    if (x >= frame.width || y >= frame.height) continue;
    places[count] = ivec2(x, y);
    rays.set(count++, vec3(frame.ray_origin(x + 0.5, y + 0.5)), vec3(frame.ray_direction(x + 0.5, y + 0.5)));
  }
  tracer.intersect_batch(rays.lanes(), count, hits.lanes(), TraceMode::packet16_coherent);
  for (size_t i = 0; i < count; ++i)
    buffer.texels.at(places[i].x, places[i].y) = {hits.t[i], hits.primitive[i], hits.u[i], hits.v[i]};
  return count;
}

}  // namespace

LightBuffer make_light_buffer(const Tracer& tracer, const LightFrame& frame, std::span<const uint8_t> tiles) {
  LightBuffer buffer{frame, TiledImage<LightTexel>(frame.width, frame.height, tiles), 0};
  const size_t tiles_x = static_cast<size_t>((frame.width + kMortonTile - 1) / kMortonTile);
  const size_t tiles_y = static_cast<size_t>((frame.height + kMortonTile - 1) / kMortonTile);
  HYBRAY_CHECK(tiles.empty() || tiles.size() == tiles_x * tiles_y);
  std::atomic<size_t> traced{0};
  parallel_blocks(tiles_x * tiles_y, 16, [&](size_t begin, size_t end) {
    size_t mine = 0;
    for (size_t tile = begin; tile < end; ++tile)
      if (tiles.empty() || tiles[tile])
        mine += trace_tile(tracer, buffer, static_cast<int>(tile % tiles_x) * kMortonTile,
                           static_cast<int>(tile / tiles_x) * kMortonTile);
    traced += mine;
  });
  buffer.traced = traced;
  return buffer;
}

}  // namespace hybray
