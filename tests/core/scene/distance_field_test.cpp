// Distance fields: their bound, the torus against its quartic, the others against subdivision by the bound.
#include "core/scene/distance_field.h"

#include "core/base/hash.h"
#include "core/scene/closed_bodies.h"
#include "core/scene/curved_primitive.h"
#include "tests/core/field_truth.h"
#include "tests/core/test_scenes.h"

#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using Shape = DistanceField::Shape;
constexpr uint64_t kSeed = 1970;

double unit(uint64_t i, uint32_t d, uint32_t sample = 0) {
  return 2.0 * random_unit(i, d, sample, kSeed) - 1.0;
}
dvec3 vector(uint64_t i, uint32_t first, uint32_t sample = 0) {
  return {unit(i, first, sample), unit(i, first + 1, sample), unit(i, first + 2, sample)};
}

const DistanceField kTorus{
    .shape = Shape::torus, .radius = 0.8, .thickness = 0.25, .axis = glm::normalize(dvec3(1, 2, 3))};
const DistanceField kGyroid{.shape = Shape::gyroid, .radius = 1.0, .thickness = 0.3, .period = 0.7};
const DistanceField kBlob{.shape = Shape::blob, .radius = 1.1, .thickness = 0.3};
const std::vector<DistanceField> kAll{kTorus, kGyroid, kBlob};

TEST(DistanceField, NeverChangesByMoreThanTheWay) {
  for (const DistanceField& field : kAll)
    for (uint64_t i = 0; i < 50000; ++i) {
      const dvec3 p = 1.5 * vector(i, 0),
                  q = p + std::pow(10.0, -4.0 * random_unit(i, 3, 0, kSeed)) * vector(i, 4);
      ASSERT_LE(std::abs(value(field, p) - value(field, q)), glm::length(p - q) * (1.0 + 1e-9) + 1e-15)
          << label(field.shape) << " " << i << " seed " << kSeed;
    }
}

TEST(DistanceField, IsPositiveBeyondItsReachAndNegativeSomewhereWithin) {
  for (const DistanceField& field : kAll) {
    int inside = 0;
    for (uint64_t i = 0; i < 20000; ++i) {
      const dvec3 out = glm::normalize(vector(i, 0, 1));
      EXPECT_GE(value(field, reach(field) * (1.0 + random_unit(i, 3, 1, kSeed)) * out), 0.0);
      inside += value(field, reach(field) * vector(i, 4, 1)) < 0.0;
    }
    EXPECT_GT(inside, 500) << label(field.shape);
  }
}

TEST(DistanceField, TheGyroidAndTheTorusAreWhatTheirEquationsSay) {
  for (uint64_t i = 0; i < 2000; ++i) {
    const dvec3 p = vector(i, 0, 2);
    const double x = 2.0 * std::numbers::pi / 0.7 * p.x, y = 2.0 * std::numbers::pi / 0.7 * p.y,
                 z = 2.0 * std::numbers::pi / 0.7 * p.z;
    const double g = std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
    EXPECT_EQ(value(kGyroid, p) < 0.0, std::abs(g) < 0.3 && glm::length(p) < 1.0) << i;
    // The nearest point of the torus' circle by search over its angle.
    const dvec3 a = glm::normalize(glm::cross(kTorus.axis, dvec3(1, 0, 0))), b = glm::cross(kTorus.axis, a);
    double nearest = 1e30;
    for (int k = 0; k < 4000; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 4000;
      nearest = std::min(nearest, glm::length(p - 0.8 * (std::cos(angle) * a + std::sin(angle) * b)));
    }
    EXPECT_NEAR(value(kTorus, p), nearest - 0.25, 1e-3) << i;
  }
}

// The real roots of c[0] + c[1] t + ... in [low, high]: between the roots of the derivative there is at most
// one, found by bisection.
std::vector<double> real_roots(const std::vector<double>& c, double low, double high) {
  if (c.size() < 2) return {};
  std::vector<double> derivative;
  for (size_t i = 1; i < c.size(); ++i) derivative.push_back(static_cast<double>(i) * c[i]);
  std::vector<double> stops{low};
  for (const double t : real_roots(derivative, low, high)) stops.push_back(t);
  stops.push_back(high);
  const auto at = [&](double t) {
    double sum = 0.0;
    for (size_t i = c.size(); i-- > 0;) sum = sum * t + c[i];
    return sum;
  };
  std::vector<double> roots;
  for (size_t k = 0; k + 1 < stops.size(); ++k) {
    double a = stops[k], b = stops[k + 1];
    const bool negative = at(a) < 0.0;
    if ((at(b) < 0.0) == negative) continue;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (a + b);
      ((at(middle) < 0.0) == negative ? a : b) = middle;
    }
    roots.push_back(0.5 * (a + b));
  }
  return roots;
}

