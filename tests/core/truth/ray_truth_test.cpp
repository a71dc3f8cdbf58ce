#include "core/truth/ray_truth.h"

#include "core/truth/layer_visibility.h"
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

// The eye looks along -z at an upright curve and a ball; rays meet them from before and from behind.
TEST(RayTruth, TheFarSideOfACurvedPrimitiveIsNotVisibleAlthoughThePrimitiveIs) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-9, -9, -10), vec3(18, 0, 0), vec3(0, 18, 0));
  append_analytic(scene, analytic_sphere("ball", 0, {2, 0, -6}, 0.5));
  RoundCurve curve;
  for (size_t i = 0; i < 4; ++i) curve.control[i] = vec4(-1.0f, -1.5f + static_cast<float>(i), -6.0f, 0.125f);
  append_curve(scene, curve);
  const Tracer tracer(scene, {.robust = true, .layers = true});
  const View view(Camera{"c", vec3(0), vec3(0, 0, -1), vec3(0, 1, 0), 60.0f}, {.width = 100, .height = 100},
                  scene.bounds);
  RayStream rays;
  rays.resize(5);
  rays.set(0, vec3(-0.9f, 0.2f, -1), glm::normalize(vec3(-0.02f, 0, -1)), 0);  // the curve's near side
  rays.set(1, vec3(-1, 0.2f, -9), vec3(0, 0, 1), 0);                           // its far side
  rays.set(2, vec3(2, 0.1f, -1), vec3(0, 0, -1), 0);                           // the ball's near side
  rays.set(3, vec3(2, 0.1f, -9), vec3(0, 0, 1), 0);                            // its far side
  rays.set(4, vec3(0, 0, -9), vec3(0, 0, -1), 0);                              // the wall between both
  const RayTruth truth = trace_truth(tracer, rays, view);
  EXPECT_EQ(truth.hits.primitive[0], 3u);
  EXPECT_EQ(truth.hits.primitive[1], 3u);
  EXPECT_NEAR(truth.hits.t[1], 2.875, 1e-5);
  EXPECT_EQ(truth.hits.primitive[3], 2u);
  EXPECT_EQ(truth.visible, (std::vector<uint8_t>{1, 0, 1, 0, 1}));
  // No layer holds a far side; the first holds the near ones.
  const std::vector<uint8_t> layers = layers_of_hits(tracer, rays, truth.hits, view, 4);
  EXPECT_EQ(layers, (std::vector<uint8_t>{0, kNotSeen, 0, kNotSeen, 0}));
}

}  // namespace
}  // namespace hybray::truth
