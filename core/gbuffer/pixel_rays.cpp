#include "core/gbuffer/pixel_rays.h"

#include "core/base/check.h"
#include "core/base/hash.h"
#include "core/base/ray_compaction.h"
#include "core/gbuffer/covered_pixels.h"
#include "core/gbuffer/facing_surface.h"
#include "core/gbuffer/light_frame.h"
#include "core/gbuffer/reflection_rays.h"
#include "core/optics/ggx.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace hybray {
namespace {

constexpr double kBeforeLight = 1.0 - 1e-4;

enum Dimension : uint32_t { kFirst, kSecond };

struct Frame {
  dvec3 x, y, z;
  explicit Frame(const dvec3& normal) : z(normal) { basis_around(normal, x, y); }
  dvec3 to_world(const dvec3& v) const { return v.x * x + v.y * y + v.z * z; }
  dvec3 to_local(const dvec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
};

struct OneRay {
  dvec3 direction{0.0};  // zero: there is none
  double length = std::numeric_limits<double>::infinity();
  bool about_geometric = false;
};

// The same numbers about the shading normal or, where that one will not do, the geometric one.
template <class Draw>
OneRay about_a_normal(const FacingSurface& s, const Draw& draw) {
  if (glm::dot(s.incoming, s.shading) < 0.0) {
    const dvec3 direction = draw(s.shading);
    if (glm::dot(direction, s.geometric) > 0.0) return {direction};
  }
  const dvec3 direction = draw(s.geometric);
  if (glm::dot(direction, s.geometric) > 0.0) return {.direction = direction, .about_geometric = true};
  return {};
}

OneRay toward_light(const FacingSurface& s, const Light& light) {
  OneRay ray;
  if (light.kind == LightKind::directional) {
    ray.direction = -dvec3(light.direction);
  } else {
    const dvec3 way = dvec3(light.position) - dvec3(s.origin);
    const double distance = glm::length(way);
    if (!(distance > 0.0)) return {};
    ray.direction = way / distance, ray.length = distance * kBeforeLight;
    if (light.kind == LightKind::spot && -glm::dot(ray.direction, dvec3(light.direction)) <
                                             std::cos(static_cast<double>(light.outer_cone_angle)))
      return {};
  }
  return ray;
}

OneRay make_ray(const FacingSurface& s, const Scene& scene, const PixelRaySettings& settings, uint32_t pixel,
                uint32_t sample) {
  const double a = random_unit(pixel, kFirst, sample, settings.seed),
               b = random_unit(pixel, kSecond, sample, settings.seed);
  OneRay ray;
  switch (settings.kind) {
    case RayKind::mirror:
      break;
    case RayKind::rough:
      return about_a_normal(s, [&](const dvec3& normal) {
        const Frame frame(normal);
        const dvec3 h = frame.to_world(sample_visible_normal(frame.to_local(-s.incoming),
                                                             settings.roughness * settings.roughness, a, b));
        return glm::normalize(s.incoming - 2.0 * glm::dot(s.incoming, h) * h);
      });
    case RayKind::ambient:
      ray = about_a_normal(
          s, [&](const dvec3& normal) { return Frame(normal).to_world(sample_cosine_hemisphere(a, b)); });
      ray.length = settings.length;
      break;
    case RayKind::shadow: {
      if (settings.to_sun != dvec3(0.0)) {
        ray.direction = settings.to_sun;
      } else {
        const size_t n = scene.lights.size();
        ray = toward_light(s, scene.lights[std::min(n - 1, static_cast<size_t>(a * static_cast<double>(n)))]);
      }
      if (glm::dot(ray.direction, s.geometric) <= 0.0 || glm::dot(ray.direction, s.shading) <= 0.0) return {};
      break;
    }
  }
  return ray;
}

PixelRays mirror_rays(const GBuffer& g, const Scene& scene) {
  ReflectionRays mirror = make_reflection_rays(g, scene);
  return {std::move(mirror.rays), {}, mirror.mirrored_about_geometric_normal, 0};
}

}  // namespace

PixelRays make_pixel_rays(const GBuffer& g, const Scene& scene, const PixelRaySettings& settings) {
  HYBRAY_CHECK(!g.primitive.empty() && !g.shading_normal.empty());
  HYBRAY_CHECK_LE(1, settings.rays_per_pixel);
  HYBRAY_CHECK(settings.kind != RayKind::shadow || settings.to_sun != dvec3(0.0) || !scene.lights.empty());
  if (settings.kind == RayKind::mirror) return mirror_rays(g, scene);
  const CoveredPixels covered(g);
  const auto samples = static_cast<size_t>(settings.rays_per_pixel);
  PixelRays result;
  result.rays.resize(covered.size() * samples);
  if (asks_for_occlusion(settings.kind)) result.lengths.resize(result.rays.size());
  std::atomic<size_t> about_geometric{0};
  parallel_blocks(covered.tiles(), 64, [&](size_t begin, size_t end) {
    size_t mine = 0;
    for (size_t tile = begin; tile < end; ++tile) {
      size_t j = covered.first(tile) * samples;
      covered.visit(tile, [&](int x, int y) {
        const FacingSurface surface = seen_surface(g, scene, x, y);
        const uint32_t pixel = g.view.pixel_index(x, y);
        for (size_t s = 0; s < samples; ++s) {
          const size_t i = j + s * covered.count(tile);
          const OneRay ray = make_ray(surface, scene, settings, pixel, static_cast<uint32_t>(s));
          const bool made = ray.direction != dvec3(0.0);
          result.rays.set(i, surface.origin, vec3(ray.direction), made ? pixel : kNoRay);
          if (!result.lengths.empty()) result.lengths[i] = static_cast<float>(ray.length);
          mine += made && ray.about_geometric;
        }
        ++j;
      });
    }
    about_geometric += mine;
  });
  result.about_geometric_normal = about_geometric;
  result.skipped = remove_gaps(result.rays, result.lengths);
  return result;
}

}  // namespace hybray