TEST(DistanceField, ALineMeetsTheTorusAtTheFirstRootOfItsQuartic) {
  int hits = 0, grazes = 0;
  const double r2 = 0.8 * 0.8, k = r2 - 0.25 * 0.25;
  for (uint64_t i = 0; i < 20000; ++i) {
    const dvec3 o = 1.6 * vector(i, 0, 3), d = glm::normalize(0.9 * vector(i, 3, 3) - o);
    // (|p|^2 + R^2 - r^2)^2 = 4 R^2 (|p|^2 - (p . axis)^2) with p = o + t d.
    const double oo = glm::dot(o, o), od = glm::dot(o, d), ao = glm::dot(kTorus.axis, o),
                 ad = glm::dot(kTorus.axis, d), e = oo + k;
    const auto quartic = [&](double shift) {
      return std::vector<double>{e * e - 4.0 * r2 * (oo - ao * ao) + shift,
                                 4.0 * e * od - 8.0 * r2 * (od - ao * ad),
                                 4.0 * od * od + 2.0 * e - 4.0 * r2 * (1.0 - ad * ad), 4.0 * od, 1.0};
    };
    const auto roots = real_roots(quartic(0.0), 0.0, 10.0);
    if (roots.size() != real_roots(quartic(1e-9), 0.0, 10.0).size() ||
        roots.size() != real_roots(quartic(-1e-9), 0.0, 10.0).size()) {
      ++grazes;
      continue;
    }
    const double scale = 0.25 + 0.5 * random_unit(i, 6, 3, kSeed);
    const auto got = nearest_hit(kTorus, o, scale * d, 0.0, 1e9);
    ASSERT_EQ(got.has_value(), !roots.empty()) << i << " seed " << kSeed;
    if (!got) continue;
    ++hits;
    ASSERT_NEAR(*got * scale, roots[0], 1e-7) << i;  // the quartic's own rounding near double roots
  }
  EXPECT_GT(hits, 10000);
  EXPECT_LT(grazes, 20);
}

TEST(DistanceField, ALineMeetsItWhereSubdivisionByTheBoundFindsIt) {
  for (const DistanceField& field : kAll) {
    int hits = 0, inside = 0;
    for (uint64_t i = 0; i < 3000; ++i) {
      const dvec3 o = 1.8 * vector(i, 0, 4), d = glm::normalize(0.9 * vector(i, 3, 4) - o);
      const bool negative = value(field, o) < 0.0;
      const auto expected = test::first_sign_change([&](double t) { return value(field, o + t * d); }, 0.0,
                                                    6.0, 1.0, 1e-9, negative);
      const auto got = nearest_hit(field, o, d, 0.0, 6.0);
      ASSERT_EQ(got.has_value(), expected.has_value()) << label(field.shape) << " " << i << " seed " << kSeed;
      if (!got) continue;
      ++hits, inside += negative;
      ASSERT_NEAR(*got, *expected, 2e-9) << label(field.shape) << " " << i << " seed " << kSeed;
      // The interval picks what comes next, on the way out or in.
      const double from = *got + 1e-6;
      const auto next = nearest_hit(field, o, d, from, 6.0);
      const auto further = test::first_sign_change([&](double t) { return value(field, o + t * d); }, from,
                                                   6.0, 1.0, 1e-9, value(field, o + from * d) < 0.0);
      ASSERT_EQ(next.has_value(), further.has_value()) << label(field.shape) << " " << i;
      if (next) {
        ASSERT_NEAR(*next, *further, 2e-9);
      }
      EXPECT_FALSE(nearest_hit(field, o, d, 0.0, *got - 1e-6)) << label(field.shape) << " " << i;
    }
    EXPECT_GT(hits, 1000) << label(field.shape);
    EXPECT_GT(inside, 30) << label(field.shape);
  }
}

// Lines that run a hair's breadth below the surface along it, where a chord is short.
TEST(DistanceField, NoThinChordIsPassedOver) {
  for (const DistanceField& field : kAll) {
    int tested = 0;
    for (uint64_t i = 0; i < 1500; ++i) {
      const dvec3 start = reach(field) * vector(i, 0, 5), toward = glm::normalize(vector(i, 3, 5));
      const auto t = nearest_hit(field, start, toward, 0.0, 9.0);
      if (!t) continue;
      const dvec3 on = start + *t * toward, n = gradient(field, on);
      const dvec3 along = glm::normalize(glm::cross(n, vector(i, 6, 5)));
      for (const double depth : {1e-4, 1e-6, 1e-8}) {
        const dvec3 below = on - depth * n;
        if (!(value(field, below) < 0.0)) continue;  // at the ball's rim of a gyroid
        const dvec3 o = below - 4.0 * along;
        const auto hit = nearest_hit(field, o, along, 0.0, 9.0);
        ASSERT_TRUE(hit.has_value()) << label(field.shape) << " " << i << " depth " << depth;
        EXPECT_LT(*hit, 4.0);
        ++tested;
      }
    }
    EXPECT_GT(tested, 500) << label(field.shape);
  }
}

