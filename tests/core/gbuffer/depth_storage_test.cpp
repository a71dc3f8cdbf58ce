#include "core/gbuffer/depth_storage.h"

#include "tests/core/test_scenes.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr DepthFormat kFormats[] = {DepthFormat::float32, DepthFormat::unorm24, DepthFormat::unorm16};
constexpr DepthConvention kConventions[] = {DepthConvention::standard, DepthConvention::reversed};

double random_depth(uint64_t i) {
  const double u = random_unit(i, 0, 0, 5);
  return i % 3 == 0 ? u : i % 3 == 1 ? std::pow(u, 8.0) : 1.0 - std::pow(u, 8.0);
}

// Two stored values next to `depth` are a step of the format and a float's last bit apart at most; to the
// nearest, each errs by half.
double most_error(double depth, const DepthStorage& storage) {
  const double step = storage.format == DepthFormat::float32   ? 0.0
                      : storage.format == DepthFormat::unorm24 ? 1.0 / 16777215.0
                                                               : 1.0 / 65535.0;
  const float above = static_cast<float>(depth + step);
  const double last_bit = static_cast<double>(std::nextafter(above, 2.0f)) - static_cast<double>(above);
  return (storage.rounding == DepthRounding::nearest ? 0.5 : 1.0) * (step + last_bit);
}

TEST(DepthStorage, ErrsByNoMoreThanItsStep) {
  for (const DepthFormat format : kFormats)
    for (const DepthConvention convention : kConventions)
      for (const DepthRounding rounding : {DepthRounding::nearest, DepthRounding::viewer})
        for (uint64_t i = 0; i < 3000; ++i) {
          const double d = random_depth(i), stored = stored_depth(d, convention, {format, rounding});
          ASSERT_LE(std::abs(stored - d), most_error(d, {format, rounding})) << d;
          ASSERT_GE(stored, 0.0);
          ASSERT_LE(stored, 1.0);
        }
}

TEST(DepthStorage, RoundedTowardTheViewerNothingIsStoredBehindWhereItIs) {
  for (const DepthFormat format : kFormats)
    for (uint64_t i = 0; i < 3000; ++i) {
      const double d = random_depth(i);
      const DepthStorage storage{format, DepthRounding::viewer};
      EXPECT_LE(double(stored_depth(d, DepthConvention::standard, storage)), d);
      EXPECT_GE(double(stored_depth(d, DepthConvention::reversed, storage)), d);
    }
}

TEST(DepthStorage, KeepsTheEndsAndWholeSteps) {
  for (const DepthConvention convention : kConventions) {
    for (const DepthFormat format : kFormats)
      for (const DepthRounding rounding : {DepthRounding::nearest, DepthRounding::viewer}) {
        EXPECT_EQ(stored_depth(0.0, convention, {format, rounding}), 0.0f);
        EXPECT_EQ(stored_depth(1.0, convention, {format, rounding}), 1.0f);
      }
    for (const int k : {1, 77, 32768, 65534})
      EXPECT_EQ(stored_depth(k / 65535.0, convention, {DepthFormat::unorm16, DepthRounding::nearest}),
                static_cast<float>(k / 65535.0));
    EXPECT_EQ(stored_depth(1.4 / 65535.0, convention, {DepthFormat::unorm16, DepthRounding::nearest}),
              static_cast<float>(1 / 65535.0));
  }
}

// The textbook error of view depth in fixed point: dw = w^2 (f - n) / (f n) times half a step.
TEST(DepthStorage, OfAWallIsOffByTheFormulaOfFixedPointDepth) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-60, -60, -30), vec3(120, 0, 0), vec3(0, 120, 30));  // leans away
  const Tracer tracer(scene, {.robust = true});
  for (const DepthConvention convention : kConventions) {
    const double near = 0.1, far = 100.0;
    const View view(Camera{"c", vec3(0), vec3(0, 0, -1)},
                    {.width = 64, .height = 48, .near = near, .far = far, .convention = convention},
                    scene.bounds);
    GBuffer g = make_gbuffer(tracer, view, kDepth | kPrimitive);
    store_depths(g, scene, {DepthFormat::unorm16, DepthRounding::nearest});
    double worst = 0.0;
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) {
        // z = -30 + (y + 60) / 4 on the wall.
        const dvec3 d = view.ray_direction(x + 0.5, y + 0.5);
        const double w = 15.0 / (1.0 + 0.25 * d.y);
        const double step = w * w * (far - near) / (far * near) / 65535.0;
        const double error = std::abs(view.view_depth_of(double(g.depth(x, y))) - w);
        ASSERT_LE(error, 0.5 * step * 1.02);  // of second order: step / w = 0.3 %
        worst = std::max(worst, error / step);
      }
    EXPECT_GT(worst, 0.45) << "half a step is reached";
  }
}

}  // namespace
}  // namespace hybray
