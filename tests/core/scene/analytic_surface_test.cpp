#include "core/scene/analytic_surface.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/scene/gltf.h"
#include "core/scene/overlay.h"
#include "core/scene/surface_point.h"
#include "tests/core/test_scenes.h"
#include "tests/temporary_folder.h"

#include <cmath>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 20242;

const AnalyticSurface kSurfaces[] = {
    analytic_sphere("sphere", 0, {0.3, -0.2, 0.5}, 0.8),
    analytic_cylinder("cylinder", 0, {-0.4, 7.0, 0.2}, 0.6, -0.7, 0.9),
    analytic_paraboloid("bowl", 0, {0.1, -0.5, 0.2}, 0.3, 0.9),
    analytic_paraboloid("dome", 0, {0.1, 0.5, 0.2}, -0.7, 0.9),
};

// Of the whole surface: zero on it, negative on the inner side.
double implicit(const AnalyticSurface& s, const dvec3& p) {
  const dvec3 q = p - s.center;
  switch (s.kind) {
    case AnalyticSurface::Kind::sphere:
      return glm::length(q) - s.radius;
    case AnalyticSurface::Kind::cylinder:
      return std::hypot(q.x, q.z) - s.radius;
    case AnalyticSurface::Kind::paraboloid:
      return (q.x * q.x + q.z * q.z) / (4.0 * std::abs(s.focal_length)) -
             std::copysign(1.0, s.focal_length) * q.y;
    case AnalyticSurface::Kind::field:
      return value(s.field, q);
  }
  return 0.0;
}

bool within_ends(const AnalyticSurface& s, const dvec3& p) {
  if (s.kind == AnalyticSurface::Kind::cylinder) return p.y >= s.y0 && p.y <= s.y1;
  if (s.kind == AnalyticSurface::Kind::paraboloid)
    return std::hypot(p.x - s.center.x, p.z - s.center.z) <= s.radius;
  return true;
}

dvec3 random_vector(uint64_t i, uint32_t first) {
  const auto unit = [&](uint32_t d) { return 2.0 * random_unit(i, first + d, 2, kSeed) - 1.0; };
  return {unit(0), unit(1), unit(2)};
}

// All sign changes of the implicit function along the line, by bisection of small steps.
std::vector<double> crossings(const AnalyticSurface& s, const dvec3& o, const dvec3& d) {
  std::vector<double> found;
  constexpr double kStep = 1.0 / 512.0;
  const auto f = [&](double t) { return implicit(s, o + t * d); };
  for (double a = -6.0; a < 6.0; a += kStep) {
    if ((f(a) < 0.0) == (f(a + kStep) < 0.0)) continue;
    double low = a, high = a + kStep;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((f(middle) < 0.0) == (f(low) < 0.0) ? low : high) = middle;
    }
    if (within_ends(s, o + low * d)) found.push_back(low);
  }
  return found;
}

TEST(AnalyticSurface, ALineMeetsItWhereItsEquationChangesSign) {
  for (const AnalyticSurface& s : kSurfaces) {
    int met = 0, missed_close_pairs = 0;
    for (uint64_t i = 0; i < 1000; ++i) {
      const dvec3 o = 1.5 * random_vector(i, 0);
      const dvec3 d = (0.5 + random_unit(i, 6, 2, kSeed)) * glm::normalize(random_vector(i, 3));
      const LineHits hits = line_hits(s, o, d);
      const std::vector<double> truth = crossings(s, o, d);
      std::vector<double> near;  // those in the range that was searched
      for (int k = 0; k < hits.count; ++k)
        if (std::abs(hits.t[k]) < 5.9) near.push_back(hits.t[k]);
      if (near.size() == 2 && truth.empty() && near[1] - near[0] < 1.0 / 256.0) {
        ++missed_close_pairs;  // both crossings of a grazing line lie within one step of the search
        continue;
      }
      std::vector<double> expected;
      for (const double t : truth)
        if (std::abs(t) < 5.9) expected.push_back(t);
      ASSERT_EQ(near.size(), expected.size()) << s.name << " line " << i << " seed " << kSeed;
      for (size_t k = 0; k < near.size(); ++k) EXPECT_NEAR(near[k], expected[k], 1e-10) << s.name << i;
      met += !near.empty();
    }
    EXPECT_GT(met, 100) << s.name;
    EXPECT_LT(missed_close_pairs, 10) << s.name;
  }
}

