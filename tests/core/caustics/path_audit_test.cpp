// Audited paths are the paths that leave the photons, and what is wrong with them is found.
#include "core/caustics/path_audit.h"

#include "core/base/parallel.h"
#include "core/scene/procedural/closed_form_scenes.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

PassSettings settings_of(LeavingOffset leaving = LeavingOffset::largest) {
  PassSettings s;
  s.map_resolution = 64;
  s.first_surface = FirstSurface::traced;
  s.walk.leaving = leaving;
  s.lights = {0};
  return s;
}

double sum(const std::vector<double>& values) {
  double all = 0.0;
  for (const double v : values) all += v;
  return all;
}

TEST(PathAudit, FollowsThePathsThatLeaveThePhotons) {
  const Prepared p(mixed_scene());
  const PassSettings s = settings_of();
  const MapSet maps = make_maps(p.caustic, s);
  const LightPaths paths = trace_light_paths(p.caustic, s, maps, 3);
  const PathAudit audit = audit_light_paths(p.caustic, s, maps, 3);
  double carried = 0.0;
  paths.list.photons.for_each([&](const Photon& photon) { carried += mean_flux(photon); });
  EXPECT_NEAR(sum(audit.arrived), carried, 1e-6 * carried);
  EXPECT_EQ(audit.segments, paths.list.counts.rays);
  EXPECT_EQ(audit.self_intersections, 0u);
}

TEST(PathAudit, IsTheSameAtAnyNumberOfThreads) {
  const Prepared p(mixed_scene());
  const PassSettings s = settings_of();
  const MapSet maps = make_maps(p.caustic, s);
  const PathAudit many = audit_light_paths(p.caustic, s, maps, 0);
  const ThreadLimit limit(1);
  const PathAudit one = audit_light_paths(p.caustic, s, maps, 0);
  EXPECT_EQ(many.segments, one.segments);
  EXPECT_EQ(many.arrived, one.arrived);
}

// All that arrives under a slab arrives in vacuum, unless the offset carries paths through its other face.
TEST(PathAudit, TellsFluxThatArrivesInTheWrongMedium) {
  const auto in_glass = [](double thickness, LeavingOffset leaving) {
    const Prepared p(procedural::closed_form_scene(procedural::GlassSlab{.thickness = thickness}));
    const PassSettings s = settings_of(leaving);
    const PathAudit audit = audit_light_paths(p.caustic, s, make_maps(p.caustic, s), 0);
    EXPECT_EQ(p.caustic.optics.media.size(), 2u);
    EXPECT_GT(sum(audit.arrived), 0.0);
    return audit.arrived.at(1) / sum(audit.arrived);
  };
  const double offset = kSurfaceOffset * 20.0;  // of faces of 20 m
  EXPECT_EQ(in_glass(1.0, LeavingOffset::largest), 0.0);
  EXPECT_GT(in_glass(0.1 * offset, LeavingOffset::largest), 0.9);
  EXPECT_EQ(in_glass(0.1 * offset, LeavingOffset::along_normal), 0.0);
}

}  // namespace
}  // namespace hybray
