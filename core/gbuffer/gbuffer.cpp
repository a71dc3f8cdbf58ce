#include "core/gbuffer/gbuffer.h"

#include "core/base/morton.h"
#include "core/base/parallel.h"
#include "core/gbuffer/triangle_plane.h"
#include "core/scene/surface_point.h"

#include <atomic>
#include <cmath>

namespace hybray {
namespace {

constexpr int kPacket = 16;  // rays of one packet: a 4x4 square, a quarter of a Morton tile

}  // namespace

void store_pixel(GBuffer& g, const Scene& scene, int x, int y, const Hit& hit) {
  if (!g.primitive.empty()) g.primitive(x, y) = hit.primitive;
  if (!g.material.empty()) g.material(x, y) = scene.material_of(hit.primitive);

  if (!g.depth.empty() || !g.depth_derivatives.empty()) {
    TrianglePlane plane = tangent_plane(g.view, scene, hit.primitive, x + 0.5, y + 0.5);
    // A surface seen edge-on has no usable plane; its pixel keeps the tracer's own distance and faces the
    // viewer.
    if (!(plane.inverse_w > 0.0) || !std::isfinite(plane.inverse_w) || !std::isfinite(plane.slope_x) ||
        !std::isfinite(plane.slope_y))
      plane = {1.0 / hit.t, 0.0, 0.0};
    const double b = g.view.depth_b();
    if (!g.depth.empty())
      g.depth(x, y) =
          static_cast<float>(std::min(1.0, std::max(0.0, g.view.depth_a() + b * plane.inverse_w)));
    if (!g.depth_derivatives.empty())
      g.depth_derivatives(x, y) =
          vec2(static_cast<float>(b * plane.slope_x), static_cast<float>(b * plane.slope_y));
  }
  if (!scene.is_triangle(hit.primitive)) {
    const dvec3 point = seen_point(g.view, scene, hit.primitive, x + 0.5, y + 0.5);
    const vec3 n(geometric_normal(scene, hit.primitive, point));
    if (!g.geometric_normal.empty()) g.geometric_normal(x, y) = n;
    if (!g.shading_normal.empty()) g.shading_normal(x, y) = n;
    return;
  }
  if (!g.geometric_normal.empty()) g.geometric_normal(x, y) = vec3(geometric_normal(scene, hit.primitive));
  if (!g.shading_normal.empty()) {
    const uvec3& tri = scene.triangles[hit.primitive];
    const vec3 n = (1.0f - hit.u - hit.v) * scene.normals[tri.x] + hit.u * scene.normals[tri.y] +
                   hit.v * scene.normals[tri.z];
    const float length = glm::length(n);
    // Opposite vertex normals can cancel: the triangle's own normal is then the only one there is.
    g.shading_normal(x, y) = length > 1e-6f ? n / length : vec3(geometric_normal(scene, hit.primitive));
  }
}

size_t trace_tile(const Tracer& tracer, GBuffer& g, int tile_x, int tile_y) {
  const int left = tile_x * kMortonTile, top = tile_y * kMortonTile;
  const vec3 eye(g.view.eye());
  size_t covered = 0;
  for (uint32_t first = 0; first < kMortonTile * kMortonTile; first += kPacket) {
    vec3 directions[kPacket];
    ivec2 pixels[kPacket];
    Hit hits[kPacket];
    int count = 0;
    for (uint32_t i = first; i < first + kPacket; ++i) {
      const int x = left + morton_x(i), y = top + morton_y(i);
      if (x >= g.view.width() || y >= g.view.height()) continue;
      pixels[count] = ivec2(x, y);
      directions[count++] = vec3(g.view.ray_direction(x + 0.5, y + 0.5));
    }
    if (count == 0) continue;
    tracer.intersect_packet16(eye, directions, count, static_cast<float>(g.view.near()),
                              static_cast<float>(g.view.far()), hits);
    for (int i = 0; i < count; ++i) {
      if (!hits[i].valid()) continue;
      ++covered;
      store_pixel(g, tracer.scene(), pixels[i].x, pixels[i].y, hits[i]);
    }
  }
  return covered;
}

size_t GBuffer::memory_bytes() const {
  const auto bytes = [](const auto& image) { return image.size() * sizeof(*image.data()); };
  return bytes(depth) + bytes(depth_derivatives) + bytes(geometric_normal) + bytes(shading_normal) +
         bytes(primitive) + bytes(material);
}

GBuffer empty_gbuffer(const View& view, unsigned bits) {
  const int w = view.width(), h = view.height();
  GBuffer g(view);
  if (bits & kDepth) g.depth = Image2D<float>(w, h, view.background_depth());
  if (bits & kDepthDerivatives) g.depth_derivatives = Image2D<vec2>(w, h);
  if (bits & kGeometricNormal) g.geometric_normal = Image2D<vec3>(w, h);
  if (bits & kShadingNormal) g.shading_normal = Image2D<vec3>(w, h);
  if (bits & kPrimitive) g.primitive = Image2D<uint32_t>(w, h, kNoPrimitive);
  if (bits & kMaterial) g.material = Image2D<uint32_t>(w, h, kNoPrimitive);
  return g;
}

GBuffer make_gbuffer(const Tracer& tracer, const View& view, unsigned bits) {
  GBuffer g = empty_gbuffer(view, bits);
  const int w = view.width(), h = view.height();
  const int tiles_x = (w + kMortonTile - 1) / kMortonTile, tiles_y = (h + kMortonTile - 1) / kMortonTile;
  std::atomic<size_t> covered{0};
  parallel_blocks(
      static_cast<size_t>(tiles_x) * static_cast<size_t>(tiles_y), 16, [&](size_t begin, size_t end) {
        size_t mine = 0;
        for (size_t tile = begin; tile < end; ++tile)
          mine += trace_tile(tracer, g, static_cast<int>(tile % tiles_x), static_cast<int>(tile / tiles_x));
        covered += mine;
      });
  g.covered_pixels = covered;
  return g;
}

Image2D<vec2> difference_derivatives(const Image2D<float>& depth) {
  const int w = depth.width(), h = depth.height();
  Image2D<vec2> derivatives(w, h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const int x0 = (x | 1) < w ? x & ~1 : x - 1, y0 = (y | 1) < h ? y & ~1 : y - 1;
      derivatives(x, y) = vec2(x0 >= 0 ? depth(x0 + 1, y) - depth(x0, y) : 0.0f,
                               y0 >= 0 ? depth(x, y0 + 1) - depth(x, y0) : 0.0f);
    }
  return derivatives;
}

}  // namespace hybray
