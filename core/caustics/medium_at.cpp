#include "core/caustics/medium_at.h"

#include "core/optics/specular_step.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybray::caustics {

uint16_t medium_at(const Tracer& tracer, const optics::OpticsTable& optics, const dvec3& point) {
  if (!optics.any_interface) return 0;
  constexpr int kDirections = 7, kMostSurfaces = 64;
  std::array<uint16_t, kDirections> votes{};
  for (int i = 0; i < kDirections; ++i) {
    // A spiral over the sphere, turned so that no direction is an axis.
    const double y = 1.0 - (2.0 * i + 1.0) / kDirections, s = std::sqrt(1.0 - y * y);
    const double phi = 2.3999632297286533 * i + 0.3;
    const dvec3 direction(s * std::cos(phi), y, s * std::sin(phi));
    dvec3 origin = point;
    for (int n = 0; n < kMostSurfaces; ++n) {
      const Hit hit = tracer.intersect(vec3(origin), vec3(direction));
      if (!hit.valid()) break;
      const SurfacePoint p = surface_point(tracer.scene(), hit.primitive, hit.u, hit.v,
                                           origin + static_cast<double>(hit.t) * direction);
      const optics::SurfaceOptics& surface = optics.materials[p.material];
      const optics::Facing facing = optics::facing(p, direction);
      if (surface.interface) {
        votes[static_cast<size_t>(i)] = facing.from_inner ? surface.inner_medium : surface.outer_medium;
        break;
      }
      origin = p.position - facing.geometric * p.offset;
    }
  }
  // The medium that most directions name.
  return *std::max_element(votes.begin(), votes.end(), [&](uint16_t a, uint16_t b) {
    return std::count(votes.begin(), votes.end(), a) < std::count(votes.begin(), votes.end(), b);
  });
}

}  // namespace hybray::caustics
