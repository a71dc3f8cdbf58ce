#include "core/metrics/verdict_table.h"

#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

using ssrm::Verdict;

// A floor that mirrors a wall, with truth that each test bends as it likes.
struct Judged {
  Scene scene = test::empty_scene();
  std::unique_ptr<Tracer> tracer;
  std::unique_ptr<test::MainView> v;
  ssrm::MarchResults results;
  truth::RayTruth truth;

  Judged() {
    test::add_rectangle(scene, vec3(-10, 0, 4), vec3(20, 0, 0), vec3(0, 0, -12));
    test::add_rectangle(scene, vec3(-10, 0, -8), vec3(20, 0, 0), vec3(0, 12, 0));
    tracer = std::make_unique<Tracer>(scene, Tracer::Config{.robust = true});
    const View view(Camera{"c", vec3(0, 2, 3.5f), vec3(0, 1.5f, -8)}, {.width = 120, .height = 80},
                    scene.bounds);
    v = std::make_unique<test::MainView>(*tracer, view);
    results = v->march();
    truth = truth::trace_truth(*tracer, v->rays, view);
    // Only rays from the floor to the wall, and none so short that a tolerance could reach past its origin.
    for (size_t i = 0; i < results.size(); ++i)
      if (truth.hits.t[i] < 1.0f || v->gbuffer.primitive[v->rays.pixel[i]] > 1)
        results.verdict[i] = Verdict::offscreen;
  }
  VerdictTable judge(double k = 1.0, std::vector<HitClass>* classes = nullptr) const {
    return metrics::judge(results, v->depth(), v->screen_rays, v->rays, truth, v->gbuffer, scene, {k},
                          classes);
  }
};

TEST(VerdictTable, VerdictsPartitionTheRaysAndClassesPartitionTheHits) {
  const Judged j;
  std::vector<HitClass> classes;
  const VerdictTable t = j.judge(1.0, &classes);
  EXPECT_EQ(t.rays, j.v->rays.size());
  EXPECT_EQ(std::accumulate(t.verdicts.begin(), t.verdicts.end(), uint64_t{0}), t.rays);
  EXPECT_EQ(t.right + t.phantom + t.early + t.through, t.hits());
  EXPECT_EQ(static_cast<uint64_t>(std::count(classes.begin(), classes.end(), HitClass::right)), t.right);
  EXPECT_GT(t.hits(), 1000u);
}

TEST(VerdictTable, HitsOfAPlainWallAreRight) {
  const VerdictTable t = Judged().judge();
  EXPECT_GE(static_cast<double>(t.right), 0.999 * static_cast<double>(t.hits()));
  EXPECT_GE(t.visible_true_hits, t.right);
}

TEST(VerdictTable, SortsHitsByWhereTruthSaysTheSurfaceIs) {
  Judged j;
  const uint64_t hits = j.judge().hits();
  const auto move_truth = [&](float factor) {
    Judged moved;
    for (float& t : moved.truth.hits.t) t *= factor;
    return moved.judge();
  };
  EXPECT_EQ(move_truth(2.0f).early, hits);
  EXPECT_EQ(move_truth(0.5f).through, hits);
  for (uint32_t& p : j.truth.hits.primitive) p = kNoPrimitive;
  EXPECT_EQ(j.judge().phantom, hits);
}

TEST(VerdictTable, TheToleranceIsKFootprintsOverTheCosine) {
  Judged j;
  const View& view = j.v->gbuffer.view;
  // Truth is moved by 0.9 and by 1.1 of the tolerance computed here from the definition.
  for (double share : {0.9, 1.1}) {
    Judged moved;
    for (size_t i = 0; i < moved.results.size(); ++i) {
      const dvec3 d(moved.v->rays.direction(i));
      const double t = moved.truth.hits.t[i], w = view.view_depth(dvec3(moved.v->rays.origin(i)) + t * d);
      const double cosine = std::max(0.1, std::abs(d.z));  // the wall's normal is the z axis
      moved.truth.hits.t[i] += static_cast<float>(share * 3.0 * w / view.focal() / cosine);
    }
    const VerdictTable t = moved.judge(3.0);
    const double right = static_cast<double>(t.right) / static_cast<double>(t.hits());
    if (share < 1.0)
      EXPECT_GT(right, 0.99);
    else
      EXPECT_LT(right, 0.01);
  }
}

TEST(VerdictTable, CountsMissesThatTrulyHit) {
  Judged j;
  const size_t last = j.results.size() - 1;
  for (size_t i : {size_t{0}, last}) j.results.verdict[i] = Verdict::miss;
  j.truth.hits.primitive[0] = kNoPrimitive;
  j.truth.hits.primitive[last] = 1;
  const VerdictTable t = j.judge();
  uint64_t expected = 0;
  for (size_t i = 0; i < j.results.size(); ++i)
    expected += j.results.verdict[i] == Verdict::miss && j.truth.hits.primitive[i] != kNoPrimitive;
  EXPECT_EQ(t.false_misses, expected);
  EXPECT_GE(expected, 1u);
}

}  // namespace
}  // namespace hybray::metrics
