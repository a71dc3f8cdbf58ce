#include "core/truth/exact_frame.h"

#include "core/scene/procedural/corner.h"
#include "core/truth/march_level0.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace hybray::truth {
namespace {

using ssrm::Marcher;
using ssrm::Verdict;

ExactFrame exact_frame(const Tracer& tracer, const View& view) {
  return ExactFrame(tracer.scene(), view, make_gbuffer(tracer, view, kPrimitive).primitive);
}

// A floor y = 0 before a wall z = -5, seen from (0, 2, 4): all by the laws of reflection.
TEST(ExactFrame, FindsTheWallInTheFloorWhereGeometrySaysItIs) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-20, 0, 10), vec3(40, 0, 0), vec3(0, 0, -15));
  test::add_rectangle(scene, vec3(-20, 0, -5), vec3(40, 0, 0), vec3(0, 8, 0));
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 2, 4), vec3(0, 1, -5)}, {.width = 160, .height = 90}, scene.bounds);
  const ExactFrame frame = exact_frame(tracer, view);
  for (const Marcher marcher : {Marcher::paper, Marcher::plane}) {
    int hits = 0;
    for (uint32_t pixel = 0; pixel < frame.primitive().size(); ++pixel) {
      if (frame.primitive()[pixel] > 1) continue;  // not the floor
      const dvec3 d =
          view.ray_direction(static_cast<int>(pixel) % 160 + 0.5, static_cast<int>(pixel) / 160 + 0.5);
      const double w = 2.0 / -d.y;
      EXPECT_NEAR(frame.view_depth(pixel), w, 1e-12 * w);
      const dvec3 point = view.eye() + w * d, mirrored = glm::normalize(dvec3(d.x, -d.y, d.z));
      const auto ray = frame.mirror_ray(pixel);
      ASSERT_TRUE(ray);
      EXPECT_NEAR(glm::distance(ray->origin, point), 0.0, 1e-11);
      EXPECT_NEAR(glm::distance(ray->direction, mirrored), 0.0, 1e-13);
      const double t = (point.z + 5.0) / -mirrored.z;
      const dvec3 struck = point + t * mirrored;
      const dvec2 screen = view.project(struck);
      // A pixel across the wall's foot or top may show something else at its centre.
      const bool inside = screen.x > 0.0 && screen.x < 160.0 && screen.y > 0.0 && screen.y < 90.0;
      const bool seen =
          inside && struck.y < 8.0 &&
          (frame.primitive()(static_cast<int>(screen.x), static_cast<int>(screen.y)) | 1u) == 3u;
      const ssrm::Correction c = frame.march(*ray, marcher);
      if (marcher == Marcher::plane) {
        EXPECT_EQ(c.verdict == Verdict::hit, seen) << pixel;
      }
      if (c.verdict != Verdict::hit) continue;
      ++hits;
      EXPECT_EQ(c.pixel, view.pixel_index(static_cast<int>(screen.x), static_cast<int>(screen.y)));
      EXPECT_NEAR(frame.distance(*ray, c.pixel), t, 1e-9 * t);
    }
    EXPECT_GT(hits, 500);
  }
}

// The float pipeline differs where a decision is closer than what it disturbs. Most of that is the offset of
// the rays' origins: 2^-19 of 12 m, 2e-5 m, against pixels of 4 m / 156 = 3e-2 m: 1e-3 of the last decision's
// interval.
TEST(ExactFrame, AgreesWithTheFloatPipelineButForRounding) {
  for (const char* name : {"sphere", "corner"}) {
    const Scene scene = load_scene(test::scene_paths(), name);
    const Tracer tracer(scene, {.robust = true});
    const View view(scene.cameras[0], {.width = 320, .height = 180}, scene.bounds);
    const test::MainView main(tracer, view);
    const ExactFrame frame = exact_frame(tracer, view);
    for (const Marcher marcher : {Marcher::paper, Marcher::plane}) {
      const ssrm::MarchResults results =
          march_level0<double>(main.depth(), main.screen_rays, main.rays.pixel, 1, marcher);
      size_t flipped = 0, hits = 0;
      for (size_t i = 0; i < main.rays.size(); ++i) {
        const auto ray = frame.mirror_ray(main.rays.pixel[i]);
        ASSERT_TRUE(ray);
        const ssrm::Correction c = frame.march(*ray, marcher);
        flipped += c.verdict != results.verdict[i] || c.pixel != results.pixel[i];
        hits += c.verdict == Verdict::hit;
      }
      EXPECT_LT(static_cast<double>(flipped), 1e-3 * static_cast<double>(main.rays.size()))
          << name << " of marcher " << static_cast<int>(marcher);
      EXPECT_GT(hits, main.rays.size() / 6);
    }
  }
}

TEST(ExactFrame, DoesNotDependOnTheEncodingOfDepth) {
  const Scene scene = procedural::corner();
  const Tracer tracer(scene, {.robust = true});
  const View a(scene.cameras[0], {.width = 120, .height = 67}, scene.bounds);
  const View b(scene.cameras[0],
               {.width = 120, .height = 67, .far = a.far(), .convention = DepthConvention::standard},
               scene.bounds);
  const ExactFrame one = exact_frame(tracer, a), other = exact_frame(tracer, b);
  for (uint32_t pixel = 0; pixel < one.primitive().size(); ++pixel) {
    if (one.primitive()[pixel] == kNoPrimitive) continue;
    const ssrm::Correction c = one.march(*one.mirror_ray(pixel), Marcher::paper),
                           d = other.march(*other.mirror_ray(pixel), Marcher::paper);
    ASSERT_EQ(c.verdict, d.verdict);
    ASSERT_EQ(c.pixel, d.pixel);
  }
}

}  // namespace
}  // namespace hybray::truth
