#include "core/caustics/photon_maps.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <vector>

namespace hybray::caustics {
namespace {

constexpr size_t kBlock = 2048;
constexpr float kSameSurface = 0.70710678f;  // cosine between the normals of a pair

// Adds one pair if it counts, with a sphere of this radius; returns whether it does.
bool add_pair(const Photon& photon, const VisibilityPoint& point, float radius,
              const optics::OpticsTable& optics, FixedPointImage& image) {
  const vec3 apart = photon.position - point.position;
  if (!(glm::dot(apart, apart) <= radius * radius)) return false;
  if (!(glm::dot(photon.normal, point.normal) > kSameSurface) || !(photon.shading_ratio() > 0.0f))
    return false;
  const double r = radius;
  const dvec3 brdf =
      optics::diffuse_brdf(optics.materials[point.material], static_cast<double>(photon.cos_in),
                           static_cast<double>(point.cos_out));
  const double scale = static_cast<double>(photon.shading_ratio()) / (std::numbers::pi * r * r);
  image.add(point.pixel, dvec3(point.weight) * brdf * dvec3(photon.flux) * scale);
  return true;
}

Bounds3 sphere_box(const VisibilityPoint& point, float radius) {
  return {point.position - radius, point.position + radius};
}

GroupedTree tree_of_spheres(const Scene& scene, const std::vector<VisibilityPoint>& points, float widening) {
  std::vector<Bounds3> boxes(points.size());
  std::vector<uint32_t> primitives(points.size());
  parallel_blocks(points.size(), kBlock, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      boxes[i] = sphere_box(points[i], points[i].radius * widening), primitives[i] = points[i].primitive;
  });
  return GroupedTree(scene, boxes, primitives);
}

// Forward maps: every visibility point looks for the photons in its sphere.
PhotonMapCounts gather(const Scene& scene, const optics::OpticsTable& optics, const PhotonBlocks& photons,
                       const std::vector<VisibilityPoint>& points, FixedPointImage& image) {
  std::vector<const Photon*> items;
  items.reserve(photons.size());
  photons.for_each([&](const Photon& photon) { items.push_back(&photon); });
  std::vector<Bounds3> boxes(items.size());
  std::vector<uint32_t> primitives(items.size());
  parallel_blocks(items.size(), kBlock, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      boxes[i] = {items[i]->position, items[i]->position}, primitives[i] = items[i]->primitive;
  });
  const GroupedTree tree(scene, boxes, primitives);
  std::atomic<uint64_t> pairs{0};
  parallel_blocks(points.size(), kBlock, [&](size_t begin, size_t end) {
    uint64_t mine = 0;
    for (size_t i = begin; i < end; ++i)
      tree.visit(sphere_box(points[i], points[i].radius),
                 [&](size_t j) { mine += add_pair(*items[j], points[i], points[i].radius, optics, image); });
    pairs += mine;
  });
  return {pairs, tree.memory_bytes()};
}

}  // namespace

BackwardMap::BackwardMap(const Scene& scene, const optics::OpticsTable& optics,
                         const VisibilityPoints& visible, float widening)
    : optics_(optics),
      points_(visible.points),
      widening_(widening),
      tree_(tree_of_spheres(scene, points_, widening)) {
  HYBRAY_CHECK_LE(1.0f, widening);
}

// Every photon looks for the spheres that it lies in.
PhotonMapCounts BackwardMap::add(const PhotonBlocks& photons, FixedPointImage& image,
                                 FixedPointImage* wide) const {
  std::atomic<uint64_t> pairs{0};
  parallel_blocks(photons.blocks().size(), 1, [&](size_t begin, size_t) {
    uint64_t mine = 0;
    for (const Photon& photon : photons.blocks()[begin])
      tree_.visit(Bounds3{photon.position, photon.position}, [&](size_t i) {
        const VisibilityPoint& point = points_[i];
        mine += add_pair(photon, point, point.radius, optics_, image);
        if (wide) add_pair(photon, point, point.radius * widening_, optics_, *wide);
      });
    pairs += mine;
  });
  return {pairs, tree_.memory_bytes()};
}

PhotonMapCounts add_mixed_caustics(PhotonMapKind kind, const Scene& scene, const optics::OpticsTable& optics,
                                   const PhotonBlocks& photons, const VisibilityPoints& visible,
                                   FixedPointImage& image) {
  if (photons.empty() || visible.points.empty()) return {};
  return kind == PhotonMapKind::backward ? BackwardMap(scene, optics, visible).add(photons, image)
                                         : gather(scene, optics, photons, visible.points, image);
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
  // Not so small that the scale of a FixedPointImage would be infinite.
  return std::max(1e-280, paths * flux * most * std::numbers::inv_pi * std::numbers::inv_pi);
}

}  // namespace hybray::caustics
