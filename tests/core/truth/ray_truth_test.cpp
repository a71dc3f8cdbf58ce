#include "core/truth/ray_truth.h"

#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray::truth {
namespace {

TEST(RayTruth, KnowsWhatIsHitAndWhetherTheMainViewSeesIt) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-9, -9, -10), vec3(18, 0, 0),
                      vec3(0, 18, 0));  // back wall, triangles 0 and 1
  test::add_rectangle(scene, vec3(-1, -1, -5), vec3(2, 0, 0),
                      vec3(0, 2, 0));  // screen before its middle, 2 and 3
  test::add_rectangle(scene, vec3(-9, -9, 9), vec3(18, 0, 0),
                      vec3(0, 18, 0));  // wall behind the eye, 4 and 5
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0), vec3(0, 0, -1), vec3(0, 1, 0), 60.0f}, {.width = 100, .height = 100},
                  scene.bounds);
  RayStream rays;
  rays.resize(5);
  rays.set(0, vec3(3, 0, -8), vec3(0, 0, -1), 0);     // wall beside the screen: seen
  rays.set(1, vec3(0.5f, 0, -8), vec3(0, 0, -1), 0);  // wall behind the screen: not seen
  rays.set(2, vec3(8, 0, -8), vec3(0, 0, -1), 0);     // wall outside the field of view: 8 > 10 tan 30
  rays.set(3, vec3(2, 0, 3), vec3(0, 0, 1), 0);       // behind the eye
  rays.set(4, vec3(0, 0, -8), vec3(0, 1, 0), 0);      // nothing
  const RayTruth truth = trace_truth(tracer, rays, view);
  EXPECT_EQ(truth.visible, (std::vector<uint8_t>{1, 0, 0, 0, 0}));
  EXPECT_FLOAT_EQ(truth.hits.t[0], 2.0f);
  EXPECT_FLOAT_EQ(truth.hits.t[1], 2.0f);
  EXPECT_LE(truth.hits.primitive[2], 1u);
  EXPECT_FLOAT_EQ(truth.hits.t[3], 6.0f);
  EXPECT_EQ(truth.hits.primitive[4], kNoPrimitive);
}

}  // namespace
}  // namespace hybray::truth
