#include "core/tracer/tracer.h"

#include "tests/core/test_scenes.h"

#include <memory>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 20240;

RayStream random_rays(size_t n, float extent) {
  RayStream rays;
  rays.resize(n);
  for (size_t i = 0; i < n; ++i) {
    const auto unit = [&](uint32_t d) { return static_cast<float>(2.0 * random_unit(i, d, 1, kSeed) - 1.0); };
    rays.set(i, extent * vec3(unit(0), unit(1), unit(2)), glm::normalize(vec3(unit(3), unit(4), unit(5))),
             static_cast<uint32_t>(i));
  }
  return rays;
}

// Nearest hit of all triangles, in double.
std::pair<double, uint32_t> brute_force(const Scene& scene, const dvec3& o, const dvec3& d) {
  std::pair<double, uint32_t> best{std::numeric_limits<double>::infinity(), kNoPrimitive};
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    if (const auto hit = test::exact_hit(scene, t, o, d); hit && *hit < best.first) best = {*hit, t};
  return best;
}

class TracerModes : public testing::TestWithParam<TraceMode> {};

TEST_P(TracerModes, FindTheNearestTriangleThatBruteForceInDoubleFinds) {
  const Scene scene = test::triangle_soup(300, 0.4f, 1.0f, kSeed);
  const RayStream rays = random_rays(2003, 1.2f);  // no multiple of any packet
  for (bool robust : {false, true}) {
    const Tracer tracer(scene, {.robust = robust});
    HitStream hits;
    hits.resize(rays.size());
    tracer.trace(rays, hits, GetParam());
    int different = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      const auto [t, triangle] = brute_force(scene, dvec3(rays.origin(i)), dvec3(rays.direction(i)));
      if (hits.primitive[i] != triangle)
        ++different;
      else if (triangle != kNoPrimitive)
        EXPECT_NEAR(hits.t[i], t, 1e-4)
            << "seed " << kSeed << " ray " << i;  // grazing triangles lose a few hundred ulps
      else
        EXPECT_TRUE(std::isinf(hits.t[i]));
    }
    // Float and double may disagree on rays within rounding of an edge: about 2003 rays x edge length x 1e-7.
    EXPECT_LE(different, 1);
  }
}

TEST_P(TracerModes, WriteOnlyThePlacesOfTheRaysAskedFor) {
  const Scene scene = test::triangle_soup(300, 0.4f, 1.0f, kSeed);
  const RayStream rays = random_rays(500, 1.2f);
  const Tracer tracer(scene, {});
  std::vector<uint32_t> which;
  for (uint32_t i = 3; i < 500; i += 7) which.push_back(i);
  HitStream all, some;
  all.resize(500), some.resize(500);
  std::fill(some.t.begin(), some.t.end(), -5.0f);
  tracer.trace(rays, all, TraceMode::single);
  tracer.trace_some(rays, which, some, GetParam());
  for (uint32_t i = 0; i < 500; ++i) {
    if (i % 7 == 3)
      EXPECT_EQ(some.primitive[i], all.primitive[i]);
    else
      EXPECT_EQ(some.t[i], -5.0f);
  }
  tracer.trace_some(rays, {}, some, GetParam());  // an empty list is no ray, not every ray
  EXPECT_EQ(some.t[0], -5.0f);
}

TEST_P(TracerModes, GiveABatchTheHitsThatItsRaysHaveOneByOne) {
  const Scene scene = test::triangle_soup(300, 0.4f, 1.0f, kSeed);
  const Tracer tracer(scene, {.robust = true});
  for (const size_t n : {0u, 1u, 3u, 4u, 15u, 16u, 17u, 1000u, 1003u}) {
    const RayStream stream = random_rays(n, 1.2f);
    const auto rays = std::make_unique<RayBatch<1003>>();
    for (size_t i = 0; i < n; ++i) rays->set(i, stream.origin(i), stream.direction(i));
    const auto batch = std::make_unique<HitBatch<1004>>();
    const HitBatch<1004>& hits = *batch;
    batch->t[n] = -5.0f;
    tracer.intersect_batch(rays->lanes(), n, batch->lanes(), GetParam());
    EXPECT_EQ(hits.t[n], -5.0f) << "written past the end";
    int different = 0;
    for (size_t i = 0; i < n; ++i) {
      const Hit alone = tracer.intersect(stream.origin(i), stream.direction(i));
      if (hits[i].primitive != alone.primitive) {
        ++different;
        continue;
      }
      if (!alone.valid()) continue;
      // Packets may round in another order; a grazing triangle loses a few hundred ulps.
      EXPECT_NEAR(hits[i].t, alone.t, 1e-4) << i;
      EXPECT_NEAR(hits[i].u, alone.u, 1e-3) << i;
      EXPECT_NEAR(hits[i].v, alone.v, 1e-3) << i;
    }
    EXPECT_LE(different, 1) << n;
  }
}

