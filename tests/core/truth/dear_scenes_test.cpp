// Marching and truth on scenes whose rays are dear: cut-outs and user geometry.
#include "core/scene/procedural/generators.h"
#include "core/truth/march_level0.h"
#include "core/truth/ray_truth.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray::truth {
namespace {

std::vector<Scene> dear_scenes() {
  std::vector<Scene> scenes;
  scenes.push_back(procedural::foliage({1u << 15, 1}));
  scenes.push_back(procedural::meadow({1u << 15, 1}));
  scenes.push_back(procedural::sculptures({1u << 13, 1}));
  return scenes;
}

TEST(DearScenes, TheHierarchicalMarchAgreesWithTheExhaustiveOneRayForRay) {
  for (const Scene& scene : dear_scenes()) {
    const Tracer tracer(scene, {.robust = true});
    for (const auto& [w, h] : {std::pair{333, 217}, {64, 1}, {1, 1}}) {
      const View view(scene.cameras.front(), {.width = w, .height = h}, scene.bounds);
      const test::MainView v(tracer, view);
      const auto same = march_level0<float>(v.depth(), v.screen_rays, v.rays.pixel);
      for (const ssrm::MarchCode code : {ssrm::MarchCode::scalar, ssrm::MarchCode::lanes}) {
        const ssrm::MarchResults got = v.march({0, code});
        ASSERT_EQ(got.size(), same.size());
        size_t differ = 0, hits = 0;
        for (size_t i = 0; i < got.size(); ++i) {
          differ += got.verdict[i] != same.verdict[i] || got.pixel[i] != same.pixel[i];
          hits += got.verdict[i] == ssrm::Verdict::hit;
        }
        EXPECT_EQ(differ, 0u) << scene.name << " " << w << "x" << h;
        if (w == 333) {
          EXPECT_GT(hits, got.size() / 20) << scene.name;
        }
      }
    }
  }
}

TEST(DearScenes, EveryModeOfTheTracerFindsTheTruthOfTheReflections) {
  for (const Scene& scene : dear_scenes()) {
    const Tracer robust(scene, {.robust = true, .high_quality = false}), tracer(scene, {});
    const View view(scene.cameras.back(), {.width = 160, .height = 90}, scene.bounds);
    const test::MainView v(robust, view);
    const RayTruth truth = trace_truth(robust, v.rays, view);
    HitStream hits;
    hits.resize(v.rays.size());
    for (const TraceMode mode : kAllTraceModes) {
      tracer.trace(v.rays, hits, mode);
      size_t differ = 0, dear = 0;
      for (size_t i = 0; i < hits.t.size(); ++i) {
        const uint32_t hit = hits.primitive[i];
        differ += hit != truth.hits.primitive[i];
        dear += hit != kNoPrimitive && (!scene.is_triangle(hit) || scene.is_cut_out(hit));
      }
      // Rays within float rounding of an edge or a rim: on foliage, about 10 leaves a ray, rims 15 times as
      // long as a leaf, rounding 1e-6 of it: 1.5e-4.
      EXPECT_LE(differ, 2 + hits.t.size() * 3 / 10000) << scene.name << " " << label(mode);
      EXPECT_GT(dear, hits.t.size() / 20) << scene.name;
    }
  }
}

}  // namespace
}  // namespace hybray::truth
