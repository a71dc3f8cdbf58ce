// Round curves against closed forms where they are straight, and against brute force where they bend.
#include "core/scene/round_curve.h"

#include "core/base/hash.h"
#include "core/scene/closed_bodies.h"
#include "core/scene/gltf.h"
#include "core/scene/surface_point.h"
#include "tests/core/curve_truth.h"
#include "tests/core/test_scenes.h"

#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 4711;

double unit(uint64_t i, uint32_t d, uint32_t sample = 0) {
  return 2.0 * random_unit(i, d, sample, kSeed) - 1.0;
}
RoundCurve curve_number(uint64_t i, double thickness = 0.06) {
  return test::random_curve([&](uint32_t d) { return unit(i, d, 1); }, thickness);
}
dvec3 vector(uint64_t i, uint32_t first, uint32_t sample = 0) {
  return {unit(i, first, sample), unit(i, first + 1, sample), unit(i, first + 2, sample)};
}

// A straight one from a to b: a cylinder or a cone without ends.
RoundCurve straight(const vec3& a, const vec3& b, float ra, float rb) {
  RoundCurve curve;
  for (size_t i = 0; i < 4; ++i) {
    const float s = static_cast<float>(i) / 3.0f;
    curve.control[i] = vec4(a + s * (b - a), ra + s * (rb - ra));
  }
  return curve;
}

TEST(RoundCurve, AStraightOneIsTheConeOfTheClosedForm) {
  int hits = 0, misses = 0, grazes = 0;
  for (const double end_radius : {0.375, 0.1875, 0.0}) {  // thirds of the way are floats
    const RoundCurve curve = straight(vec3(0, -1, 0), vec3(0, 2, 0), 0.375f, static_cast<float>(end_radius));
    const double slope = (end_radius - 0.375) / 3.0;  // radius = 0.375 + slope (y + 1)
    for (uint64_t i = 0; i < 20000; ++i) {
      const dvec3 o = dvec3(3.0, 3.0, 3.0) * vector(i, 0);
      const dvec3 aim(0.45 * unit(i, 3), 0.5 + 1.8 * unit(i, 4), 0.45 * unit(i, 5));
      const dvec3 d = aim - o;  // not of unit length
      // x^2 + z^2 = (r0 + slope (y + 1))^2 along the line.
      const double r = 0.375 + slope * (o.y + 1.0), s = slope * d.y;
      const double a = d.x * d.x + d.z * d.z - s * s, b = o.x * d.x + o.z * d.z - r * s;
      const double c = o.x * o.x + o.z * o.z - r * r, root2 = b * b - a * c;
      double expected = 1e30;
      if (root2 >= 0.0)
        for (const double t : {(-b - std::sqrt(root2)) / a, (-b + std::sqrt(root2)) / a}) {
          const double y = o.y + t * d.y;
          if (t >= 0.0 && y >= -1.0 && y <= 2.0) expected = std::min(expected, t);
        }
      const auto got = nearest_hit(curve, o, d, 0.0, 1e9);
      if (std::abs(root2) < 1e-6 * b * b) {
        ++grazes;
        continue;
      }
      ASSERT_EQ(got.has_value(), expected < 1e30) << i << " seed " << kSeed;
      ++(got ? hits : misses);
      if (got) {
        ASSERT_NEAR(*got, expected, 1e-9) << i << " seed " << kSeed;
      }
    }
  }
  EXPECT_GT(hits, 20000);
  EXPECT_GT(misses, 5000);
  EXPECT_LT(grazes, 100);
}

