#include "core/caustics/photon_maps.h"

#include "core/base/parallel.h"
#include "core/caustics/grouped_tree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <vector>

namespace hybray::caustics {
namespace {

constexpr size_t kBlock = 2048;
constexpr float kSameSurface = 0.70710678f;  // cosine between the normals of a pair

// Adds one pair if it counts; returns whether it does.
bool add_pair(const Photon& photon, const VisibilityPoint& point, const optics::OpticsTable& optics,
              FixedPointImage& image) {
  const vec3 apart = photon.position - point.position;
  if (!(glm::dot(apart, apart) <= point.radius * point.radius)) return false;
  if (!(glm::dot(photon.normal, point.normal) > kSameSurface) || !(photon.shading_ratio > 0.0f)) return false;
  const double r = point.radius;
  const dvec3 brdf =
      optics::diffuse_brdf(optics.materials[point.material], static_cast<double>(photon.cos_in),
                           static_cast<double>(point.cos_out));
  const double scale = static_cast<double>(photon.shading_ratio) / (std::numbers::pi * r * r);
  image.add(point.pixel, dvec3(point.weight) * brdf * dvec3(photon.flux) * scale);
  return true;
}

Bounds3 sphere_box(const VisibilityPoint& point) {
  return {point.position - point.radius, point.position + point.radius};
}

}  // namespace

PhotonMapCounts add_mixed_caustics(PhotonMapKind kind, const Scene& scene, const optics::OpticsTable& optics,
                                   std::span<const Photon> photons, const VisibilityPoints& visible,
                                   FixedPointImage& image) {
  PhotonMapCounts counts;
  const std::vector<VisibilityPoint>& points = visible.points;
  if (photons.empty() || points.empty()) return counts;
  const bool backward = kind == PhotonMapKind::backward;
  const size_t items = backward ? points.size() : photons.size();
  std::vector<Bounds3> boxes(items);
  std::vector<uint32_t> primitives(items);
  for (size_t i = 0; i < items; ++i) {
    boxes[i] = backward ? sphere_box(points[i]) : Bounds3{photons[i].position, photons[i].position};
    primitives[i] = backward ? points[i].primitive : photons[i].primitive;
  }
  const GroupedTree tree(scene, boxes, primitives);
  counts.tree_bytes = tree.memory_bytes();

  std::atomic<uint64_t> pairs{0};
  parallel_blocks(backward ? photons.size() : points.size(), kBlock, [&](size_t begin, size_t end) {
    uint64_t mine = 0;
    for (size_t i = begin; i < end; ++i) {
      if (backward)
        tree.visit(Bounds3{photons[i].position, photons[i].position},
                   [&](size_t j) { mine += add_pair(photons[i], points[j], optics, image); });
      else
        tree.visit(sphere_box(points[i]),
                   [&](size_t j) { mine += add_pair(photons[j], points[i], optics, image); });
    }
    pairs += mine;
  });
  counts.pairs = pairs;
  return counts;
}

double largest_radiance(double flux, const VisibilityPoints& visible) {
  double most = 0.0;
  for (const VisibilityPoint& p : visible.points) {
    const double weight = static_cast<double>(std::max({p.weight.x, p.weight.y, p.weight.z}));
    most = std::max(most, weight / (static_cast<double>(p.radius) * static_cast<double>(p.radius)));
  }
  // All flux, on every path of one pixel.
  const double paths =
      visible.pixels > 0 ? static_cast<double>(visible.paths) / static_cast<double>(visible.pixels) : 1.0;
  return std::max(1e-300, paths * flux * most * std::numbers::inv_pi * std::numbers::inv_pi);
}

}  // namespace hybray::caustics
