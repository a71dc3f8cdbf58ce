#include "core/ssrm/march_hiz.h"

#include "core/ssrm/cell_walk.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

constexpr uint64_t kSeed = 74;

// A view with geometric normals.
struct NormalView {
  test::MainView main;
  NormalView(const Tracer& tracer, const View& view) : main(tracer, view) {
    main.gbuffer.geometric_normal = make_gbuffer(tracer, view, kGeometricNormal).geometric_normal;
  }
  MarchResults march(const HizOptions& options) const {
    MarchResults results;
    results.resize(main.rays.size());
    march_hiz(main.depth(), main.gbuffer, main.rays, main.screen_rays, options, results);
    return results;
  }
};

// The first pixel after the ray's own in which the ray gets behind the stored depth: pixel by pixel, in
// double.
HizCandidate linear_search(const test::MainView& v, size_t i) {
  const auto ray = v.screen_rays.get<double>(i);
  const int width = v.gbuffer.view.width(), height = v.gbuffer.view.height();
  const auto own = static_cast<int>(v.rays.pixel[i]);
  CellWalk<double> walk(ray, width, height, own % width, own / width);
  for (bool first = true;; first = false) {
    const auto exit = walk.exit(0);
    const bool ends = ray.l_end <= exit.l();
    const double leave = ends ? ray.l_end : exit.l();
    const double stored = v.pyramid.at(0, walk.px, walk.py);
    if (!first && std::max(ray.oz + walk.l * ray.dz, ray.oz + leave * ray.dz) > stored) {
      const double crossing = (stored - ray.oz) / ray.dz;
      const double l = ray.oz + walk.l * ray.dz >= stored ? walk.l : std::clamp(crossing, walk.l, leave);
      return {Verdict::hit, static_cast<uint32_t>(walk.py * width + walk.px), l};
    }
    if (ends) return {ray.end, kNoPixel, 0.0};
    if (!walk.advance(exit)) return {Verdict::offscreen, kNoPixel, 0.0};
  }
}

TEST(MarchHiz, TheHierarchyStopsWhereALinearSearchStops) {
  const Scene scene = test::triangle_soup(80, 1.2f, 2.0f, kSeed);
  const Tracer tracer(scene, {.robust = true});
  for (const auto& [w, h] : {std::pair{333, 217}, {64, 1}, {1, 1}}) {
    const test::MainView v(
        tracer, View(Camera{"c", vec3(0, 0, 5), vec3(0)}, {.width = w, .height = h}, scene.bounds));
    size_t different = 0, hits = 0;
    uint64_t steps = 0;
    for (size_t i = 0; i < v.rays.size(); ++i) {
      const HizCandidate found =
          hiz_traverse(v.depth(), v.screen_rays.get<float>(i), v.rays.pixel[i], {}, steps);
      const HizCandidate expected = linear_search(v, i);
      if (found.verdict != expected.verdict || found.pixel != expected.pixel) {
        ++different;
        continue;
      }
      hits += found.verdict == Verdict::hit;
      if (found.verdict == Verdict::hit) {
        // l in float; 2^-24 of the ray's screen position, some 300 pixels, over the pixels of a unit of l.
        const double pixels = std::hypot(v.screen_rays.dx[i], v.screen_rays.dy[i]);
        EXPECT_NEAR(found.l, expected.l, 1e-3 / pixels + 1e-5 * expected.l) << i;
      }
    }
    // Only rays within rounding of a pixel's corner or of a depth: a few in 10,000.
    EXPECT_LE(different, v.rays.size() / 2000) << "seed " << kSeed << ", " << v.rays.size() << " rays";
    if (w > 300) {
      EXPECT_GT(hits, 5000u);
      EXPECT_LT(steps, 40 * v.rays.size());
    }
  }
}