// The tracer's rays, and rays that start inside, run along the curve or graze its outline.
TEST(RoundCurve, ALineMeetsItWhereStepsByTheDistanceFieldDo) {
  int hits = 0, inside = 0, differ = 0;
  for (uint64_t i = 0; i < 6000; ++i) {
    const RoundCurve curve = curve_number(i % 60);
    const test::CurveTruth truth(curve);
    const double u = random_unit(i, 0, 2, kSeed);
    const dvec4 p = truth.at(u);
    dvec3 target = dvec3(p) + 1.2 * p.w * glm::normalize(vector(i, 1, 2));
    dvec3 o = 1.5 * vector(i, 4, 2);
    if (i % 4 == 1) o = dvec3(truth.at(random_unit(i, 7, 2, kSeed)));            // inside
    if (i % 4 == 2) o = dvec3(p) - 0.8 * glm::normalize(dvec3(truth.slope(u)));  // along it
    if (i % 4 == 3)
      target = dvec3(p) +
               p.w * (1.0 + 1e-4 * unit(i, 8, 2)) * glm::normalize(glm::cross(vector(i, 1, 2), dvec3(p) - o));
    const dvec3 d = glm::normalize(target - o);
    const auto expected = truth.first_hit(o, d, 4.0, 1.6);
    const auto got = nearest_hit(curve, o, d, 0.0, 4.0);
    if (got.has_value() != expected.has_value() || (got && std::abs(*got - *expected) > 1e-8)) {
      ++differ;  // counted below
      continue;
    }
    hits += got.has_value(), inside += got && i % 4 == 1;
  }
  // 1500 lines pass within 1e-4 r of the outline; what the truth's steps of 1e-6 or the sampled parabola may
  // pass over is within about 1e-7 r of it.
  EXPECT_LE(differ, 4) << "seed " << kSeed;
  EXPECT_GT(hits, 3000);
  EXPECT_GT(inside, 1000);
}

TEST(RoundCurve, ItsNormalIsTheSlopeOfTheDistance) {
  for (uint64_t i = 0; i < 300; ++i) {
    const RoundCurve curve = curve_number(i, 0.09);
    const test::CurveTruth truth(curve);
    const double u = 0.02 + 0.96 * random_unit(i, 0, 3, kSeed);
    const dvec4 p = truth.at(u);
    const dvec3 across = glm::normalize(glm::cross(dvec3(truth.slope(u)), vector(i, 1, 3)));
    const dvec3 on = moved_onto(curve, dvec3(p) + 1.3 * p.w * across);
    EXPECT_NEAR(truth.field(on), 0.0, 1e-12) << i;
    EXPECT_LT(glm::length(moved_onto(curve, on) - on), 1e-12) << i;
    const dvec3 n = outward_normal(curve, on);
    constexpr double kH = 1e-5;
    dvec3 gradient(0.0);
    for (int k = 0; k < 3; ++k) {
      dvec3 e(0.0);
      e[k] = kH;
      gradient[k] = (truth.field(on + e) - truth.field(on - e)) / (2.0 * kH);
    }
    // Central differences: h^2 / r^2 of truncation, 1e-15 / h of rounding.
    EXPECT_LT(glm::length(n - glm::normalize(gradient)), 1e-6) << i << " seed " << kSeed;
  }
}

TEST(RoundCurve, ItsBoxesHoldAllOfItAndThoseOfThePiecesTheirPart) {
  for (uint64_t i = 0; i < 100; ++i) {
    const RoundCurve curve = curve_number(i, 0.2);
    const test::CurveTruth truth(curve);
    const Bounds3 box = bounds(curve);
    const auto pieces = piece_bounds(curve);
    for (int k = 0; k < 400; ++k) {
      const double u = (k + 0.5) / 400;
      const dvec4 p = truth.at(u);
      const dvec3 t = glm::normalize(dvec3(truth.slope(u)));
      const dvec3 x = dvec3(p) + p.w * glm::normalize(glm::cross(t, vector(i * 400 + k, 0, 4)));
      for (const Bounds3& b : {box, pieces[static_cast<size_t>(u * kCurvePieces)]})
        for (int c = 0; c < 3; ++c) {
          ASSERT_GE(x[c], b.lower[c]);
          ASSERT_LE(x[c], b.upper[c]);
        }
    }
    EXPECT_LT(glm::length(dvec3(box.upper) - dvec3(box.lower)), 4.0);
    EXPECT_LE(extent(curve), 4.0);
  }
}

TEST(RoundCurve, ALineThatPassesHasAPointOfTheSurfaceBesideIt) {
  const RoundCurve curve = straight(vec3(0, -1, 0), vec3(0, 2, 0), 0.3f, 0.3f);
  const dvec3 p = beside(curve, {0.3001, 0.5, 7.0}, {0.0, 0.0, -2.0});
  EXPECT_NEAR(p.x, 0.3f, 1e-9);
  EXPECT_NEAR(p.y, 0.5, 1e-9);
  EXPECT_NEAR(p.z, 0.0, 1e-9);
}

