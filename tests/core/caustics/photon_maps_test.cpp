// Density estimation against brute force in double, and against the radiance of an evenly lit plane.
#include "core/caustics/photon_maps.h"

#include "core/caustics/visibility_points.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

constexpr uint64_t kSeed = 555;
constexpr PhotonMapKind kKinds[] = {PhotonMapKind::backward, PhotonMapKind::forward};

double unit(uint64_t item, uint32_t dimension) {
  return random_unit(item, dimension, 0, kSeed);
}

vec3 random_unit_vector(uint64_t item, uint32_t dimension) {
  const double c = 2.0 * unit(item, dimension) - 1.0,
               phi = 2.0 * std::numbers::pi * unit(item, dimension + 1);
  const double s = std::sqrt(1.0 - c * c);
  return vec3(dvec3(s * std::cos(phi), c, s * std::sin(phi)));
}

vec3 random_color(uint64_t item, uint32_t dimension) {
  return vec3(dvec3(unit(item, dimension), unit(item, dimension + 1), unit(item, dimension + 2)));
}

// Photons and points in the unit cube on the surfaces of the mixed scene, glossy paint among them.
std::vector<Photon> random_photons(const Scene& scene, size_t count) {
  std::vector<Photon> photons(count);
  for (uint64_t i = 0; i < count; ++i) {
    Photon& p = photons[i];
    p.position = random_color(i, 0);
    p.normal = random_unit_vector(i, 3);
    p.flux = random_color(i, 5);
    // Some from behind the surface, which carry nothing.
    p.direction = unit(i, 8) < 0.05 ? p.normal : glm::normalize(0.8f * random_unit_vector(i, 11) - p.normal);
    p.cos_in = static_cast<float>(unit(i, 9));
    p.primitive = static_cast<uint32_t>(random_bits(i, 10, 0, kSeed) % scene.primitive_count());
    p.material = scene.material_of(p.primitive);
  }
  return photons;
}

VisibilityPoints random_points(const Scene& scene, size_t count, uint32_t pixels) {
  VisibilityPoints all;
  for (uint64_t i = 0; i < count; ++i) {
    VisibilityPoint v;
    v.position = random_color(i, 20);
    v.normal = random_unit_vector(i, 23);
    v.weight = random_color(i, 25);
    v.cos_out = static_cast<float>(unit(i, 28));
    v.radius = static_cast<float>(0.02 + 0.15 * unit(i, 29));
    v.pixel = static_cast<uint32_t>(random_bits(i, 30, 0, kSeed) % pixels);
    v.primitive = static_cast<uint32_t>(random_bits(i, 31, 0, kSeed) % scene.primitive_count());
    v.material = scene.material_of(v.primitive);
    all.points.push_back(v);
  }
  all.pixels = pixels, all.paths = count;
  return all;
}

