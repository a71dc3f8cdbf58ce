#include "core/caustics/visibility_points.h"

#include "core/base/check.h"
#include "core/base/hash.h"
#include "core/base/morton.h"
#include "core/base/parallel.h"
#include "core/caustics/path_walk.h"
#include "core/optics/specular_step.h"

#include <algorithm>
#include <memory>

#include <tbb/enumerable_thread_specific.h>

namespace hybray::caustics {
namespace {

// Pixels that start paths, in tiles along Morton curves.
std::vector<uint32_t> starting_pixels(const optics::OpticsTable& optics, const GBuffer& g, const Scene& scene,
                                      bool all) {
  std::vector<uint32_t> pixels;
  if (!optics.any_specular) return pixels;
  const int w = g.view.width(), h = g.view.height();
  for (int ty = 0; ty < h; ty += kMortonTile)
    for (int tx = 0; tx < w; tx += kMortonTile)
      for (uint32_t i = 0; i < kMortonTile * kMortonTile; ++i) {
        const int x = tx + morton_x(i), y = ty + morton_y(i);
        if (x >= w || y >= h) continue;
        if (!all) {
          const uint32_t primitive = g.primitive(x, y);
          if (primitive == kNoPrimitive) continue;
          if (!optics.materials[scene.material_of(primitive)].specular) continue;
        }
        pixels.push_back(static_cast<uint32_t>(y) * static_cast<uint32_t>(w) + static_cast<uint32_t>(x));
      }
  return pixels;
}

// The surface point that the G-buffer stores for a pixel.
SurfacePoint stored_point(const GBuffer& g, const Scene& scene, int x, int y) {
  const double w = g.view.view_depth_of(static_cast<double>(g.depth(x, y)));
  const dvec3 place = g.view.eye() + w * g.view.ray_direction(x + 0.5, y + 0.5);
  SurfacePoint point = surface_point(scene, g.primitive(x, y), 1.0f / 3.0f, 1.0f / 3.0f, place);
  // Depth is a float: the offset must clear its rounding as well.
  const double rounding = 0x1p-22 * w * w / std::abs(g.view.depth_b()) *
                          std::max(std::abs(static_cast<double>(g.depth(x, y))), 0x1p-20);
  point.position = place;
  point.shading_normal = dvec3(g.shading_normal(x, y));
  point.offset = std::max(point.offset, 4.0 * rounding);
  return point;
}

}  // namespace

VisibilityPoints trace_visibility_points(const Tracer& tracer, const optics::OpticsTable& optics,
                                         const GBuffer& g, uint16_t start_medium,
                                         const CameraPathOptions& options) {
  HYBRAY_CHECK_LE(1, options.paths_per_pixel);
  if (!options.jittered) HYBRAY_CHECK(!g.depth.empty() && !g.primitive.empty() && !g.shading_normal.empty());
  const Scene& scene = tracer.scene();
  const std::vector<uint32_t> pixels = starting_pixels(optics, g, scene, options.jittered);
  const size_t per_pixel = static_cast<size_t>(options.paths_per_pixel);
  const size_t count = pixels.size() * per_pixel;
  const auto width = static_cast<uint32_t>(g.view.width());
  const double camera_ior = optics.media[start_medium].ior;

  constexpr size_t kBlock = 8 * PathFront::kSize;
  std::vector<VisibilityPoints> blocks((count + kBlock - 1) / kBlock);
  tbb::enumerable_thread_specific<std::unique_ptr<WalkMemory>> memories(std::make_unique<WalkMemory>);
  parallel_blocks(count, kBlock, [&](size_t begin, size_t end) {
    VisibilityPoints& mine = blocks[begin / kBlock];
    WalkMemory& memory = *memories.local();
    PathWalk walk(tracer, optics, options.walk, mine.counts);
    const auto keep_arrivals = [&] {
      for (size_t i = 0; i < memory.arrivals.count; ++i) {
        const Photon& a = memory.arrivals.photons[i];
        const uint64_t tag = memory.arrivals.tag[i];
        const double ratio = camera_ior / optics.media[path_tag::medium(tag)].ior;
        VisibilityPoint v;
        v.position = a.position;
        v.normal = a.normal;
        v.weight = a.flux * static_cast<float>(ratio * ratio);
        v.cos_out = a.cos_in;
        v.radius = static_cast<float>(options.radius_pixels * memory.arrivals.length[i] / g.view.focal());
        v.pixel = path_tag::pixel(tag);
        v.material = a.material;
        v.primitive = a.primitive;
        mine.points.push_back(v);
      }
    };
    memory.arrivals.count = 0;
    for (size_t part = begin; part < end; part += PathFront::kSize) {
      PathFront& front = memory.front();
      for (size_t i = part; i < std::min(end, part + PathFront::kSize); ++i) {
        const uint32_t pixel = pixels[i / per_pixel];
        const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
        Path path;
        path.number = static_cast<uint64_t>(pixel) * per_pixel + i % per_pixel;
        path.weight = dvec3(1.0 / options.paths_per_pixel);
        path.initial = optics::mean(path.weight);
        path.pixel = pixel;
        path.medium = start_medium;
        mine.counts.ledger.emitted += path.initial;
        dvec3 origin = g.view.eye(), direction;
        if (options.jittered) {
          const double jx = random_unit(path.number, 0, 1, options.walk.seed);
          const double jy = random_unit(path.number, 1, 1, options.walk.seed);
          direction = glm::normalize(g.view.ray_direction(x + jx, y + jy));
          // The near plane does not cut: what is nearer is seen by a pinhole, and by the tracer.
          front.push(origin, direction, path);
          continue;
        }
        direction = glm::normalize(g.view.ray_direction(x + 0.5, y + 0.5));
        const SurfacePoint point = stored_point(g, scene, x, y);
        walk.travel(glm::length(point.position - origin), path);
        if (walk.meet(point, origin, direction, path, memory.arrivals)) front.push(origin, direction, path);
      }
      while (memory.front().count > 0) {
        walk.advance(memory);
        keep_arrivals();
      }
    }
  });

  VisibilityPoints all;
  all.pixels = pixels.size();
  all.paths = count;
  size_t total = 0;
  for (const VisibilityPoints& block : blocks) total += block.points.size();
  all.points.reserve(total);
  for (VisibilityPoints& block : blocks) {
    all.points.insert(all.points.end(), block.points.begin(), block.points.end());
    std::vector<VisibilityPoint>().swap(block.points);
    all.counts.add(block.counts);
  }
  return all;
}

}  // namespace hybray::caustics
