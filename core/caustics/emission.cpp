#include "core/caustics/emission.h"

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/hash.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hybray::caustics {
namespace {

constexpr double kMostPaths = 0x1p40;

// Dimensions of the random numbers below, besides MapEmission::kJitter; those of the path's events come after
// (path_walk.h).
enum : uint32_t { kOffset, kRotation };

// Step of the additive sequence of low discrepancy in one dimension: the golden ratio.
constexpr double kGolden = 0.61803398874989485;

double fraction(double x) {
  return x - std::floor(x);
}

uint64_t paths_of(double expected, double offset) {
  return expected > offset ? static_cast<uint64_t>(std::ceil(expected - offset)) : 0;
}

}  // namespace

double expected_paths(const VisibilityMap& map, EmissionKind kind, double rays_per_texel) {
  const uint64_t texels = kind == EmissionKind::map ? map.texels.size() : map.texels_total;
  const double expected = rays_per_texel * static_cast<double>(texels);
  if (!(rays_per_texel > 0.0) || !std::isfinite(rays_per_texel))
    throw InputError("rays_per_texel", fmt::format("{} is not a positive number", rays_per_texel));
  if (expected > kMostPaths)
    throw InputError("rays_per_texel", fmt::format("{} rays for each of {} texels are more than 2^40 paths",
                                                   rays_per_texel, texels));
  return expected;
}

Emission::Emission(const Light& light, const VisibilityMap& map, const Bounds3& scene, EmissionKind kind,
                   double expected, uint64_t seed)
    : from_map_{map, Intensity(light), seed, {}, random_unit(0, kOffset, 0, seed)},
      domain_(light, scene),
      domain_offset_(random_unit(1, kOffset, 0, seed)),
      rotation_(random_unit(0, kRotation, 0, seed)) {
  for (const MapFrame& frame : map.frames) from_map_.frames.emplace_back(frame.frame);
  if (kind == EmissionKind::mixture && map.texels.empty()) kind = EmissionKind::uniform;
  if (kind == EmissionKind::map) HYBRAY_CHECK(!map.texels.empty());
  map_expected_ = kind == EmissionKind::map ? expected : kind == EmissionKind::mixture ? 0.5 * expected : 0.0;
  domain_expected_ = expected - map_expected_;
  from_map_.domain_density = domain_expected_ / domain_.measure();
  from_map_.texels_a_path = static_cast<double>(map.texels.size()) / map_expected_;
  from_map_.paths = paths_of(map_expected_, from_map_.offset);
  domain_paths_ = paths_of(domain_expected_, domain_offset_);
}

PathStart Emission::start(uint64_t path) const {
  return path < from_map_.paths ? from_map_.start(path) : from_domain(path - from_map_.paths);
}

PathStart MapEmission::start(uint64_t path) const {
  const double i = static_cast<double>(path);
  const size_t index = std::min(map.texels.size() - 1, static_cast<size_t>((i + offset) * texels_a_path));
  const MapTexel& texel = map.texels[index];
  const uint64_t jitter = random_bits(index, kJitter, 0, seed);
  const double x = texel.x + fraction(static_cast<double>(jitter >> 32) * 0x1p-32 + i * kPlasticX);
  const double y = texel.y + fraction(static_cast<double>(jitter & 0xffffffffu) * 0x1p-32 + i * kPlasticY);

  PathStart start;
  double density = 0.0;
  frames[texel.frame].ray(x, y, start.origin, start.direction, density);
  start.in_map = true;
  start.frame = texel.frame;
  start.x = texel.x, start.y = texel.y;
  // Paths a unit of the measure here: through the map 1 / (texels_a_path density), and over the domain.
  const double per_path = texels_a_path * density;
  start.flux = intensity(start.direction) *
               (domain_density > 0.0 ? per_path / (1.0 + per_path * domain_density) : per_path);
  return start;
}

PathStart Emission::from_domain(uint64_t path) const {
  PathStart start;
  const double i = static_cast<double>(path);
  domain_.sample(fraction(rotation_ + i * kGolden), (i + domain_offset_) / domain_expected_, start.origin,
                 start.direction);
  double density = from_map_.domain_density;
  dvec2 image(0.0);
  if (find_texel(start, image))
    density += map_expected_ / (static_cast<double>(from_map_.map.texels.size()) *
                                from_map_.map.frames[start.frame].frame.measure_density(image.x, image.y));
  start.flux = from_map_.intensity(start.direction) / density;
  return start;
}

bool Emission::find_texel(PathStart& start, dvec2& image) const {
  for (uint32_t f = 0; f < from_map_.map.frames.size(); ++f) {
    const MapFrame& frame = from_map_.map.frames[f];
    // A point of the ray that lies in front of the frame: orthographic frames start before the scene.
    const double reach =
        frame.frame.orthographic
            ? std::abs(glm::dot(frame.frame.origin - start.origin, frame.frame.forward)) + 1.0
            : 1.0;
    if (!frame.frame.project(start.origin + reach * start.direction, image)) continue;
    const int x = static_cast<int>(image.x), y = static_cast<int>(image.y);
    if (!frame.active(x, y)) continue;
    start.in_map = true;
    start.frame = f;
    start.x = static_cast<uint16_t>(x), start.y = static_cast<uint16_t>(y);
    return true;
  }
  return false;
}

}  // namespace hybray::caustics
