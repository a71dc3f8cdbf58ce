// Deposits against what a lit surface must look like.
#include "core/caustics/splat.h"

#include "tests/core/caustics/caustic_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

// Photons of equal flux on an n x n grid over the square [-half, half]^2 of the floor y = 0: irradiance 1
// W/m^2.
std::vector<Photon> grid_of_photons(int n, double half) {
  std::vector<Photon> photons;
  const double step = 2.0 * half / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      Photon p;
      p.position = vec3(dvec3(-half + (i + 0.5) * step, 0.0, -half + (j + 0.5) * step));
      p.normal = vec3(0.0f, 1.0f, 0.0f);
      p.direction = glm::normalize(vec3(0.6f, -0.8f, 0.0f));
      p.flux = vec3(static_cast<float>(step * step));
      p.cos_in = 0.8f;
      photons.push_back(p);
    }
  return photons;
}

Scene floor_scene() {
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(0.5f, 0.25f, 1.0f));
  add_floor(scene, 2.0f);
  update_content_hash(scene);
  return scene;
}

TEST(Splat, EvenIrradianceGivesTheRadianceOfALambertianFloorFromEveryAngle) {
  const Prepared p(floor_scene());
  const std::vector<Photon> photons = grid_of_photons(2000, 2.0);
  struct Case {
    vec3 eye;
    float fov;
  };
  // From above; wide, so that the corners of the image are far off the axis; and grazing, 6 degrees.
  for (const Case& c : {Case{vec3(0.0f, 1.5f, 0.01f), 50.0f}, Case{vec3(0.2f, 0.8f, 0.3f), 100.0f},
                        Case{vec3(0.0f, 0.2f, 1.9f), 30.0f}}) {
    const View view = make_view(p.scene, c.eye, vec3(0.0f), 48, 36, c.fov);
    const GBuffer g = make_gbuffer(p.tracer, view, kCausticBits);
    for (const Visibility visibility : {Visibility::depth, Visibility::shadow}) {
      FixedPointImage sums(48, 36, largest_radiance(100.0, g));
      const SplatCounts counts = splat(photons, g, p.caustic.optics, visibility, p.tracer, sums);
      EXPECT_NEAR(counts.landed + counts.offscreen + counts.rejected, 16.0, 1e-4);
      // By depth, pixels along the floor's border whose centres see past it: half a pixel of at most 16 m, of
      // up to 0.05 m each.
      EXPECT_LT(counts.rejected, visibility == Visibility::depth ? 0.4 : 1e-2);
      EXPECT_EQ(sums.overflows(), 0u);
      const Image2D<vec3> image = sums.image();
      int compared = 0;
      for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) {
          // Pixels that lie on the floor with all four corners, and the photons that they should hold.
          bool inside = true;
          for (int k = 0; k < 4; ++k) {
            const dvec3 d = view.ray_direction(x + (k & 1), y + (k >> 1));
            const double t = -view.eye().y / d.y;
            const dvec3 q = view.eye() + t * d;
            inside &= t > 0.0 && std::abs(q.x) < 1.99 && std::abs(q.z) < 1.99;
          }
          if (!inside) continue;
          // A grid of step h in a region of area A has A / h^2 points, but for those along its border: about
          // perimeter / h of them come or go. The smallest pixel here is some 20 x 20 steps.
          for (int channel = 0; channel < 3; ++channel) {
            const double expected =
                static_cast<double>(p.scene.materials[0].base_color[channel]) / std::numbers::pi;
            EXPECT_NEAR(static_cast<double>(image(x, y)[channel]) / expected, 1.0, 0.12)
                << x << " " << y << " eye " << c.eye.y;
          }
          ++compared;
        }
      EXPECT_GT(compared, 300);
    }
  }
}

TEST(Splat, TheMeanOverAllPixelsIsExactToAPercent) {
  // Single pixels hold few enough grid points to be off by some; their sum is not.
  const Prepared p(floor_scene());
  const View view = make_view(p.scene, vec3(0.3f, 0.9f, 1.2f), vec3(0.0f), 64, 64, 40.0f);
  const GBuffer g = make_gbuffer(p.tracer, view, kCausticBits);
  FixedPointImage sums(64, 64, largest_radiance(100.0, g));
  splat(grid_of_photons(2000, 2.0), g, p.caustic.optics, Visibility::depth, p.tracer, sums);
  const Image2D<vec3> image = sums.image();
  double mean = 0.0;
  for (const vec3& v : image) mean += static_cast<double>(v.z) / static_cast<double>(image.size());
  EXPECT_NEAR(mean * std::numbers::pi, 1.0, 0.01);
}

TEST(Splat, WhatTheCameraDoesNotSeeIsRejected) {
  Scene scene = floor_scene();
  add_sheet(scene, 0, vec3(-0.5f, 0.5f, 0.5f), vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, -1.0f));
  update_content_hash(scene);
  const Prepared p(std::move(scene));
  const View view = make_view(p.scene, vec3(0.0f, 3.0f, 0.01f), vec3(0.0f), 64, 64, 70.0f);
  const GBuffer g = make_gbuffer(p.tracer, view, kCausticBits);
  const std::vector<Photon> photons = grid_of_photons(800, 2.0);
  // The sheet covers a square of side 3 / 2.5 on the floor.
  const double hidden = 1.2 * 1.2;
  for (const Visibility visibility : {Visibility::depth, Visibility::shadow}) {
    FixedPointImage sums(64, 64, largest_radiance(100.0, g));
    const SplatCounts counts = splat(photons, g, p.caustic.optics, visibility, p.tracer, sums);
    // By depth, the pixels along the border (0.066 wide) count whole or not at all.
    EXPECT_NEAR(counts.rejected, hidden, visibility == Visibility::depth ? 4.8 * 0.066 : 0.02);
  }
  // Photons on the lower side of the floor are on its far side.
  std::vector<Photon> below = photons;
  for (Photon& photon : below) photon.normal = -photon.normal;
  FixedPointImage sums(64, 64, largest_radiance(100.0, g));
  EXPECT_EQ(splat(below, g, p.caustic.optics, Visibility::depth, p.tracer, sums).landed, 0.0);
}

TEST(Splat, OrderDoesNotChangeABit) {
  const Prepared p(floor_scene());
  const View view = make_view(p.scene, vec3(0.3f, 0.9f, 1.2f), vec3(0.0f), 33, 21, 60.0f);
  const GBuffer g = make_gbuffer(p.tracer, view, kCausticBits);
  std::vector<Photon> photons = grid_of_photons(300, 2.0);
  std::vector<Image2D<vec3>> images;
  for (int pass = 0; pass < 2; ++pass) {
    FixedPointImage sums(33, 21, largest_radiance(100.0, g));
    splat(photons, g, p.caustic.optics, Visibility::depth, p.tracer, sums);
    images.push_back(sums.image());
    std::reverse(photons.begin(), photons.end());
  }
  for (size_t i = 0; i < images[0].size(); ++i) ASSERT_EQ(images[0][i], images[1][i]);
}

}  // namespace
}  // namespace hybray