TEST(AnalyticSurface, ALineThatTouchesASphereMeetsItWithinTheRootOfRounding) {
  const AnalyticSurface s = analytic_sphere("ball", 0, dvec3(0.0), 1.0);
  for (const double gap : {1e-6, 1e-9, 1e-12}) {
    const LineHits inside = line_hits(s, {-1000.0, 1.0 - gap, 0.0}, {1.0, 0.0, 0.0});
    ASSERT_EQ(inside.count, 2) << gap;
    const double half = std::sqrt(gap * (2.0 - gap));
    // The half chord is a root of the gap; from 1000 m away, t itself rounds to 1e-13.
    EXPECT_NEAR(inside.t[1] - inside.t[0], 2.0 * half, 1e-3 * half + 1e-12) << gap;
    EXPECT_EQ(line_hits(s, {-1000.0, 1.0 + gap, 0.0}, {1.0, 0.0, 0.0}).count, 0) << gap;
  }
}

TEST(AnalyticSurface, AVerticalLineMeetsAParaboloidOnceAndACylinderNever) {
  const LineHits hits = line_hits(kSurfaces[2], {0.4, 3.0, 0.6}, {0.0, -2.0, 0.0});
  ASSERT_EQ(hits.count, 1);
  const double height = (0.3 * 0.3 + 0.4 * 0.4) / (4.0 * 0.3) - 0.5;
  EXPECT_NEAR(hits.t[0], (3.0 - height) / 2.0, 1e-14);
  EXPECT_EQ(line_hits(kSurfaces[1], {-0.4, 3.0, 0.2}, {0.0, -1.0, 0.0}).count, 0);
  EXPECT_EQ(line_hits(kSurfaces[1], {0.2, 3.0, 0.2}, {0.0, -1.0, 0.0}).count, 0);
}

TEST(AnalyticSurface, TheNearestHitRespectsTheInterval) {
  const AnalyticSurface s = analytic_sphere("ball", 0, dvec3(0.0), 1.0);
  const dvec3 o(0, 0, 3), d(0, 0, -1);
  EXPECT_DOUBLE_EQ(nearest_hit(s, o, d, 0.0, 10.0).value(), 2.0);
  EXPECT_DOUBLE_EQ(nearest_hit(s, o, d, 2.5, 10.0).value(), 4.0);
  EXPECT_FALSE(nearest_hit(s, o, d, 2.5, 3.5).has_value());
  EXPECT_FALSE(nearest_hit(s, o, -d, 0.0, 10.0).has_value());
}

TEST(AnalyticSurface, TheNormalIsTheOutwardGradientAndPointsMoveStraightOntoTheSurface) {
  for (const AnalyticSurface& s : kSurfaces)
    for (uint64_t i = 0; i < 200; ++i) {
      const dvec3 o = 1.5 * random_vector(i, 0), d = glm::normalize(random_vector(i, 3));
      const LineHits hits = line_hits(s, o, d);
      for (int k = 0; k < hits.count; ++k) {
        const dvec3 p = o + hits.t[k] * d, n = outward_normal(s, p);
        constexpr double kH = 1e-6;
        const auto slope = [&](const dvec3& e) {
          return (implicit(s, p + kH * e) - implicit(s, p - kH * e)) / (2.0 * kH);
        };
        const dvec3 gradient(slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1}));
        EXPECT_LT(glm::length(n - glm::normalize(gradient)), 1e-8) << s.name << i;
        EXPECT_NEAR(glm::length(n), 1.0, 1e-14);
        const dvec3 moved = moved_onto(s, p + 1e-6 * random_vector(i, 7));
        EXPECT_NEAR(implicit(s, moved), 0.0, 1e-14) << s.name << i;
        EXPECT_LT(glm::length(moved - p), 3e-6) << s.name << i;
      }
    }
}

TEST(AnalyticSurface, ItsBoxHoldsAllOfItAndNoMoreThanRounding) {
  for (const AnalyticSurface& s : kSurfaces) {
    const Bounds3 box = bounds(s);
    dvec3 lower(1e9), upper(-1e9);
    for (uint64_t i = 0; i < 20000; ++i) {
      const dvec3 o = 1.5 * random_vector(i, 0), d = glm::normalize(random_vector(i, 3));
      const LineHits hits = line_hits(s, o, d);
      for (int k = 0; k < hits.count; ++k)
        lower = glm::min(lower, o + hits.t[k] * d), upper = glm::max(upper, o + hits.t[k] * d);
    }
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(box.lower[k], lower[k]) << s.name;
      EXPECT_GE(box.upper[k], upper[k]) << s.name;
      EXPECT_NEAR(box.lower[k], lower[k], 0.02) << s.name;
      EXPECT_NEAR(box.upper[k], upper[k], 0.02) << s.name;
    }
    EXPECT_NEAR(extent(s), std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z}), 0.04)
        << s.name;
  }
}

