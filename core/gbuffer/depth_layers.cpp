#include "core/gbuffer/depth_layers.h"

#include "core/base/check.h"
#include "core/base/morton.h"
#include "core/base/parallel.h"
#include "core/gbuffer/triangle_plane.h"
#include "core/scene/surface_point.h"

namespace hybray {
namespace {

constexpr int kPacket = 16;  // pixels of one packet: a 4x4 square

// Where the search for the next surface begins, relative to the one before: a little nearer, so that rounding
// hides none that coincides with it. What has been passed already is passed over by its number.
constexpr float kAgain = 1.0f - 0x1p-18f;

bool shows_front(const View& view, const Scene& scene, uint32_t primitive, int x, int y) {
  const dvec3 point = seen_point(view, scene, primitive, x + 0.5, y + 0.5);
  return glm::dot(geometric_normal(scene, primitive, point), view.ray_direction(x + 0.5, y + 0.5)) < 0.0;
}

// View depth of the first surface; of one seen edge-on, where the view begins: nothing but it is nearer.
float seen_depth(const View& view, const Scene& scene, uint32_t primitive, int x, int y) {
  const double w = 1.0 / tangent_plane(view, scene, primitive, x + 0.5, y + 0.5).inverse_w;
  return static_cast<float>(w >= view.near() && w <= view.far() ? w : view.near());
}

// The rays of a packet that still go on.
struct Front {
  ivec2 pixel[kPacket];
  vec3 direction[kPacket];
  float t[kPacket];
  PassedPrimitives passed[kPacket];
  int count = 0;

  void add(const View& view, ivec2 p, float at, const PassedPrimitives& primitives) {
    pixel[count] = p;
    direction[count] = vec3(view.ray_direction(p.x + 0.5, p.y + 0.5));
    t[count] = at;
    passed[count++] = primitives;
  }
};

void peel(const Tracer& tracer, const GBuffer& first, DepthLayers& layers, int tile_x, int tile_y,
          uint32_t begin) {
  const View& view = first.view;
  const Scene& scene = tracer.scene();
  Front front;
  for (uint32_t i = begin; i < begin + kPacket; ++i) {
    const int x = tile_x * kMortonTile + morton_x(i), y = tile_y * kMortonTile + morton_y(i);
    if (x >= view.width() || y >= view.height()) continue;
    const uint32_t primitive = first.primitive(x, y);
    if (primitive == kNoPrimitive) continue;
    layers.fronts(x, y) = shows_front(view, scene, primitive, x, y);
    if (scene.is_analytic(primitive)) continue;
    PassedPrimitives passed;
    passed.primitive[passed.count++] = primitive;
    front.add(view, ivec2(x, y), seen_depth(view, scene, primitive, x, y) * kAgain, passed);
  }
  for (int layer = 1; layer < layers.count() && front.count > 0; ++layer) {
    Hit hits[kPacket];
    tracer.next_hits16(vec3(view.eye()), front.direction, front.count, front.t,
                       static_cast<float>(view.far()), front.passed, hits);
    Front next;
    for (int i = 0; i < front.count; ++i) {
      if (!hits[i].valid()) continue;
      const ivec2 p = front.pixel[i];
      store_pixel(layers.further[layer - 1], scene, p.x, p.y, hits[i]);
      layers.fronts(p.x, p.y) |=
          static_cast<uint8_t>(shows_front(view, scene, hits[i].primitive, p.x, p.y) << layer);
      if (scene.is_analytic(hits[i].primitive)) continue;
      PassedPrimitives passed = front.passed[i];
      if (passed.count < PassedPrimitives::kMost) passed.primitive[passed.count++] = hits[i].primitive;
      next.add(view, p, hits[i].t * kAgain, passed);
    }
    front = next;
  }
}

}  // namespace

size_t DepthLayers::memory_bytes() const {
  size_t bytes = fronts.size();
  for (const GBuffer& g : further) bytes += g.memory_bytes();
  return bytes;
}

DepthLayers make_depth_layers(const Tracer& tracer, const GBuffer& first, int count) {
  HYBRAY_CHECK_LT(count, DepthLayers::kMost + 1);
  const int w = first.view.width(), h = first.view.height();
  DepthLayers layers;
  layers.fronts = Image2D<uint8_t>(w, h);
  for (int layer = 1; layer < count; ++layer)
    layers.further.push_back(empty_gbuffer(first.view, kDepth | kDepthDerivatives | kPrimitive));
  if (count < 2) return layers;
  const int tiles_x = (w + kMortonTile - 1) / kMortonTile, tiles_y = (h + kMortonTile - 1) / kMortonTile;
  parallel_blocks(static_cast<size_t>(tiles_x) * static_cast<size_t>(tiles_y), 16,
                  [&](size_t begin, size_t end) {
                    for (size_t tile = begin; tile < end; ++tile)
                      for (uint32_t i = 0; i < kMortonTile * kMortonTile; i += kPacket)
                        peel(tracer, first, layers, static_cast<int>(tile % tiles_x),
                             static_cast<int>(tile / tiles_x), i);
                  });
  return layers;
}

}  // namespace hybray