TEST(PhotonMaps, BothKindsAreTheSumOverAllPairs) {
  const Prepared p(mixed_scene());
  const std::vector<Photon> photons = random_photons(p.scene, 6000);
  const VisibilityPoints visible = random_points(p.scene, 1500, 12);
  std::vector<dvec3> truth(12, dvec3(0.0));
  uint64_t pairs = 0, turned = 0;
  for (const VisibilityPoint& v : visible.points)
    for (const Photon& photon : photons) {
      const double r = v.radius;
      if (glm::length(dvec3(photon.position) - dvec3(v.position)) > r) continue;
      const bool same_side = glm::dot(dvec3(photon.normal), dvec3(v.normal)) > std::cos(std::numbers::pi / 4);
      turned += !same_side;
      if (!same_side || photon.shading_ratio() == 0.0f) continue;
      ++pairs;
      truth[v.pixel] +=
          dvec3(v.weight) * dvec3(photon.flux) *
          optics::diffuse_brdf(p.caustic.optics.materials[v.material], static_cast<double>(photon.cos_in),
                               static_cast<double>(v.cos_out)) *
          (static_cast<double>(photon.shading_ratio()) / (std::numbers::pi * r * r));
    }
  ASSERT_GT(pairs, 1000u);
  ASSERT_GT(turned, pairs);
  std::vector<Image2D<vec3>> images;
  for (const PhotonMapKind kind : kKinds) {
    FixedPointImage sums(4, 3, 1e6);
    const PhotonMapCounts counts =
        add_mixed_caustics(kind, p.scene, p.caustic.optics, photons, visible, sums);
    EXPECT_EQ(counts.pairs, pairs);
    EXPECT_GT(counts.tree_bytes, 0u);
    EXPECT_EQ(sums.overflows(), 0u);
    images.push_back(sums.image());
    for (size_t i = 0; i < 12; ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(images.back()[i][c], truth[i][c], 1e-6 * truth[i][c]) << "seed " << kSeed;
  }
  for (size_t i = 0; i < 12; ++i) EXPECT_EQ(images[0][i], images[1][i]) << "bit for bit";
}

TEST(PhotonMaps, ABackwardMapServesPortionsOfPhotonsAndTwoRadiiInOneSearch) {
  const Prepared p(mixed_scene());
  const std::vector<Photon> photons = random_photons(p.scene, 6000);
  const VisibilityPoints visible = random_points(p.scene, 1500, 12);
  VisibilityPoints wider = visible;
  for (VisibilityPoint& v : wider.points) v.radius *= 1.5f;
  FixedPointImage expected(4, 3, 1e6), expected_wide(4, 3, 1e6), image(4, 3, 1e6), wide(4, 3, 1e6);
  const auto pairs =
      add_mixed_caustics(PhotonMapKind::forward, p.scene, p.caustic.optics, photons, visible, expected).pairs;
  const auto wide_pairs =
      add_mixed_caustics(PhotonMapKind::forward, p.scene, p.caustic.optics, photons, wider, expected_wide)
          .pairs;
  ASSERT_GT(wide_pairs, 2 * pairs) << "spheres of 3.4 times the volume";

  const BackwardMap map(p.scene, p.caustic.optics, visible, 1.5f);
  uint64_t found = 0;
  for (size_t first = 0; first < photons.size(); first += 2500) {
    const size_t last = std::min(photons.size(), first + 2500);
    const std::vector<Photon> portion(photons.begin() + static_cast<ptrdiff_t>(first),
                                      photons.begin() + static_cast<ptrdiff_t>(last));
    found += map.add(portion, image, &wide).pairs;
  }
  EXPECT_EQ(found, pairs);
  for (size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(image.image()[i], expected.image()[i]) << "bit for bit";
    EXPECT_EQ(wide.image()[i], expected_wide.image()[i]) << "bit for bit";
  }
}

TEST(PhotonMaps, AnEvenlyLitFloorInAMirrorHasItsRadianceTimesTheReflectance) {
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(0.5f, 0.25f, 1.0f));
  const vec3 reflectance(0.9f, 0.6f, 0.3f);
  const uint32_t m = add_material(scene, mirror(reflectance));
  add_floor(scene, 3.0f);
  add_sheet(scene, m, vec3(-1.0f, 0.2f, -2.0f), vec3(2.0f, 0.0f, 0.0f), vec3(0.0f, 1.8f, 0.0f));
  update_content_hash(scene);
  const Prepared p(std::move(scene));
  const View view = make_view(p.scene, vec3(0.3f, 1.0f, 2.0f), vec3(0.0f, 0.7f, -2.0f), 60, 45);
  const GBuffer g = make_gbuffer(p.tracer, view, kCausticBits);
  const VisibilityPoints visible =
      trace_visibility_points(p.tracer, p.caustic.optics, g, 0, CameraPathOptions{});
  const std::vector<Photon> photons = even_floor(600, 3.0);
  FixedPointImage sums(60, 45, largest_radiance(36.0, visible));
  add_mixed_caustics(PhotonMapKind::backward, p.scene, p.caustic.optics, photons, visible, sums);
  EXPECT_EQ(sums.overflows(), 0u);
  EXPECT_LE(sums.peak_fraction(), 0.5);
  const Image2D<vec3> image = sums.image();
  int inner = 0;
  for (const VisibilityPoint& v : visible.points) {
    const double r = v.radius;
    if (std::max(std::abs(v.position.x), std::abs(v.position.z)) + v.radius > 2.99f) continue;
    ++inner;
    // Points of a square lattice in a disc of radius R steps at a random place: the number has a variance of
    // 0.68 R (Kendall 1948), about a mean of pi R^2.
    const double steps = r / 0.01;
    ASSERT_GT(steps, 10.0);
    const double tolerance = 4.5 * std::sqrt(0.68 * steps) / (std::numbers::pi * steps * steps);
    ASSERT_LT(tolerance, 0.05);
    for (int c = 0; c < 3; ++c) {
      const double expected = static_cast<double>(reflectance[c]) *
                              static_cast<double>(p.scene.materials[0].base_color[c]) * std::numbers::inv_pi;
      EXPECT_NEAR(image[v.pixel][c] / expected, 1.0, tolerance) << v.pixel;
    }
  }
  EXPECT_GT(inner, 50);
}

