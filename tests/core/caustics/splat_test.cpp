// Deposits against what a lit surface must look like.
#include "core/caustics/splat.h"

#include "tests/core/caustics/caustic_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

Scene floor_scene() {
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(0.5f, 0.25f, 1.0f));
  add_floor(scene, 2.0f);
  update_content_hash(scene);
  return scene;
}

// Where the ray through a point of the screen meets the plane at height y; nothing where it does not.
std::optional<dvec3> on_plane(const View& view, double px, double py, double y) {
  const dvec3 d = view.ray_direction(px, py);
  const double t = (y - view.eye().y) / d.y;
  if (!(t > 0.0)) return std::nullopt;
  return view.eye() + t * d;
}
bool in_square(const std::optional<dvec3>& p, double half) {
  return p && std::abs(p->x) < half && std::abs(p->z) < half;
}

// Flux of the photons on screen whose pixel's centre `shows` something else than their surface.
template <class Shows>
double flux_in_wrong_pixels(const std::vector<Photon>& photons, const View& view, const Shows& shows) {
  double flux = 0.0;
  for (const Photon& photon : photons) {
    const dvec2 place = view.project(dvec3(photon.position));
    if (!(view.view_depth(dvec3(photon.position)) > view.near())) continue;
    if (place.x < 0.0 || place.y < 0.0 || place.x >= view.width() || place.y >= view.height()) continue;
    if (!shows(std::floor(place.x) + 0.5, std::floor(place.y) + 0.5)) flux += mean_flux(photon);
  }
  return flux;
}

TEST(Splat, EvenIrradianceGivesTheRadianceOfALambertianFloorFromEveryAngle) {
  const Prepared p(floor_scene());
  constexpr int kGrid = 2000;
  const double step = 4.0 / kGrid;
  const std::vector<Photon> photons = even_floor(kGrid, 2.0);
  struct Case {
    vec3 eye;
    float fov;
  };
  // From above; wide, so that the corners of the image are far off the axis; and grazing, 6 degrees.
  for (const Case& c : {Case{vec3(0.0f, 1.5f, 0.01f), 50.0f}, Case{vec3(0.2f, 0.8f, 0.3f), 100.0f},
                        Case{vec3(0.0f, 0.2f, 1.9f), 30.0f}}) {
    const View view = make_view(p.scene, c.eye, vec3(0.0f), 48, 36, c.fov);
    const GBuffer g = make_gbuffer(p.tracer, view, kCausticBits);
    // By depth, pixels along the floor's border whose centres see past it turn their photons away.
    const double past_the_border = flux_in_wrong_pixels(
        photons, view, [&](double x, double y) { return in_square(on_plane(view, x, y, 0.0), 2.0); });
    for (const Visibility visibility : {Visibility::depth, Visibility::shadow}) {
      FixedPointImage sums(48, 36, largest_radiance(100.0, g));
      const SplatCounts counts = splat(photons, g, p.caustic.optics, visibility, p.tracer, sums);
      EXPECT_NEAR(counts.landed + counts.offscreen + counts.rejected, 16.0, 1e-4);
      EXPECT_NEAR(counts.rejected, visibility == Visibility::depth ? past_the_border : 0.0, 1e-9);
      EXPECT_EQ(sums.overflows(), 0u);
      const Image2D<vec3> image = sums.image();
      int compared = 0;
      for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) {
          // Pixels that lie on the floor with all four corners.
          std::array<std::optional<dvec3>, 4> corners;
          bool inside = true;
          for (int k = 0; k < 4; ++k) {
            corners[k] = on_plane(view, x + (k == 1 || k == 2), y + (k >= 2), 0.0);
            inside &= in_square(corners[k], 2.0 - step);
          }
          if (!inside) continue;
          // Each photon counts with 1 / area of the pixel at its own place, which is right on average. A
          // convex region of area A and perimeter P, in steps of the grid, holds A points but for P / 2 + 1
          // (Nosarzewska 1948), whose weights differ from the mean by less than a tenth.
          double perimeter = 0.0;
          for (int k = 0; k < 4; ++k) perimeter += glm::length(*corners[(k + 1) % 4] - *corners[k]);
          const double area =
              0.5 * glm::length(glm::cross(*corners[2] - *corners[0], *corners[3] - *corners[1]));
          const double tolerance = 1.1 * (0.5 * perimeter * step + step * step) / area;
          for (int channel = 0; channel < 3; ++channel) {
            const double expected =
                static_cast<double>(p.scene.materials[0].base_color[channel]) / std::numbers::pi;
            EXPECT_NEAR(static_cast<double>(image(x, y)[channel]) / expected, 1.0, tolerance)
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
  splat(even_floor(2000, 2.0), g, p.caustic.optics, Visibility::depth, p.tracer, sums);
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
  const std::vector<Photon> photons = even_floor(800, 2.0);
  // By depth, whole pixels are hidden: those whose centres see the sheet, or past the floor. By rays, every
  // photon whose line to the eye crosses the sheet, a square of side 1.2 on the floor.
  const double hidden_pixels = flux_in_wrong_pixels(photons, view, [&](double x, double y) {
    return !in_square(on_plane(view, x, y, 0.5), 0.5) && in_square(on_plane(view, x, y, 0.0), 2.0);
  });
  double hidden_photons = 0.0;
  for (const Photon& photon : photons) {
    const dvec3 at(photon.position), crossing = at + (0.5 / view.eye().y) * (view.eye() - at);
    if (in_square(crossing, 0.5)) hidden_photons += mean_flux(photon);
  }
  EXPECT_NEAR(hidden_photons, 1.2 * 1.2, 4.8 * 0.005);
  for (const Visibility visibility : {Visibility::depth, Visibility::shadow}) {
    FixedPointImage sums(64, 64, largest_radiance(100.0, g));
    const SplatCounts counts = splat(photons, g, p.caustic.optics, visibility, p.tracer, sums);
    EXPECT_NEAR(counts.rejected, visibility == Visibility::depth ? hidden_pixels : hidden_photons, 1e-9);
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
  std::vector<Photon> photons = even_floor(300, 2.0);
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
