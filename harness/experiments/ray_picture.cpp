#include "harness/experiments/ray_picture.h"

#include "core/base/image_io.h"
#include "harness/experiments/picture_file.h"

#include <algorithm>
#include <array>
#include <string>

namespace hybray {
namespace {

using Rgb = std::array<uint8_t, 3>;

Rgb color_of(ssrm::Verdict verdict, metrics::HitClass kind) {
  if (verdict == ssrm::Verdict::miss) return {150, 190, 240};
  if (verdict != ssrm::Verdict::hit) return {40, 70, 200};
  return kind == metrics::HitClass::right ? Rgb{190, 190, 190} : Rgb{220, 30, 30};
}

}  // namespace

void write_ray_pictures(const Point& point, const Workspace& workspace, const RayFrame& frame) {
  const int width = frame.gbuffer.view.width(), height = frame.gbuffer.view.height();
  for (size_t n = 0; n < frame.bounces.size(); ++n) {
    const RayBounce& b = frame.bounces[n];
    std::vector<uint8_t> rgb(3 * static_cast<size_t>(width) * static_cast<size_t>(height), 0);
    for (size_t i = 0; i < b.rays.size(); ++i) {
      if (b.screen_rays.l_end[i] < 0.0f) continue;  // starts where the view does not show it
      const Rgb color = color_of(b.results.verdict[i], b.classes[i]);
      std::copy(color.begin(), color.end(), rgb.begin() + 3 * static_cast<ptrdiff_t>(b.rays.pixel[i]));
    }
    write_png(picture_file(point, workspace, "_bounce" + std::to_string(n + 1)), width, height, rgb);
  }
}

}  // namespace hybray
