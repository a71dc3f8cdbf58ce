#include "core/tracer/seeded_camera.h"

#include "core/base/error.h"
#include "core/scene/procedural/generators.h"
#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(SeededCamera, NamesAndNumbersBelongTogether) {
  EXPECT_EQ(seeded_camera_name(17), "seeded/17");
  for (uint32_t number : {0u, 7u, kLargestSeededCamera})
    EXPECT_EQ(seeded_camera_number(seeded_camera_name(number)), number);
  for (const char* name : {"seeded/", "seeded/01", "seeded/-1", "seeded/1000000",
                           "seeded/99999999999999999999", "seeded/1x", "seeded/ 1", "seeded*4", "seeded", ""})
    EXPECT_FALSE(seeded_camera_number(name)) << name;
  EXPECT_EQ(seeded_camera_count("seeded*64"), 64u);
  for (const char* name : {"seeded*", "seeded*0", "seeded*4097", "seeded*1.5", "seeded/4", "*"})
    EXPECT_FALSE(seeded_camera_count(name)) << name;
}

TEST(SeededCamera, IsTheSameEachTimeAndAnotherForEachNumberAndSeed) {
  const Scene scene = procedural::atrium({20'000});
  const Tracer tracer(scene, {.robust = true}), again(scene, {.robust = true});
  const Camera first = seeded_camera(tracer, 3), second = seeded_camera(again, 3);
  EXPECT_EQ(first.eye, second.eye);
  EXPECT_EQ(first.target, second.target);
  EXPECT_EQ(first.name, "seeded/3");
  EXPECT_EQ(camera_of(tracer, "seeded/3").eye, first.eye);
  EXPECT_NE(seeded_camera(tracer, 4).eye, first.eye);
  EXPECT_NE(seeded_camera(tracer, 3, 1).eye, first.eye);
  EXPECT_EQ(camera_of(tracer, "nave").eye, find_camera(scene, "nave").eye);
}

// A room of 8 x 4 x 8 m, seen from inside its walls' front sides, with a closed block of 3 x 3 x 3 m on its
// floor.
Scene room_with_block() {
  Scene scene = test::empty_scene();
  const auto box = [&](const vec3& lower, const vec3& upper, bool outward) {
    const vec3 s = upper - lower, x(s.x, 0, 0), y(0, s.y, 0), z(0, 0, s.z);
    const auto side = [&](const vec3& corner, const vec3& u, const vec3& v) {
      outward ? test::add_rectangle(scene, corner, u, v) : test::add_rectangle(scene, corner, v, u);
    };
    side(lower, x, z), side(lower, z, y), side(lower, y, x);        // cross products point down each axis
    side(upper, -z, -x), side(upper, -y, -z), side(upper, -x, -y);  // and up
  };
  box({0, 0, 0}, {8, 4, 8}, false);
  box({2.5f, 0, 2.5f}, {5.5f, 3, 5.5f}, true);
  return scene;
}

TEST(SeededCamera, StandsOnTheFloorOutsideClosedBodies) {
  const Scene scene = room_with_block();
  const Tracer tracer(scene, {.robust = true});
  for (uint32_t number = 0; number < 64; ++number) {
    const vec3 eye = seeded_camera(tracer, number).eye;
    // The scene's bounds have a diagonal of 12 m, so lengths are metres. On top of the block there is no
    // room.
    EXPECT_GE(eye.y, 1.5f - 1e-5f) << number;
    EXPECT_LE(eye.y, 1.8f + 1e-5f) << number;
    for (int axis : {0, 2}) {
      EXPECT_GT(eye[axis], 0.0f) << number;
      EXPECT_LT(eye[axis], 8.0f) << number;
    }
    EXPECT_FALSE(eye.x > 2.5f && eye.x < 5.5f && eye.z > 2.5f && eye.z < 5.5f) << number;
  }
}

TEST(SeededCamera, FindsAPlaceInTheProceduralScenesOfTheSsrmExperiments) {
  for (const auto& generate : {procedural::sphere, procedural::atrium, procedural::street}) {
    const Scene scene = generate({30'000});
    const Tracer tracer(scene, {.robust = true, .high_quality = false});
    for (uint32_t number = 0; number < 4; ++number)
      EXPECT_NO_THROW(seeded_camera(tracer, number)) << scene.name << ' ' << number;
  }
}

TEST(SeededCamera, SaysSoWhereThereIsNoPlace) {
  const Scene scene = test::empty_scene();  // nothing can be seen
  const Tracer tracer(scene, {});
  EXPECT_THROW(seeded_camera(tracer, 0), InputError);
}

}  // namespace
}  // namespace hybray
