// Truth: flip-evaluator 1.7 (PyPI), evaluate(reference, test, "HDR", applyMagma=False, parameters={"ppd": 67,
// ...}), on images that both sides compute alike (formula_images.h).
#include "core/metrics/hdr_flip.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/metrics/formula_images.h"
#include "tests/core/metrics/published_map.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

// Exposures of flip-evaluator are floats of up to 4, log2 of a quotient of floats: some 2^-22 each.
constexpr double kStops = 2e-6;
// Its stops for a white of 1: log2 of the radiance that ACES shows as 0.85.
constexpr double kStopsOfOne = 1.0832972526550293;

Image2D<vec3> flat(float value, int width = 20, int height = 15) {
  return {width, height, vec3(value)};
}

// `black` of 100 pixels are of radiance `rest`, every other one of the rest 1 and 2.
Image2D<vec3> lit_beside(int black, float rest) {
  Image2D<vec3> image(10, 10, vec3(rest));
  for (int i = black; i < 100; ++i) image[static_cast<size_t>(i)] = vec3(i < (100 + black) / 2 ? 1.0f : 2.0f);
  return image;
}

TEST(FlipExposures, AreThoseOfTheAuthorsImplementation) {
  const FlipExposures exposures = flip_exposures(test::high_range(test::formula_reference));
  EXPECT_NEAR(exposures.start, -2.61152720451355, kStops);
  EXPECT_NEAR(exposures.stop, 1.7390899658203125, kStops);
  EXPECT_EQ(exposures.count, 5);
}

TEST(FlipExposures, OfAConstantImageAreOneExposureTwice) {
  const FlipExposures one = flip_exposures(flat(1.0f)), two = flip_exposures(flat(2.0f));
  EXPECT_NEAR(one.start, kStopsOfOne, kStops);
  EXPECT_NEAR(one.stop, kStopsOfOne, kStops);
  EXPECT_EQ(one.count, 2);
  EXPECT_NEAR(two.stop, 0.08329720050096512, kStops);
}

TEST(FlipExposures, MoveWithTheUnitOfRadiance) {
  Image2D<vec3> image = test::high_range(test::formula_reference);
  const FlipExposures before = flip_exposures(image);
  for (vec3& v : image) v *= 0x1p-20f;
  const FlipExposures after = flip_exposures(image);
  EXPECT_NEAR(after.start, before.start + 20.0, 1e-12);
  EXPECT_NEAR(after.stop, before.stop + 20.0, 1e-12);
  EXPECT_EQ(after.count, before.count);
}

// The published median is 0 there: flip-evaluator 1.7 stops at float's epsilon instead, 24.08 stops up for
// these images, where every speck of light is white.
TEST(FlipExposures, OfAnImageMoreThanHalfBlackAreThoseOfItsLight) {
  for (const int black : {50, 60, 75, 98}) {
    const FlipExposures exposures = flip_exposures(lit_beside(black, 0.0f));
    EXPECT_NEAR(exposures.start, kStopsOfOne - 1.0, kStops) << black;
    EXPECT_GE(exposures.stop, kStopsOfOne - 1.0 - kStops) << black;
    EXPECT_LE(exposures.stop, kStopsOfOne + kStops) << black;
  }
  const FlipExposures alone = flip_exposures(lit_beside(60, 0.0f));
  EXPECT_NEAR(alone.stop, flip_exposures(lit_beside(0, 0.0f)).stop, 1e-12) << "as if there were no black";
  EXPECT_NEAR(flip_exposures(lit_beside(60, 1e-9f)).stop, alone.stop, 1e-12) << "nearly black is black";
  // Dim pixels that a picture would show do count: 0.1 of a mean of 0.7.
  EXPECT_NEAR(flip_exposures(lit_beside(60, 0.1f)).stop, kStopsOfOne + std::log2(10.0), kStops);
}

TEST(FlipExposures, OfABlackImageDoNotExist) {
  EXPECT_THROW(flip_exposures(flat(0.0f)), InputError);
  EXPECT_THROW(flip_exposures({}), InputError);
  EXPECT_THROW(flip_exposures(flat(-1.0f)), InputError);
  EXPECT_THROW(flip_exposures(flat(std::numeric_limits<float>::infinity())), InputError);
}

TEST(HdrFlip, GivesTheErrorsOfTheAuthorsImplementation) {
  const auto reference = test::high_range(test::formula_reference);
  test::expect_published_map(
      hdr_flip(test::high_range(test::formula_test), reference, flip_exposures(reference)), 0.14038447,
      {0.2269932f,  0.1804123f,  0.1396288f,  0.1084543f, 0.0003196134f, 0.0f,
       0.1084164f,  0.09437841f, 0.09867737f, 0.2580617f, 0.0006419142f, 0.0f,
       0.1280379f,  0.08023021f, 0.08016583f, 0.2653232f, 0.3252434f,    0.0006154518f,
       0.05382235f, 0.05165137f, 0.3171189f,  0.2407017f, 0.001142474f,  0.0f});
}

