// What camera paths leave behind, against geometry in double precision.
#include "core/caustics/visibility_points.h"

#include "core/base/parallel.h"
#include "core/caustics/medium_at.h"
#include "core/scene/shapes.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

constexpr int kWidth = 80, kHeight = 60;

// A mirror in the plane z = -2, x in [-1, 1], y in [0.2, 2], over a floor at y = 0 of half side 3.
Scene mirror_scene(const vec3& reflectance) {
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(0.5f));
  const uint32_t m = add_material(scene, mirror(reflectance));
  add_floor(scene, 3.0f);
  add_sheet(scene, m, vec3(-1.0f, 0.2f, -2.0f), vec3(2.0f, 0.0f, 0.0f), vec3(0.0f, 1.8f, 0.0f));
  update_content_hash(scene);
  return scene;
}

// A box of glass of edges `size` about `center`.
void add_box(Scene& scene, uint32_t material, const vec3& center, const vec3& size) {
  mat4 place(1.0f);
  for (int c = 0; c < 3; ++c) place[c][c] = size[c], place[3][c] = center[c];
  append_mesh(scene, make_shape("box", 1), place, material, "box");
}

struct Seen {
  Seen(Scene s, const vec3& eye, const vec3& target)
      : prepared(std::move(s)),
        view(make_view(prepared.scene, eye, target, kWidth, kHeight)),
        gbuffer(make_gbuffer(prepared.tracer, view, kCausticBits)),
        medium(medium_at(prepared.tracer, prepared.caustic.optics, dvec3(eye))) {}

  VisibilityPoints points(const CameraPathOptions& options) const {
    return trace_visibility_points(prepared.tracer, prepared.caustic.optics, gbuffer, medium, options);
  }
  dvec3 direction(uint32_t pixel) const {
    return glm::normalize(
        view.ray_direction(pixel % kWidth + 0.5, static_cast<double>(pixel / kWidth) + 0.5));
  }

  Prepared prepared;
  View view;
  GBuffer gbuffer;
  uint16_t medium;
};

TEST(VisibilityPoints, ThroughAPlaneMirrorAreThoseOfTheMirroredCamera) {
  const vec3 reflectance(0.9f, 0.6f, 0.3f);
  const Seen seen(mirror_scene(reflectance), vec3(0.3f, 1.0f, 2.0f), vec3(0.0f, 0.7f, -2.0f));
  CameraPathOptions options;
  options.radius_pixels = 1.7;
  const VisibilityPoints found = seen.points(options);

  const dvec3 eye = seen.view.eye(), mirrored_eye(eye.x, eye.y, -4.0 - eye.z);
  std::vector<std::optional<dvec3>> expected(kWidth * kHeight);
  size_t pixels = 0, points = 0;
  for (uint32_t pixel = 0; pixel < expected.size(); ++pixel) {
    const dvec3 d = seen.direction(pixel);
    const dvec3 at = eye + (-2.0 - eye.z) / d.z * d;
    // No pixel's centre lies on the mirror's border within rounding.
    ASSERT_GT(std::min({std::abs(std::abs(at.x) - 1.0), std::abs(at.y - 0.2), std::abs(at.y - 2.0)}), 1e-5);
    if (d.z >= 0.0 || std::abs(at.x) > 1.0 || at.y < 0.2 || at.y > 2.0) continue;
    ++pixels;
    const dvec3 from_mirror(d.x, d.y, -d.z);  // a ray of the mirrored camera
    if (from_mirror.y >= 0.0) continue;
    const dvec3 on_floor = mirrored_eye - mirrored_eye.y / from_mirror.y * from_mirror;
    if (std::abs(on_floor.x) > 3.0 || std::abs(on_floor.z) > 3.0) continue;
    expected[pixel] = on_floor;
    ++points;
  }
  ASSERT_GT(points, 50u);
  EXPECT_EQ(found.pixels, pixels);
  EXPECT_EQ(found.paths, pixels);
  ASSERT_EQ(found.points.size(), points);
  const double ledger = found.counts.ledger.total();
  EXPECT_NEAR(ledger, found.counts.ledger.emitted, 1e-9 * ledger);
  for (const VisibilityPoint& v : found.points) {
    ASSERT_TRUE(expected[v.pixel].has_value()) << v.pixel;
    const dvec3 p = *expected[v.pixel];
    expected[v.pixel].reset();
    const double length = glm::length(p - mirrored_eye);
    // The mirror's depth is a float: 1e-7 of some 5 m, and rays leave it at a slant of up to 10.
    EXPECT_LT(glm::length(dvec3(v.position) - p), 1e-5 * length);
    EXPECT_EQ(v.normal, vec3(0.0f, 1.0f, 0.0f));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(v.weight[c], reflectance[c], 1e-6f);
    EXPECT_NEAR(v.radius, 1.7 * length / seen.view.focal(), 1e-5 * length);
    EXPECT_NEAR(v.cos_out, (mirrored_eye.y - p.y) / length, 1e-5);
    EXPECT_EQ(v.material, 0u);
    EXPECT_LT(v.primitive, 2u);
  }
}

