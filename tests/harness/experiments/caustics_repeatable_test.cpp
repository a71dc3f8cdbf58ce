// `caustics` gives the same numbers at any thread count, by either kind of photon map, and computes nothing
// twice.
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/harness/experiments/caustics_fixture.h"

#include <set>

namespace hybray {
namespace {

using CausticsRepeatable = test::CausticsFixture;

TEST_F(CausticsRepeatable, MetricsAreTheSameToTheBitAtAnyThreadCountAndWithoutTiming) {
  const Changes points[] = {
      {{"scene", text("mirror_and_floor")}, {"camera", text("mirror")}, {"reference_paths", 3e4}},
      {{"scene", text("glass_ball")},
       {"camera", text("through")},
       {"mixed", text("forward")},
       {"filter", text("wavelet")},
       {"mirror_depth", int64_t{8}},
       {"rays_per_texel", 6.5},
       {"camera_paths", int64_t{3}}},
      {{"scene", text("water_pool")}, {"visibility", text("shadow")}, {"rays_per_texel", 0.3}},
      {{"scene", text("closed_furnace")}, {"emission", text("uniform")}, {"first_surface", text("traced")}}};
  for (const Changes& point : points) {
    SCOPED_TRACE(std::get<std::string>(point.at("scene")));
    const auto at_threads = [&](int threads, bool timing) {
      const ThreadLimit limit(threads);
      return run(point, timing);
    };
    const Row one = at_threads(1, false);
    EXPECT_GT(integer(one, "photons"), 0);
    expect_same_metrics(one, at_threads(2, true));
    expect_same_metrics(one, at_threads(3, false));
  }
}

TEST_F(CausticsRepeatable, ForwardAndBackwardPhotonMapsGiveTheSameNumbers) {
  for (const auto& [scene, camera] : {std::pair("glass_ball", "through"), {"mirror_and_floor", "mirror"}}) {
    Workspace workspace(settings());
    const auto of_kind = [&](const char* kind) {
      return run_in(workspace, {{"scene", text(scene)},
                                {"camera", text(camera)},
                                {"mixed", text(kind)},
                                {"rays_per_texel", 8.0},
                                {"gather_radius", 4.0},
                                {"reference_paths", 2e4}});
    };
    const Row backward = of_kind("backward");
    EXPECT_GT(integer(backward, "photon_pairs"), 100) << scene;
    expect_same_metrics(backward, of_kind("forward"), "mixed");
  }
}

TEST_F(CausticsRepeatable, EveryCellItFillsIsADeclaredColumn) {
  std::set<std::string> declared, filled;
  for (const Column& column : caustics_experiment().columns) declared.insert(column.name);
  EXPECT_EQ(declared.size(), caustics_experiment().columns.size()) << "no name twice";
  for (const auto& [scene, emission] : {std::pair("glass_ball", "map"), {"closed_furnace", "uniform"}}) {
    for (const auto& [name, value] :
         run({{"scene", text(scene)}, {"emission", text(emission)}, {"reference_paths", 2e4}}, true)) {
      EXPECT_TRUE(declared.count(name)) << name;
      if (!std::holds_alternative<std::monostate>(value)) filled.insert(name);
    }
  }
  for (const std::string& name : declared) EXPECT_TRUE(filled.count(name)) << name << " is never filled";
}

TEST_F(CausticsRepeatable, WithoutTimingNothingIsTimed) {
  const Row row = run({});
  for (const Column& column : caustics_experiment().columns)
    if (column.kind == ColumnKind::time || column.name == "repeats") {
      EXPECT_TRUE(is_empty(row, column.name)) << column.name;
    }
}

// Workspace::reused counts what a point found ready. Two points that find the same things ready differ by one
// exactly where one of them had to make the reference.
TEST_F(CausticsRepeatable, AReferenceIsMadeOnceForAllPointsThatItServes) {
  Workspace workspace(settings());
  const Changes base{{"camera", text("front")}, {"reference_paths", 2e4}};
  Row row;
  const auto reused_by = [&](const Changes& changes) {
    Changes point = base;
    for (const auto& [name, value] : changes) point[name] = value;
    const uint64_t before = workspace.reused();
    row = run_in(workspace, point);
    return workspace.reused() - before;
  };
  run_in(workspace, {});  // scene, acceleration structures and optics are there from now on
  const uint64_t makes = reused_by({});
  const int64_t rays = integer(row, "reference_rays");
  const double own = number(row, "reference_relmse");
  EXPECT_GT(rays, 4 * 20000);

  const Changes served[] = {{{"rays_per_texel", 0.5}},      {{"rays_per_texel", 2.0}},
                            {{"mirror_depth", int64_t{8}}}, {{"map_resolution", int64_t{32}}},
                            {{"filter", text("wavelet")}},  {{"emission", text("uniform")}},
                            {{"mixed", text("forward")}}};
  for (const Changes& changes : served) {
    EXPECT_EQ(reused_by(changes), makes + 1) << changes.begin()->first;
    EXPECT_EQ(integer(row, "reference_rays"), rays) << changes.begin()->first;
    EXPECT_EQ(number(row, "reference_relmse"), own) << changes.begin()->first;
  }
  const Changes apart[] = {{{"camera", text("caustic")}},     {{"resolution", text("32x18")}},
                           {{"reference_paths", 1e4}},        {{"reference_batches", int64_t{3}}},
                           {{"reference_radius", 3.0}},       {{"mixed", text("none")}},
                           {{"lights_invisible", int64_t{0}}}};
  for (const Changes& changes : apart)
    EXPECT_EQ(reused_by(changes), makes) << changes.begin()->first << " needs a reference of its own";
}

TEST_F(CausticsRepeatable, WhatNoFrameCanBeMadeOfFailsBeforeTheReferenceIsMade) {
  Workspace workspace(settings());
  const Changes good{{"camera", text("front")}, {"reference_paths", 2e4}};
  Changes bad = good;
  bad["rays_per_texel"] = 1e6;
  run_in(workspace, {{"camera", text("front")}});
  EXPECT_THROW(run_in(workspace, bad), InputError);
  uint64_t before = workspace.reused();
  run_in(workspace, good);
  const uint64_t first = workspace.reused() - before;
  before = workspace.reused();
  run_in(workspace, good);
  EXPECT_EQ(workspace.reused() - before, first + 1) << "the first had to make the reference";
}

}  // namespace
}  // namespace hybray
