// Single paths at the edges of a prism: where a path may lose count of the medium that it is in, and where
// not.
#include "core/caustics/path_walk.h"

#include "core/caustics/caustic_pass.h"
#include "core/scene/procedural/closed_form_scenes.h"
#include "core/scene/surface_point.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using Prism = procedural::Prism;

class PathWalkAtEdges : public testing::Test {
 protected:
  // Sends a ray along `direction` at `target` on the prism's surface, one interaction and one segment more,
  // and counts the interfaces met from the wrong medium. The segment's random choice is refraction.
  uint64_t mismatches(const dvec3& target, const dvec3& direction) const {
    WalkOptions options;
    options.max_events = 1;
    options.roulette_threshold = 0.0;
    options.mode = TraceMode::single;
    WalkCounts counts;
    PathWalk walk(prepared_.tracer, prepared_.caustic.optics, options, counts);
    const auto memory = std::make_unique<WalkMemory>();
    Path path;
    path.weight = dvec3(1.0), path.initial = 1.0;
    for (path.number = 0; memory->front().count == 0 || memory->front().path(0).medium == 0; ++path.number) {
      counts = {};
      memory->front().count = 0;
      memory->front().push(target - 0.5 * direction, direction, path);
      walk.advance(*memory);
      if (path.number == 1000) ADD_FAILURE() << "no path enters the prism";
      if (path.number == 1000) return 0;
    }
    walk.advance(*memory);
    return counts.medium_mismatches;
  }

  const test::Prepared prepared_{test::closed_form_scene("closed_prism")};
  const dvec3 light_{std::cos(Prism::light_angle * std::numbers::pi / 180.0),
                     std::sin(Prism::light_angle* std::numbers::pi / 180.0), 0.0};
  const dvec3 upper_edge_{std::numbers::sqrt3 / 6.0 * Prism::side, Prism::center_height + 0.5 * Prism::side,
                          0.0};
  const double offset_ = kSurfaceOffset * 2.0 * Prism::half_length;
};

TEST_F(PathWalkAtEdges, APathThatEntersWithinItsOffsetOfAnEdgeMeetsTheOtherFaceFromOutside) {
  // Down the upright face from the edge; h / tan(60 degrees) away, the offset point lies on the other face.
  // Coordinates of 2 m are good to 2^-23 m, two of which decide.
  const double band = offset_ / std::sqrt(3.0), rounding = 2.0 * 0x1p-23;
  for (int i = 0; i < 40; ++i) {
    const double z = -1.4 + 0.07 * i;
    const auto at = [&](double distance) {
      return mismatches(upper_edge_ + dvec3(0.0, -distance, z), light_);
    };
    EXPECT_EQ(at(0.5 * band), 1u) << z;
    EXPECT_EQ(at(band - 4.0 * rounding), 1u) << z;
    EXPECT_EQ(at(band + 4.0 * rounding), 0u) << z;
    EXPECT_EQ(at(2.0 * band), 0u) << z;
    EXPECT_EQ(at(1e-3), 0u) << z;
    EXPECT_EQ(at(0.5), 0u) << z;
  }
}

TEST_F(PathWalkAtEdges, PastTheOtherEdgesOfTheLitFacesPathsLeadAwayFromTheBody) {
  const dvec3 down_left{-0.5 * std::numbers::sqrt3, -0.5, 0.0};  // along the upper face from the upper edge
  for (int i = 0; i < 40; ++i) {
    const double z = -1.4 + 0.07 * i;
    for (const double distance : {0.3 * offset_, offset_, 1e-3}) {
      const dvec3 start = upper_edge_ + dvec3(0.0, 0.0, z);
      EXPECT_EQ(mismatches(start + distance * down_left, light_), 0u) << distance;
      EXPECT_EQ(mismatches(start + (Prism::side - distance) * down_left, light_), 0u) << distance;
      EXPECT_EQ(mismatches(start - dvec3(0.0, Prism::side - distance, 0.0), light_), 0u) << distance;
    }
  }
}

}  // namespace
}  // namespace hybray