TEST(DistanceField, ItsNormalIsTheSlopeAndPointsMoveOntoIt) {
  for (const DistanceField& field : kAll) {
    int tested = 0, edges = 0;
    for (uint64_t i = 0; i < 2000; ++i) {
      const dvec3 o = 1.8 * vector(i, 0, 6), d = glm::normalize(0.9 * vector(i, 3, 6) - o);
      const auto t = nearest_hit(field, o, d, 0.0, 9.0);
      if (!t) continue;
      const dvec3 p = o + *t * d;
      constexpr double kH = 1e-5;
      dvec3 slope(0.0);
      for (int k = 0; k < 3; ++k) {
        dvec3 e(0.0);
        e[k] = kH;
        slope[k] = (value(field, p + e) - value(field, p - e)) / (2.0 * kH);
      }
      ++tested;
      if (glm::length(gradient(field, p) - glm::normalize(slope)) > 1e-6) ++edges;
      const dvec3 on = moved_onto(field, p + 1e-3 * vector(i, 6, 6));
      EXPECT_NEAR(value(field, on), 0.0, 1e-13) << label(field.shape) << " " << i;
      EXPECT_LT(glm::length(on - p), 5e-3);
    }
    EXPECT_GT(tested, 500);
    // Where a gyroid's sheet meets its ball, or a blob's mix begins, slopes jump or bend: within 1e-5 of it.
    EXPECT_LE(edges, tested / 200) << label(field.shape);
  }
}

TEST(DistanceField, ALineThatPassesHasAPointOfTheSurfaceBesideIt) {
  for (const DistanceField& field : kAll)
    for (uint64_t i = 0; i < 500; ++i) {
      const dvec3 start = reach(field) * vector(i, 0, 7), toward = glm::normalize(vector(i, 3, 7));
      const auto t = nearest_hit(field, start, toward, 0.0, 9.0);
      if (!t) continue;
      const dvec3 p = beside(field, start, toward);
      EXPECT_NEAR(value(field, p), 0.0, 1e-12) << label(field.shape) << " " << i;
      const double nearest = glm::dot(p - start, toward);
      EXPECT_LT(glm::length(start + nearest * toward - p), 1e-2 * reach(field))
          << label(field.shape) << " " << i;
    }
}

TEST(DistanceField, AsASurfaceOfASceneItIsHashedBoundedAndClosed) {
  Scene scene = test::empty_scene();
  append_analytic(scene, analytic_field("ring", 0, {1, 2, 3}, kTorus));
  update_content_hash(scene);
  const uint64_t before = scene.content_hash;
  scene.analytic[0].field.thickness = 0.24;
  update_content_hash(scene);
  EXPECT_NE(scene.content_hash, before);
  EXPECT_NEAR(scene.bounds.upper.x, 2.05, 1e-6);
  EXPECT_NEAR(extent(scene, 0), 2.1, 1e-12);
  scene.materials[0].transmission = 1.0f, scene.materials[0].roughness = 0.0f;
  EXPECT_TRUE(find_body_faults(scene).empty());
  const auto t = nearest_hit(scene, 0, {1, 2, 30}, {0, 0, -1}, 0.0, 1e9);
  const auto own = nearest_hit(kTorus, {0, 0, 27}, {0, 0, -1}, 0.0, 1e9);
  EXPECT_EQ(t.has_value(), own.has_value());
}

TEST(DistanceField, SizesThatMakeNoBodyAreErrorsThatNameIt) {
  const auto fault = [](DistanceField field) -> std::string {
    try {
      check_surface(analytic_field("thing", 0, dvec3(0), field));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault(kTorus) + fault(kGyroid) + fault(kBlob), "");
  DistanceField bad = kTorus;
  bad.axis = dvec3(0, 2, 0);
  EXPECT_NE(fault(bad).find("'thing'"), std::string::npos);
  EXPECT_NE(fault(bad).find("axis"), std::string::npos);
  bad = kGyroid, bad.thickness = 1.5;
  EXPECT_NE(fault(bad).find("thickness is 1.5"), std::string::npos);
  bad = kGyroid, bad.period = 0.0;
  EXPECT_NE(fault(bad).find("period"), std::string::npos);
  bad = kBlob, bad.radius = -1.0;
  EXPECT_NE(fault(bad).find("radius"), std::string::npos);
  bad = kBlob, bad.thickness = -0.1;
  EXPECT_NE(fault(bad).find("thickness"), std::string::npos);
}

}  // namespace
}  // namespace hybray
