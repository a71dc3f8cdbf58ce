#include "harness/timing/interleaved.h"

#include "harness/timing/trace_mode_choice.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(TimeInterleaved, RunsEveryVariantOnceARoundAfterARoundThatIsNotCounted) {
  std::string order;
  const Variant variants[] = {
      {"a", [&] { order += 'a'; }}, {"b", [&] { order += 'b'; }}, {"c", [&] { order += 'c'; }}};
  const InterleavedTimes times = time_interleaved(variants, 40, 3);
  ASSERT_EQ(order.size(), 3u * 41u);
  EXPECT_EQ(order.substr(0, 3), "abc") << "warm-up";
  std::set<std::string> rounds;
  for (size_t r = 0; r < 41; ++r) {
    const std::string round = order.substr(3 * r, 3);
    EXPECT_EQ(std::set<char>(round.begin(), round.end()).size(), 3u);
    rounds.insert(round);
  }
  EXPECT_EQ(rounds.size(), 6u)
      << "40 rounds meet all six orders; missing one has odds of 0.4 %, and the seed is fixed";
  for (size_t v = 0; v < 3; ++v) {
    EXPECT_EQ(times.of(v).size(), 40u);
    for (double ms : times.of(v)) EXPECT_GE(ms, 0.0);
  }
}

TEST(FastestTraceMode, ChoosesAModeForAnyNumberOfRaysAndLeavesNoRayOut) {
  const Scene scene = test::triangle_soup(100, 0.5f, 1.0f, 2);
  const Tracer tracer(scene, {});
  for (size_t n : {size_t{0}, size_t{1}, size_t{5000}}) {
    RayStream rays;
    rays.resize(n);
    std::vector<uint32_t> which;
    for (size_t i = 0; i < n; ++i) {
      rays.set(i, vec3(0, 0, 5), glm::normalize(vec3(vec2(0.001f * static_cast<float>(i % 100)), -1)), 0);
      which.push_back(static_cast<uint32_t>(i));
    }
    HitStream hits;
    hits.resize(n);
    std::fill(hits.t.begin(), hits.t.end(), -1.0f);
    const TraceMode mode = fastest_trace_mode(tracer, rays, which, hits, 1);
    EXPECT_NE(std::string(label(mode)), "unknown");
    for (float t : hits.t) EXPECT_GE(t, 0.0f);
  }
}

}  // namespace
}  // namespace hybray
