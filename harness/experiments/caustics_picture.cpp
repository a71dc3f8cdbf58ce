// Pictures of `caustics`: the deferred image without and with them (caustics paper, Figure 6), the caustics
// alone, and the reference; and HDR-FLIP's error map.
//
// All are shown at one exposure. Points with a reference take it from that, so that their pictures compare;
// without one it comes from the point's own image.
#include "core/base/develop.h"
#include "core/base/image_io.h"
#include "core/base/parallel.h"
#include "core/caustics/light_source.h"
#include "core/metrics/magma.h"
#include "harness/experiments/caustics.h"
#include "harness/experiments/picture_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybray::caustics_parts {
namespace {

using namespace caustics;

constexpr int kCameraPaths = 16;   // through specular surfaces, of a pixel
constexpr int kCameraEvents = 12;  // greatest number of specular events along one

// Radiance that a point sends on of the light that reaches it straight from the lights in use. Whatever
// refracts casts a shadow here: its light arrives as a caustic.
dvec3 direct_light(const Setup& setup, const dvec3& place, const dvec3& normal, uint32_t material,
                   double cos_out) {
  dvec3 sum(0.0);
  const optics::SurfaceOptics& surface = setup.caustic_scene.optics.materials[material];
  if (!surface.diffuse) return sum;
  const double offset = 0x1p-17 * (std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}) + 1.0);
  const dvec3 from = place + offset * normal;
  for (const uint32_t index : setup.pass.lights) {
    const Light& light = setup.scene.lights[index];
    const bool directional = light.kind == LightKind::directional;
    const dvec3 way = directional ? -glm::normalize(dvec3(light.direction)) : dvec3(light.position) - from;
    const double distance = directional ? std::numeric_limits<double>::infinity() : glm::length(way);
    const dvec3 to_light = directional ? way : way / distance;
    const double cosine = glm::dot(to_light, normal);
    if (!(cosine > 0.0)) continue;
    if (setup.robust.occluded(vec3(from), vec3(to_light), 0.0f, static_cast<float>(distance * 0.9999)))
      continue;
    const double falloff = directional ? 1.0 : 1.0 / (distance * distance);
    sum += intensity(light, -to_light) * (cosine * falloff) * optics::diffuse_brdf(surface, cosine, cos_out);
  }
  return sum;
}

// The same for all points of one view and its lights, whatever the settings of their caustics.
Image2D<vec3> deferred_image(const Setup& setup) {
  const int w = setup.view.width(), h = setup.view.height();
  const GBuffer& g = setup.gbuffer;
  Image2D<vec3> image(w, h);
  parallel_blocks(image.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const uint32_t primitive = g.primitive[i];
      if (primitive == kNoPrimitive) continue;
      const int x = static_cast<int>(i) % w, y = static_cast<int>(i) / w;
      const dvec3 direction = setup.view.ray_direction(x + 0.5, y + 0.5);
      const dvec3 place =
          setup.view.eye() + setup.view.view_depth_of(static_cast<double>(g.depth[i])) * direction;
      dvec3 normal(g.shading_normal[i]);
      if (glm::dot(normal, direction) > 0.0) normal = -normal;
      const uint32_t material = setup.scene.material_of(primitive);
      const double cos_out = -glm::dot(normal, glm::normalize(direction));
      image[i] = setup.scene.materials[material].emissive +
                 vec3(direct_light(setup, place, normal, material, cos_out));
    }
  });
  if (!sees_specular(setup.caustic_scene, g)) return image;

  CameraPathOptions options;
  options.paths_per_pixel = kCameraPaths;
  options.walk.max_events = kCameraEvents;
  options.walk.seed = setup.pass.walk.seed;
  const VisibilityPoints seen =
      trace_visibility_points(setup.robust, setup.caustic_scene.optics, g, setup.camera_medium, options);
  std::vector<vec3> light(seen.points.size());
  parallel_blocks(light.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const VisibilityPoint& p = seen.points[i];
      light[i] = p.weight * vec3(direct_light(setup, dvec3(p.position), dvec3(p.normal), p.material,
                                              static_cast<double>(p.cos_out)));
    }
  });
  for (size_t i = 0; i < light.size(); ++i) image[seen.points[i].pixel] += light[i];
  return image;
}

// Of images of the same size; the second may be empty.
Image2D<vec3> sum_of(Image2D<vec3> image, const Image2D<vec3>& more) {
  for (size_t i = 0; i < more.size(); ++i) image[i] += more[i];
  return image;
}

}  // namespace

void write_pictures(const Point& point, const Workspace& workspace, const Setup& setup,
                    const Image2D<vec3>& caustics, const Reference* reference, const Image2D<float>& flip) {
  const Image2D<vec3> off = deferred_image(setup), on = sum_of(off, caustics);
  const float exposure = automatic_exposure(reference ? sum_of(off, reference->image.mean) : on);
  const auto write = [&](const char* suffix, const Image2D<vec3>& image) {
    write_png(picture_file(point, workspace, suffix), image.width(), image.height(),
              develop(image, exposure));
  };
  write("_off", off);
  if (!caustics.empty()) {
    write("_on", on);
    write("_caustics", caustics);
  }
  if (reference) write("_reference", reference->image.mean);
  if (!flip.empty())
    write_png(picture_file(point, workspace, "_flip"), flip.width(), flip.height(), metrics::magma(flip));
}

}  // namespace hybray::caustics_parts