TEST(RoundCurve, WhatCannotBeSweptIsAnErrorThatNamesTheCurve) {
  const RoundCurve good = straight(vec3(0), vec3(0, 1, 0), 0.1f, 0.0f);
  EXPECT_NO_THROW(check_curve(good, 0));
  const auto fault = [](RoundCurve curve) -> std::string {
    try {
      check_curve(curve, 17);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  RoundCurve bad = good;
  bad.control[1].y = std::nanf("");
  EXPECT_NE(fault(bad).find("curve 17: a control point or radius is not finite"), std::string::npos);
  bad = good;
  bad.control[2].w = -0.01f;
  EXPECT_NE(fault(bad).find("negative"), std::string::npos);
  EXPECT_NE(fault(straight(vec3(0), vec3(0, 1, 0), 0.0f, 0.0f)).find("zero"), std::string::npos);
  EXPECT_NE(fault(straight(vec3(1), vec3(1), 0.1f, 0.1f)).find("stands still"), std::string::npos);
  bad = good;  // a hairpin
  bad.control = {vec4(0, 0, 0, 0.2f), vec4(0, 1, 0, 0.2f), vec4(0.1f, 1, 0, 0.2f), vec4(0.1f, 0, 0, 0.2f)};
  EXPECT_NE(fault(bad).find("bends"), std::string::npos);
}

TEST(RoundCurve, ASceneCountsItAfterItsAnalyticSurfacesAndHashesIt) {
  Scene scene = test::empty_scene();
  scene.materials.resize(3);
  test::add_rectangle(scene, vec3(0), vec3(1, 0, 0), vec3(0, 0, -1));
  append_analytic(scene, analytic_sphere("ball", 1, {0, 5, 0}, 1.0));
  update_content_hash(scene);
  const uint64_t without = scene.content_hash;
  RoundCurve curve = straight(vec3(0), vec3(0, 9, 0), 0.1f, 0.0f);
  curve.material = 2;
  append_curve(scene, curve);
  update_content_hash(scene);
  const uint64_t with = scene.content_hash;
  EXPECT_NE(with, without);
  scene.curves[0].control[3].w = 0.01f;
  update_content_hash(scene);
  EXPECT_NE(scene.content_hash, with);
  EXPECT_EQ(scene.primitive_count(), 4u);
  EXPECT_TRUE(scene.is_triangle(1) && scene.is_analytic(2) && scene.is_curve(3));
  EXPECT_FALSE(scene.is_analytic(1) || scene.is_analytic(3) || scene.is_triangle(2) || scene.is_curve(2));
  EXPECT_EQ(scene.material_of(2), 1u);
  EXPECT_EQ(scene.material_of(3), 2u);
  EXPECT_GE(scene.bounds.upper.y, 9.0f);
  const SurfacePoint p = surface_point(scene, 3, 0.0f, 0.0f, {0.11, 3.0, 0.0});
  EXPECT_EQ(p.material, 2u);
  EXPECT_GT(p.geometric_normal.x, 0.99);
  EXPECT_GT(p.geometric_normal.y, 0.0) << "it tapers upward";
}

TEST(RoundCurve, GltfCannotHoldItAndItsEndsAreOpen) {
  Scene scene = test::empty_scene();
  scene.materials[0].name = "hair";
  append_curve(scene, straight(vec3(0), vec3(0, 1, 0), 0.1f, 0.0f));
  try {
    save_gltf(scene, "curves.glb");
    FAIL() << "a curve was saved as glTF";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("1 curves"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(find_body_faults(scene).empty());
  scene.materials[0].transmission = 1.0f, scene.materials[0].roughness = 0.0f;
  const auto faults = find_body_faults(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].material, "hair");
  EXPECT_EQ(faults[0].open_edges, 2u);
  EXPECT_THROW(check_closed_bodies(scene), InputError);
  scene.materials[0].thin_walled = true;
  EXPECT_TRUE(find_body_faults(scene).empty());
}

}  // namespace
}  // namespace hybray