TEST_P(TracerModes, StartEachRayOfAListAtItsOwnDistance) {
  const Scene scene = test::triangle_soup(300, 0.4f, 1.0f, kSeed);
  const Tracer tracer(scene, {.robust = true});
  for (const size_t n : {1u, 3u, 4u, 17u, 2003u}) {
    const RayStream rays = random_rays(n, 1.2f);
    std::vector<uint32_t> which;
    std::vector<float> near(n);
    for (uint32_t i = 0; i < n; ++i) {
      near[i] = static_cast<float>(1.5 * random_unit(i, 9, 0, kSeed));
      if (i % 3 != 1) which.push_back(i);
    }
    HitStream hits;
    hits.resize(n);
    tracer.trace_some(rays, which, hits, GetParam(), near);
    size_t different = 0, later = 0;
    for (const uint32_t i : which) {
      const Hit alone = tracer.intersect(rays.origin(i), rays.direction(i), near[i]);
      different += hits.primitive[i] != alone.primitive;
      later += alone.primitive != tracer.intersect(rays.origin(i), rays.direction(i)).primitive;
    }
    EXPECT_LE(different, 1u) << n << ", seed " << kSeed;
    if (n > 1000) {
      EXPECT_GT(later, n / 20) << "of the rays, so many skip a hit";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, TracerModes, testing::ValuesIn(kAllTraceModes),
                         [](const auto& test) { return std::string(label(test.param)); });

TEST(Tracer, RespectsTheInterval) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-1, -1, -2), vec3(2, 0, 0), vec3(0, 2, 0));
  test::add_rectangle(scene, vec3(-1, -1, -5), vec3(2, 0, 0), vec3(0, 2, 0));
  const Tracer tracer(scene, {.robust = true});
  const vec3 o(0.1f, 0.2f, 0.0f), d(0, 0, -1);
  EXPECT_FLOAT_EQ(tracer.intersect(o, d).t, 2.0f);
  EXPECT_FLOAT_EQ(tracer.intersect(o, d, 2.5f).t, 5.0f);
  EXPECT_FALSE(tracer.intersect(o, d, 2.5f, 4.5f).valid());
  EXPECT_TRUE(tracer.occluded(o, d, 0.0f, 2.5f));
  EXPECT_FALSE(tracer.occluded(o, d, 2.5f, 4.5f));
}

TEST(Tracer, AWatertightMeshIsHitByEveryRobustRayFromInside) {
  Scene scene = test::empty_scene();
  for (int axis = 0; axis < 3; ++axis)
    for (float side : {-1.0f, 1.0f}) {
      vec3 n(0.0f), u(0.0f), v(0.0f);
      n[axis] = side, u[(axis + 1) % 3] = 2.0f, v[(axis + 2) % 3] = 2.0f;
      test::add_rectangle(scene, n - 0.5f * u - 0.5f * v, u, v, 7);
    }
  const Tracer tracer(scene, {.robust = true});
  const RayStream rays = random_rays(50000, 0.5f);
  std::vector<vec3>
      shared;  // vertices inside a side: those on the cube's edges belong to two sides that share no vertex
  for (const vec3& p : scene.positions)
    if ((std::abs(p.x) > 0.99f) + (std::abs(p.y) > 0.99f) + (std::abs(p.z) > 0.99f) == 1) shared.push_back(p);
  ASSERT_EQ(shared.size(), 6u * 36u * 6u)
      << "six sides of 6 x 6 inner points, each once for every triangle around it";
  for (size_t i = 0; i < rays.size(); ++i) {
    // Every second ray is aimed exactly at a shared vertex.
    const vec3 d = i % 2 ? glm::normalize(shared[i % shared.size()] - rays.origin(i)) : rays.direction(i);
    EXPECT_TRUE(tracer.intersect(rays.origin(i), d).valid()) << i;
  }
}

TEST(Tracer, ReportsItsVersionAndMemory) {
  EXPECT_TRUE(embree_version()[0] == '3' || embree_version()[0] == '4') << embree_version();
  const Scene scene = test::triangle_soup(5000, 0.1f, 1.0f, kSeed);
  EXPECT_GT(Tracer(scene, {}).memory_bytes(), 5000u * 12u);
}

}  // namespace
}  // namespace hybray