TEST(VisibilityPoints, SeveralPathsOfAPixelShareItsWeight) {
  const Seen seen(mirror_scene(vec3(0.8f)), vec3(0.3f, 1.0f, 2.0f), vec3(0.0f, 0.7f, -2.0f));
  CameraPathOptions options;
  const VisibilityPoints one = seen.points(options);
  options.paths_per_pixel = 5;
  const VisibilityPoints five = seen.points(options);
  EXPECT_EQ(five.paths, 5 * one.paths);
  EXPECT_EQ(five.points.size(), 5 * one.points.size());
  for (const VisibilityPoint& v : five.points) EXPECT_NEAR(v.weight.x, 0.16f, 1e-6f);
}

TEST(VisibilityPoints, JitteredPathsStartFromEveryPixelAndAgreeOnAverage) {
  const Seen seen(mirror_scene(vec3(0.8f)), vec3(0.3f, 1.0f, 2.0f), vec3(0.0f, 0.7f, -2.0f));
  CameraPathOptions options;
  const auto total = [](const VisibilityPoints& all) {
    double sum = 0.0;
    for (const VisibilityPoint& v : all.points) sum += static_cast<double>(v.weight.x);
    return sum;
  };
  const double centres = total(seen.points(options));
  options.jittered = true;
  options.paths_per_pixel = 32;
  const VisibilityPoints jittered = seen.points(options);
  EXPECT_EQ(jittered.pixels, static_cast<uint64_t>(kWidth * kHeight));
  EXPECT_EQ(jittered.paths, 32u * kWidth * kHeight);
  // Both measure the area, in pixels, of the floor in the mirror. Its border is less than 160 pixels long,
  // and centres count each border pixel whole or not at all, with variance at most 1/12.
  EXPECT_NEAR(total(jittered) / 0.8, centres / 0.8, 4.5 * std::sqrt(160.0 / 12.0));
  // Every point lies where the mirrored camera sees it in the pixel that it names.
  const dvec3 eye = seen.view.eye();
  for (const VisibilityPoint& v : jittered.points) {
    const dvec3 p(v.position), through = dvec3(p.x, p.y, -4.0 - p.z);
    const dvec2 screen = seen.view.project(through);
    EXPECT_NEAR(screen.x, v.pixel % kWidth + 0.5, 0.5 + 1e-3);
    EXPECT_NEAR(screen.y, static_cast<double>(v.pixel / kWidth) + 0.5, 0.5 + 1e-3);
    EXPECT_NEAR(v.radius, 2.0 * glm::length(through - eye) / seen.view.focal(), 1e-5);
  }
}

// Reflectance by the angles of Fresnel's equations.
double fresnel(double sin_i, double n) {
  const double i = std::asin(sin_i), t = std::asin(sin_i / n);
  if (sin_i < 1e-6) return (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
  const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
  return 0.5 * (s * s + p * p);
}

TEST(VisibilityPoints, UnderWaterCarryTheSquaredRatioOfTheIndicesAndTheTransmittance) {
  constexpr double kIor = 1.25;  // exact in float
  const dvec3 absorption(0.25, 0.125, 0.0);
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(0.5f));
  const uint32_t water = add_material(scene, glass(1.25f, vec3(absorption)));
  // Water with its surface at y = 1, and a matte plate in it at y = 0.
  add_box(scene, water, vec3(0.0f, 0.0f, 0.0f), vec3(20.0f, 2.0f, 20.0f));
  add_sheet(scene, 0, vec3(-9.0f, 0.0f, 9.0f), vec3(18.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, -18.0f));
  update_content_hash(scene);
  const Seen seen(std::move(scene), vec3(0.5f, 3.0f, 1.5f), vec3(0.0f, 1.0f, 0.0f));
  ASSERT_EQ(seen.medium, 0u);
  CameraPathOptions options;
  options.paths_per_pixel = 16;
  options.walk.max_events = 1;
  const VisibilityPoints found = seen.points(options);
  EXPECT_EQ(found.pixels, static_cast<uint64_t>(kWidth * kHeight)) << "water fills the view";
  EXPECT_EQ(found.counts.medium_mismatches, 0u);

  const dvec3 eye = seen.view.eye();
  for (const VisibilityPoint& v : found.points) {
    const dvec3 d = seen.direction(v.pixel);
    const dvec3 enters = eye + (eye.y - 1.0) / -d.y * d;
    dvec3 below(d.x / kIor, 0.0, d.z / kIor);
    below.y = -std::sqrt(1.0 - below.x * below.x - below.z * below.z);
    const double in_water = 1.0 / -below.y;
    // The path starts off the surface by 2^-19 of the box's 20 m; the rest is the rounding of floats.
    const double slant = std::sqrt(1.0 - below.y * below.y) / -below.y;
    ASSERT_LT(glm::length(dvec3(v.position) - (enters + in_water * below)), 0x1p-19 * 20.0 * slant + 5e-6);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(v.weight[c], std::exp(-absorption[c] * in_water) / (kIor * kIor * 16.0), 1e-6);
    ASSERT_NEAR(v.radius, 2.0 * (glm::length(enters - eye) + in_water) / seen.view.focal(), 1e-5);
  }
  // How many paths go through is binomial with the transmittance of their pixel.
  double mean = 0.0, variance = 0.0;
  for (uint32_t pixel = 0; pixel < kWidth * kHeight; ++pixel) {
    const dvec3 d = seen.direction(pixel);
    const double t = 1.0 - fresnel(std::sqrt(1.0 - d.y * d.y), kIor);
    mean += 16.0 * t, variance += 16.0 * t * (1.0 - t);
  }
  EXPECT_NEAR(static_cast<double>(found.points.size()), mean, 4.5 * std::sqrt(variance));
  EXPECT_LT(static_cast<double>(found.points.size()), 16.0 * kWidth * kHeight);
}

