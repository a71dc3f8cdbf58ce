#include "harness/experiments/ssrm_picture.h"

#include "core/base/image_io.h"
#include "core/gbuffer/triangle_plane.h"
#include "core/scene/surface_point.h"
#include "harness/experiments/picture_file.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybray {
namespace {

using Rgb = std::array<uint8_t, 3>;
constexpr Rgb kUnknown{40, 70, 200}, kMiss{150, 190, 240}, kFalseHit{220, 30, 30};

// Grey of the surface seen at a pixel under a light from `direction`: luminance times cosine, in sRGB.
Rgb surface_grey(const View& view, const Scene& scene, uint32_t primitive, uint32_t pixel,
                 const vec3& direction) {
  const vec3 color = scene.materials[scene.material_of(primitive)].base_color;
  const double luminance = 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
  const auto x = pixel % static_cast<uint32_t>(view.width()), y = pixel / static_cast<uint32_t>(view.width());
  const dvec3 point = seen_point(view, scene, primitive, x + 0.5, y + 0.5);
  const double cosine = std::abs(glm::dot(geometric_normal(scene, primitive, point), dvec3(direction)));
  const double linear = std::clamp(luminance * (0.15 + 0.85 * cosine), 0.0, 1.0);
  const auto grey = static_cast<uint8_t>(std::lround(40.0 + 215.0 * std::pow(linear, 1.0 / 2.2)));
  return {grey, grey, grey};
}

// What the main view sees under a light at the eye, in the same greys.
std::vector<uint8_t> view_picture(const GBuffer& g, const Scene& scene) {
  std::vector<uint8_t> rgb(3 * g.primitive.size(), 0);
  for (uint32_t i = 0; i < g.primitive.size(); ++i) {
    if (g.primitive[i] == kNoPrimitive) continue;
    const uint32_t width = static_cast<uint32_t>(g.view.width()), x = i % width, y = i / width;
    const vec3 direction(glm::normalize(g.view.ray_direction(x + 0.5, y + 0.5)));
    const Rgb color = surface_grey(g.view, scene, g.primitive[i], i, direction);
    std::copy(color.begin(), color.end(), rgb.begin() + 3 * static_cast<ptrdiff_t>(i));
  }
  return rgb;
}

}  // namespace

void write_verdict_picture(const Point& point, const Workspace& workspace, const GBuffer& gbuffer,
                           const Scene& scene, const RayStream& rays, const ssrm::MarchResults& results,
                           const std::vector<metrics::HitClass>& classes) {
  write_verdict_picture(point, workspace, gbuffer, scene, rays, results, classes, gbuffer.view,
                        [&](size_t i) { return gbuffer.primitive[results.pixel[i]]; });
}

void write_verdict_picture(const Point& point, const Workspace& workspace, const GBuffer& gbuffer,
                           const Scene& scene, const RayStream& rays, const ssrm::MarchResults& results,
                           const std::vector<metrics::HitClass>& classes, const View& march_view,
                           const std::function<uint32_t(size_t ray)>& primitive_of) {
  const int width = gbuffer.view.width(), height = gbuffer.view.height();
  std::vector<uint8_t> rgb(3 * static_cast<size_t>(width) * static_cast<size_t>(height), 0);
  for (size_t i = 0; i < rays.size(); ++i) {
    Rgb color = results.verdict[i] == ssrm::Verdict::miss ? kMiss : kUnknown;
    if (results.verdict[i] == ssrm::Verdict::hit)
      color = classes[i] == metrics::HitClass::right
                  ? surface_grey(march_view, scene, primitive_of(i), results.pixel[i], rays.direction(i))
                  : kFalseHit;
    std::copy(color.begin(), color.end(), rgb.begin() + 3 * static_cast<ptrdiff_t>(rays.pixel[i]));
  }
  write_png(picture_file(point, workspace), width, height, rgb);
  write_png(picture_file(point, workspace, "_view"), width, height, view_picture(gbuffer, scene));
}

}  // namespace hybray
