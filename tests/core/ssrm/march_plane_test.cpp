#include "core/ssrm/march_plane.h"

#include "core/truth/march_level0.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

constexpr MarchOptions kPlane{.marcher = Marcher::plane};

// A floor, and a wall that stands back from it at a slant, seen at a low angle: along the floor, and where
// rays meet the wall, pixels span much depth.
Scene floor_and_slanted_wall() {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-10, 0, 4), vec3(20, 0, 0), vec3(0, 0, -12));
  test::add_rectangle(scene, vec3(-10, 0, -8), vec3(20, 0, -6), vec3(0, 12, 0));
  return scene;
}

// Of the rays from the floor whose true hit on the wall the view sees, away from the screen's edge, all are
// HITs: planes leave no gap between neighbours, and nothing else stands in the way.
TEST(MarchPlane, FindsEveryHitOfAFloorsRaysOnASlantedWall) {
  const Scene scene = floor_and_slanted_wall();
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 0.6f, 3.5f), vec3(0, 1.2f, -8)}, {.width = 160, .height = 100},
                  scene.bounds);
  const test::MainView v(tracer, view);
  const MarchResults results = v.march(kPlane);
  // The wall: z = -8 - 0.3 (x + 10).
  size_t right = 0, paper = 0;
  const MarchResults flat = v.march();
  for (size_t i = 0; i < v.rays.size(); ++i) {
    if (v.gbuffer.primitive[v.rays.pixel[i]] > 1) continue;
    const dvec3 o(v.rays.origin(i)), d(v.rays.direction(i));
    const double t = (-11.0 - o.z - 0.3 * o.x) / (d.z + 0.3 * d.x);
    const dvec3 p = o + t * d;
    const dvec2 pixel = view.project(p);
    if (!(t > 0.0) || p.y > 11.0 || std::abs(p.x) > 9.5 || pixel.y < 2.0 || pixel.x < 2.0 || pixel.x > 158.0)
      continue;
    ++right;
    paper += flat.verdict[i] == Verdict::hit;
    ASSERT_EQ(results.verdict[i], Verdict::hit) << i;
    // Within rounding of a border, the neighbour on its other side.
    EXPECT_NEAR(results.pixel[i] % 160 + 0.5, pixel.x, 0.501);
    EXPECT_NEAR(results.pixel[i] / 160 + 0.5, pixel.y, 0.501);
  }
  EXPECT_GT(right, 2000u);
  EXPECT_LE(paper, right);
}

TEST(MarchPlane, EndsInEveryVerdictThatHasACause) {
  const Scene scene = test::triangle_soup(60, 1.5f, 2.0f, 64);
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 0, 3), vec3(0)}, {.width = 320, .height = 200, .near = 2.0},
                  scene.bounds);
  std::array<size_t, kVerdicts> counts{};
  const MarchResults results = test::MainView(tracer, view).march(kPlane);
  for (size_t i = 0; i < results.size(); ++i) {
    ++counts[static_cast<size_t>(results.verdict[i])];
    EXPECT_EQ(results.verdict[i] == Verdict::hit, results.pixel[i] != kNoPixel);
  }
  for (Verdict verdict : {Verdict::hit, Verdict::miss, Verdict::offscreen, Verdict::viewer, Verdict::behind})
    EXPECT_GT(counts[static_cast<size_t>(verdict)], 0u) << label(verdict);
  EXPECT_EQ(counts[static_cast<size_t>(Verdict::correction)], 0u) << "there is no correction to fail";
}

// What bounds are made of, and when the march goes up, must cost samples at most.
TEST(MarchPlane, LabelsDependOnNeitherBoundsNorAscent) {
  const Scene scene = test::triangle_soup(300, 1.0f, 2.0f, 21);
  const Tracer tracer(scene, {.robust = true});
  for (const auto& [width, height] : {std::pair(320, 180), {333, 217}, {64, 1}}) {
    const View view(Camera{"c", vec3(0, 0.5f, 3), vec3(0)}, {.width = width, .height = height, .near = 0.5},
                    scene.bounds);
    test::MainView v(tracer, view);
    const MarchResults exhaustive =
        truth::march_level0<float>(v.depth(), v.screen_rays, v.rays.pixel, 1, Marcher::plane);
    for (const auto bounds : {SlantedPyramid::Bounds::slanted, SlantedPyramid::Bounds::flat}) {
      v.slanted.build(v.gbuffer.depth, v.gbuffer.depth_derivatives, view.depth_sign(),
                      view.background_depth(), bounds);
      for (const Ascent ascent : {Ascent::parent, Ascent::iteration}) {
        const MarchResults marched = v.march({.marcher = Marcher::plane, .ascent = ascent});
        EXPECT_EQ(marched.verdict, exhaustive.verdict);
        EXPECT_EQ(marched.pixel, exhaustive.pixel);
      }
    }
  }
}

}  // namespace
}  // namespace hybray::ssrm