TEST(VisibilityPoints, ThroughASlabTheRatioIsOneAgain) {
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(0.5f));
  const uint32_t g = add_material(scene, glass(1.5f));
  add_floor(scene, 20.0f);
  add_box(scene, g, vec3(0.0f, 1.0f, 0.0f), vec3(10.0f, 0.5f, 10.0f));
  update_content_hash(scene);
  const Seen seen(std::move(scene), vec3(0.5f, 3.0f, 1.5f), vec3(0.0f, 1.0f, 0.0f));
  CameraPathOptions options;
  options.walk.max_events = 2;
  const VisibilityPoints found = seen.points(options);
  const dvec3 eye = seen.view.eye();
  double mean = 0.0, variance = 0.0;
  for (uint32_t pixel = 0; pixel < kWidth * kHeight; ++pixel) {
    const dvec3 d = seen.direction(pixel);
    const double t = std::pow(1.0 - fresnel(std::sqrt(1.0 - d.y * d.y), 1.5), 2.0);
    mean += t, variance += t * (1.0 - t);
  }
  EXPECT_NEAR(static_cast<double>(found.points.size()), mean, 4.5 * std::sqrt(variance));
  for (const VisibilityPoint& v : found.points) {
    EXPECT_NEAR(v.weight.x, 1.0, 1e-6);
    // Two refractions: on along the old direction, moved aside.
    const dvec3 d = seen.direction(v.pixel);
    const double sin_i = std::sqrt(1.0 - d.y * d.y), tan_t = sin_i / std::sqrt(1.5 * 1.5 - sin_i * sin_i);
    const double aside = (eye.y - 0.5) * sin_i / -d.y + 0.5 * tan_t;
    const dvec3 p = eye + dvec3(d.x, 0.0, d.z) * (aside / sin_i) - dvec3(0.0, eye.y, 0.0);
    // The path starts off both faces by 2^-19 of the box's 10 m; floats of 40 m round by 5e-6.
    const double slant = tan_t + sin_i / -d.y;
    EXPECT_LT(glm::length(dvec3(v.position) - p), 0x1p-19 * 10.0 * slant + 1e-5);
  }
}

TEST(VisibilityPoints, AreTheSameBitsAtAnyNumberOfThreads) {
  const Seen seen(mixed_scene(), vec3(0.0f, 2.0f, 4.0f), vec3(0.0f, 0.7f, 0.0f));
  CameraPathOptions options;
  options.paths_per_pixel = 9;
  std::vector<VisibilityPoint> first;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    const VisibilityPoints found = seen.points(options);
    ASSERT_GT(found.points.size(), 500u);
    if (first.empty()) {
      first = found.points;
      continue;
    }
    ASSERT_EQ(first.size(), found.points.size());
    EXPECT_EQ(std::memcmp(first.data(), found.points.data(), first.size() * sizeof(VisibilityPoint)), 0);
  }
  // Only pixels that see a specular surface start paths.
  for (const VisibilityPoint& v : first) {
    const uint32_t primitive = seen.gbuffer.primitive[v.pixel];
    ASSERT_NE(primitive, kNoPrimitive);
    ASSERT_TRUE(seen.prepared.caustic.optics.materials[seen.prepared.scene.material_of(primitive)].specular);
  }
}

TEST(VisibilityPoints, WithoutASpecularSurfaceThereAreNone) {
  Scene scene = empty_scene();
  scene.materials.push_back(mirror(vec3(1.0f)));  // of no surface
  add_floor(scene, 3.0f);
  update_content_hash(scene);
  const Seen seen(std::move(scene), vec3(0.0f, 2.0f, 4.0f), vec3(0.0f));
  for (const bool jittered : {false, true}) {
    CameraPathOptions options;
    options.jittered = jittered;
    const VisibilityPoints found = seen.points(options);
    EXPECT_EQ(found.paths, 0u);
    EXPECT_EQ(found.counts.rays, 0u);
    EXPECT_TRUE(found.points.empty());
  }
}

}  // namespace
}  // namespace hybray