// One photon and one point at the origin, 0.1 m apart along x.
struct Pair {
  Photon photon;
  VisibilityPoints visible;
  Pair() {
    photon.position = vec3(0.1f, 0.0f, 0.0f);
    photon.normal = vec3(0.0f, 1.0f, 0.0f);
    photon.direction = vec3(0.0f, -1.0f, 0.0f);
    photon.flux = vec3(1.0f);
    VisibilityPoint v;
    v.normal = vec3(0.0f, 1.0f, 0.0f);
    v.weight = vec3(1.0f);
    v.radius = 0.2f;
    visible.points = {v};
    visible.pixels = visible.paths = 1;
  }
  // Number of pairs, which both kinds agree on.
  uint64_t count(const Prepared& p) const {
    std::vector<uint64_t> pairs;
    for (const PhotonMapKind kind : kKinds) {
      FixedPointImage sums(1, 1, 1e3);
      pairs.push_back(
          add_mixed_caustics(kind, p.scene, p.caustic.optics, std::vector<Photon>{photon}, visible, sums)
              .pairs);
      EXPECT_EQ(sums.image()(0, 0).x > 0.0f, pairs.back() > 0);
    }
    EXPECT_EQ(pairs[0], pairs[1]);
    return pairs[0];
  }
};

TEST(PhotonMaps, CountOnlyPhotonsOfTheSameSurfaceAndSide) {
  const Prepared p([] {
    Scene scene = empty_scene();
    add_floor(scene, 1.0f);
    update_content_hash(scene);
    return scene;
  }());
  EXPECT_EQ(Pair().count(p), 1u);
  Pair other_side;
  other_side.photon.normal = -other_side.photon.normal;
  EXPECT_EQ(other_side.count(p), 0u);
  Pair corner;
  corner.photon.normal = vec3(-1.0f, 0.0f, 0.0f);
  EXPECT_EQ(corner.count(p), 0u);
  for (const auto& [degrees, counts] : {std::pair(44.0, 1u), std::pair(46.0, 0u)}) {
    Pair slanted;
    const double a = degrees * std::numbers::pi / 180.0;
    slanted.photon.normal = vec3(dvec3(std::sin(a), std::cos(a), 0.0));
    EXPECT_EQ(slanted.count(p), counts) << degrees;
  }
  Pair turned_away;
  turned_away.photon.direction = turned_away.photon.normal;
  EXPECT_EQ(turned_away.count(p), 0u);
  for (const auto& [distance, counts] : {std::pair(0.1999f, 1u), std::pair(0.2001f, 0u)}) {
    Pair apart;
    apart.photon.position = distance * vec3(0.6f, 0.0f, 0.8f);
    EXPECT_EQ(apart.count(p), counts) << distance;
  }
}

TEST(PhotonMaps, OfNothingAddNothing) {
  const Prepared p(mixed_scene());
  const std::vector<Photon> photons = random_photons(p.scene, 10);
  const VisibilityPoints visible = random_points(p.scene, 10, 1);
  for (const PhotonMapKind kind : kKinds) {
    FixedPointImage sums(1, 1, 1.0);
    EXPECT_EQ(add_mixed_caustics(kind, p.scene, p.caustic.optics, {}, visible, sums).pairs, 0u);
    const PhotonMapCounts counts = add_mixed_caustics(kind, p.scene, p.caustic.optics, photons, {}, sums);
    EXPECT_EQ(counts.pairs, 0u);
    EXPECT_EQ(counts.tree_bytes, 0u);
    EXPECT_EQ(sums.image()(0, 0), vec3(0.0f));
  }
}

TEST(PhotonMaps, TheLargestRadianceIsThatOfAllFluxInTheSmallestDisc) {
  Pair pair;
  pair.visible.points.front().weight = vec3(0.5f, 1.0f, 0.25f);
  VisibilityPoint wide = pair.visible.points.front();
  wide.radius = 10.0f, wide.weight = vec3(2.0f);
  pair.visible.points.push_back(wide);
  const double pi = std::numbers::pi;
  EXPECT_NEAR(largest_radiance(7.0, pair.visible), 7.0 / (pi * pi * 0.04), 1e-4);
  pair.visible.paths = 3;
  EXPECT_NEAR(largest_radiance(7.0, pair.visible), 21.0 / (pi * pi * 0.04), 1e-4);
  // A scale that a FixedPointImage can take, even of nothing.
  FixedPointImage sums(1, 1, largest_radiance(0.0, {}));
  sums.add(0, dvec3(0.0));
  EXPECT_EQ(sums.overflows(), 0u);
}

}  // namespace
}  // namespace hybray