TEST(MarchHiz, HitsAreTheCandidatesOfTheLinearSearchWithinTheThickness) {
  // A wall before a mirror floor: candidates on the wall lie on it to within a pixel's slope, those behind
  // the board as far behind it as the closed form says.
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-10, 0, 4), vec3(20, 0, 0), vec3(0, 0, -12));
  test::add_rectangle(scene, vec3(-10, 0, -8), vec3(20, 0, 0), vec3(0, 12, 0));
  test::add_rectangle(scene, vec3(-1, 1.0f, -3), vec3(2, 0, 0), vec3(0, 1.0f, 0));
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 2, 3.5f), vec3(0, 1.5f, -8)}, {.width = 320, .height = 200},
                  scene.bounds);
  const NormalView v(tracer, view);
  const double thickness = 0.5;
  const MarchResults results = v.march({thickness, 1e-6});
  size_t on_wall = 0, behind_board = 0;
  for (size_t i = 0; i < results.size(); ++i) {
    const HizCandidate candidate = linear_search(v.main, i);
    if (candidate.verdict != Verdict::hit) continue;
    const uint32_t seen = v.main.gbuffer.primitive[candidate.pixel] / 2;
    const dvec3 p = dvec3(v.main.rays.origin(i)) +
                    distance_of(v.main.rays, i, view, candidate.l) * dvec3(v.main.rays.direction(i));
    const dvec2 at = view.project(p);
    const bool inside = at.x > 20 && at.x < 300 && at.y > 20 && at.y < 180;
    if (!inside || v.main.gbuffer.primitive[v.main.rays.pixel[i]] / 2 != 0) continue;
    const int own = static_cast<int>(v.main.rays.pixel[i]), at_pixel = static_cast<int>(candidate.pixel);
    const bool away = std::abs(own % 320 - at_pixel % 320) + std::abs(own / 320 - at_pixel / 320) > 2;
    if (seen == 1 && away && std::abs(p.z + 8.0) < 0.1) {
      EXPECT_EQ(results.verdict[i], Verdict::hit) << i;
      ++on_wall;
    }
    // Seen along a line of sight: the depth behind the board is the gap along z over the sight's cosine, >=
    // it.
    if (seen == 2 && -3.0 - p.z > 1.1 * thickness) {
      EXPECT_EQ(results.verdict[i], Verdict::rejected) << i;
      ++behind_board;
    }
  }
  EXPECT_GT(on_wall, 2000u);
  EXPECT_GT(behind_board, 100u);
}

TEST(MarchHiz, ConfidenceFallsWithTheDistanceBehindTheSurfaceAndTowardTheScreensEdge) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-20, -20, -4), vec3(40, 0, 0), vec3(0, 40, 0));
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 0, 4), vec3(0, 0, -4)}, {.width = 200, .height = 100}, scene.bounds);
  const NormalView v(tracer, view);
  // A ray straight at the wall from a place before it, at pixel (x, 50), stopped `behind` metres behind it.
  const auto confidence = [&](int x, double behind) {
    RayStream rays;
    rays.resize(1);
    const dvec3 p = view.eye() + 8.0 * view.ray_direction(x + 0.5, 50.5);
    const vec3 origin(p + dvec3(-1.0, 0.0, 2.0));
    rays.set(0, origin, glm::normalize(vec3(p) - origin), 0);
    const ScreenRays screen = project_rays(rays, view, scene.bounds);
    const double t = glm::length(p - dvec3(origin)) + behind;
    const dvec3 end = dvec3(origin) + t * dvec3(rays.direction(0));
    const dvec2 at = view.project(end);
    const auto pixel = static_cast<uint32_t>(static_cast<int>(at.y) * 200 + static_cast<int>(at.x));
    return hiz_confidence(v.main.gbuffer, rays, 0, screen.get<float>(0),
                          {Verdict::hit, pixel, parameter_of(rays, 0, view, t)}, 1.0);
  };
  EXPECT_NEAR(confidence(100, 0.0), 1.0, 1e-4);
  double before = 1.0;
  for (const double behind : {0.3, 0.6, 0.9}) {
    EXPECT_LT(confidence(100, behind), before);
    before = confidence(100, behind);
  }
  EXPECT_EQ(confidence(100, 1.5), 0.0);
  // The border is 5 % of the height, 5 pixels, wide; smoothstep is 1/2 in its middle.
  EXPECT_NEAR(confidence(2, 0.0), 0.5, 1e-3);
  EXPECT_NEAR(confidence(7, 0.0), 1.0, 1e-4);
}

TEST(MarchHiz, ABudgetEndsInBudget) {
  const Scene scene = test::triangle_soup(80, 1.2f, 2.0f, kSeed);
  const Tracer tracer(scene, {.robust = true});
  const NormalView v(tracer,
                     View(Camera{"c", vec3(0, 0, 5), vec3(0)}, {.width = 160, .height = 100}, scene.bounds));
  const MarchResults results = v.march({0.1, 0.1, 4});
  EXPECT_GT(std::count(results.verdict.begin(), results.verdict.end(), Verdict::budget), 500);
  EXPECT_LE(results.steps, 4 * v.main.rays.size());
}

}  // namespace
}  // namespace hybray::ssrm