TEST(AnalyticSurface, SizesThatAreNotPositiveAreErrorsThatNameTheSurface) {
  const double nan = std::nan("");
  for (const AnalyticSurface& bad :
       {analytic_sphere("bad", 0, dvec3(0), 0.0), analytic_sphere("bad", 0, dvec3(0), -1.0),
        analytic_sphere("bad", 0, dvec3(0), nan), analytic_sphere("bad", 0, dvec3(nan), 1.0),
        analytic_cylinder("bad", 0, dvec3(0), 1.0, 1.0, 1.0),
        analytic_paraboloid("bad", 0, dvec3(0), 0.0, 1.0)}) {
    try {
      check_surface(bad);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("'bad'"), std::string::npos) << error.what();
    }
  }
}

TEST(AnalyticSurface, ASceneCountsItAfterItsTrianglesAndHashesIt) {
  Scene scene = test::empty_scene();
  scene.materials.push_back({});
  test::add_rectangle(scene, vec3(0), vec3(1, 0, 0), vec3(0, 0, -1));
  update_content_hash(scene);
  const uint64_t without = scene.content_hash;
  append_analytic(scene, analytic_sphere("ball", 1, {0, 5, 0}, 1.0));
  update_content_hash(scene);
  EXPECT_NE(scene.content_hash, without);
  EXPECT_EQ(scene.primitive_count(), 3u);
  EXPECT_FALSE(scene.is_analytic(1));
  EXPECT_TRUE(scene.is_analytic(2));
  EXPECT_EQ(scene.material_of(1), 0u);
  EXPECT_EQ(scene.material_of(2), 1u);
  EXPECT_GE(scene.bounds.upper.y, 6.0f);
  const uint64_t with = scene.content_hash;
  scene.analytic[0].radius = 1.0000000001;
  update_content_hash(scene);
  EXPECT_NE(scene.content_hash, with);
  EXPECT_THROW(append_analytic(scene, analytic_sphere("flat", 0, dvec3(0), 0.0)), InputError);
}

TEST(AnalyticSurface, ItsSurfacePointLiesOnItAndOutOfReachOfRounding) {
  Scene scene = test::empty_scene();
  append_analytic(scene, analytic_sphere("ball", 0, {100.0, 0.0, 0.0}, 0.5));
  for (uint64_t i = 0; i < 200; ++i) {
    const dvec3 n = glm::normalize(random_vector(i, 0)), exact = dvec3(100.0, 0.0, 0.0) + 0.5 * n;
    const SurfacePoint p = surface_point(scene, 0, 0.0f, 0.0f, dvec3(vec3(exact)));
    EXPECT_NEAR(glm::distance(p.position, dvec3(100.0, 0.0, 0.0)), 0.5, 1e-13);
    EXPECT_EQ(p.geometric_normal, p.shading_normal);
    // The hit was rounded to float, 4e-6 m off at most at this distance.
    EXPECT_LT(glm::length(p.geometric_normal - n), 4e-5);
    // Moved outward and rounded to float, the point is outside; moved inward, inside.
    EXPECT_GT(glm::distance(dvec3(vec3(p.position + p.offset * p.geometric_normal)), dvec3(100, 0, 0)), 0.5);
    EXPECT_LT(glm::distance(dvec3(vec3(p.position - p.offset * p.geometric_normal)), dvec3(100, 0, 0)), 0.5);
  }
}

TEST(AnalyticSurface, AnOverlayRemovesItByItsMaterialAndKeepsItOtherwise) {
  const test::TemporaryFolder folder;
  const auto without = [&](const std::string& material) {
    return load_overlay(folder.write("scene.json", R"({"source": {"generator": "closed_ball_lens"},
                                                      "remove_materials": [")" +
                                                       material + "\"]}"),
                        {});
  };
  EXPECT_EQ(without("glass").analytic.size(), 0u);
  EXPECT_EQ(without("glass").triangle_count(), 2u);
  EXPECT_EQ(without("receiver").analytic.size(), 1u);
  EXPECT_EQ(without("receiver").triangle_count(), 0u);
}

TEST(AnalyticSurface, GltfRefusesItByName) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(0), vec3(1, 0, 0), vec3(0, 0, -1));
  append_analytic(scene, analytic_sphere("crystal", 0, dvec3(0), 1.0));
  const test::TemporaryFolder folder;
  try {
    save_gltf(scene, folder.path() / "scene.glb");
    FAIL() << "saved";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("crystal"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace hybray