TEST(HdrFlip, GivesThemAtExposuresOfChoice) {
  test::expect_published_map(hdr_flip(test::high_range(test::formula_test),
                                      test::high_range(test::formula_reference), {-3.0, 2.0, 4}),
                             0.142793099,
                             {0.2811971f,  0.1869102f,  0.1324434f,  0.105513f,  0.00030873f,   0.0f,
                              0.1264226f,  0.1041734f,  0.09675337f, 0.2565123f, 0.0006081111f, 0.0f,
                              0.1376347f,  0.07798871f, 0.08172507f, 0.2696539f, 0.3679937f,    0.0005996693f,
                              0.05247637f, 0.05130715f, 0.3661833f,  0.2363871f, 0.001229736f,  0.0f});
}

TEST(HdrFlip, GivesThemOfImagesMoreThanHalfBlackOnceTheExposuresAreFixed) {
  test::expect_published_map(hdr_flip(test::mostly_black(test::formula_test),
                                      test::mostly_black(test::formula_reference), {-3.0, 3.0, 6}),
                             0.0478929122, {0.5006707f, 0.1861558f,  0.1273607f,  0.0001948307f, 0.0f, 0.0f,
                                            0.2166626f, 0.1276374f,  0.09750459f, 0.0001502839f, 0.0f, 0.0f,
                                            0.1639453f, 0.07978558f, 0.08438831f, 0.000144327f,  0.0f, 0.0f,
                                            0.0535919f, 0.05061848f, 0.3516752f,  0.002531485f,  0.0f, 0.0f});
}

TEST(HdrFlip, IsTheWorstOfItsExposuresPixelByPixel) {
  const auto x = test::high_range(test::formula_test), r = test::high_range(test::formula_reference);
  const Image2D<float> low = hdr_flip(x, r, {-2.0, -2.0, 1}), high = hdr_flip(x, r, {1.0, 1.0, 1}),
                       both = hdr_flip(x, r, {-2.0, 1.0, 2});
  for (size_t i = 0; i < both.size(); ++i) ASSERT_EQ(both[i], std::max(low[i], high[i]));
}

TEST(HdrFlip, DoesNotDependOnTheUnitOfRadiance) {
  const auto x = test::high_range(test::formula_test), r = test::high_range(test::formula_reference);
  Image2D<vec3> small_x = x, small_r = r;
  for (vec3& v : small_x) v *= 0x1p-20f;
  for (vec3& v : small_r) v *= 0x1p-20f;
  // Powers of two scale exactly, but for the rounding of 2^stops.
  EXPECT_NEAR(mean_error(hdr_flip(small_x, small_r, flip_exposures(small_r))),
              mean_error(hdr_flip(x, r, flip_exposures(r))), 1e-6);
}

TEST(HdrFlip, TakesTheBrightestFloatsAndBlackImages) {
  const FlipExposures stops{0.0, 20.0, 5};
  for (const float e : hdr_flip(flat(std::numeric_limits<float>::max()), flat(1e30f), stops))
    ASSERT_EQ(e, 0.0f);
  for (const float e : hdr_flip(flat(0.0f), flat(0.0f), stops)) ASSERT_EQ(e, 0.0f);
  // Black against white, as LDR-FLIP.
  EXPECT_NEAR(mean_error(hdr_flip(flat(0.0f), flat(1e30f), stops)), 0.967379761, test::kFlipTolerance);
}

TEST(HdrFlip, IsTheSameAtAnyThreadCount) {
  const auto x = test::high_range(test::formula_test), r = test::high_range(test::formula_reference);
  const Image2D<float> many = hdr_flip(x, r, flip_exposures(r));
  const ThreadLimit limit(1);
  const Image2D<float> one = hdr_flip(x, r, flip_exposures(r));
  for (size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i], many[i]);
}

TEST(HdrFlip, RefusesWhatCannotBeCompared) {
  const FlipExposures good{0.0, 1.0, 2};
  const double endless = std::numeric_limits<double>::infinity();
  EXPECT_THROW(hdr_flip(flat(1.0f), flat(1.0f, 15, 20), good), InputError) << "size";
  EXPECT_THROW(hdr_flip({}, {}, good), InputError) << "no pixels";
  for (const FlipExposures& bad :
       {FlipExposures{1.0, 0.0, 2}, {0.0, 1.0, 0}, {0.0, endless, 2}, {-endless, 0.0, 2}})
    EXPECT_THROW(hdr_flip(flat(1.0f), flat(1.0f), bad), InputError);
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f}) {
    Image2D<vec3> image = flat(0.5f);
    image(0, 14).x = bad;
    EXPECT_THROW(hdr_flip(image, flat(1.0f), good), InputError);
    EXPECT_THROW(hdr_flip(flat(1.0f), image, good), InputError);
  }
}

}  // namespace
}  // namespace hybray::metrics
