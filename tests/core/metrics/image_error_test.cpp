#include "core/metrics/image_error.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/metrics/random_images.h"

#include <limits>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

Image2D<vec3> flat(float value, int width = 16, int height = 9) {
  return {width, height, vec3(value)};
}

TEST(ImageError, OfConstantImagesIsItsClosedForm) {
  // x = 3, r = 2: e = 0.02^2, (x - r)^2 / (r^2 + e) = 1 / 4.0004.
  const ImageError error = image_error(flat(3.0f), {flat(2.0f), flat(0.5f)});
  EXPECT_NEAR(error.relmse, 1.0 / 4.0004, 1e-15);
  EXPECT_NEAR(error.reference_relmse, 0.5 / 4.0004, 1e-15);
  EXPECT_NEAR(error.relmse_debiased(), 0.5 / 4.0004, 1e-15);
  EXPECT_DOUBLE_EQ(error.energy_ratio, 1.5);
  EXPECT_DOUBLE_EQ(error.rmse, 1.0);
  EXPECT_DOUBLE_EQ(error.smape, 0.2);  // 1 / (3 + 2)
  EXPECT_DOUBLE_EQ(error.lit_fraction, 1.0);
  EXPECT_DOUBLE_EQ(error.median_relative_error, 0.5);
}

TEST(ImageError, DoesNotDependOnTheUnit) {
  const Image2D<vec3> x = test::gaussian_image(31, 17, 9.0, 1.0, 0, 1),
                      r = test::gaussian_image(31, 17, 10.0, 1.0, 1, 1);
  Image2D<vec3> scaled_x = x, scaled_r = r;
  for (vec3& v : scaled_x) v *= 0x1p-40f;
  for (vec3& v : scaled_r) v *= 0x1p-40f;
  const ImageError error = image_error(x, {r, {}}), scaled = image_error(scaled_x, {scaled_r, {}});
  EXPECT_DOUBLE_EQ(error.relmse, scaled.relmse);
  EXPECT_DOUBLE_EQ(error.smape, scaled.smape);
  EXPECT_DOUBLE_EQ(error.median_relative_error, scaled.median_relative_error);
  EXPECT_DOUBLE_EQ(error.rmse * 0x1p-40, scaled.rmse);
}

TEST(ImageError, FloorsTheDenominatorWhereTheReferenceIsBlack) {
  // One of 4 pixels is lit with 4: mean 1, e = 1e-4. A black pixel that gets 0.01 counts 1e-4 / 1e-4 = 1.
  Image2D<vec3> r(2, 2, vec3(0.0f)), x(2, 2, vec3(0.0f));
  r(1, 1) = x(1, 1) = vec3(4.0f);
  x(0, 0) = vec3(0.01f);
  EXPECT_NEAR(image_error(x, {r, {}}).relmse, 0.25, 0.25 * 2 * 0x1p-24);  // 0.01f is rounded
  EXPECT_DOUBLE_EQ(image_error(x, {r, {}}).lit_fraction, 0.25);
  EXPECT_DOUBLE_EQ(image_error(x, {r, {}}).median_relative_error, 0.0);
}

TEST(ImageError, CountsWhatIsBlackInOneImageAloneAsAWholeSymmetricErrorAndInBothAsNone) {
  // Pixels (x, r): (0, 0), (0, 1), (3, 1), (2, 0), in the red channel; nothing in the others.
  Image2D<vec3> x(2, 2, vec3(0.0f)), r(2, 2, vec3(0.0f));
  r(1, 0).x = r(0, 1).x = 1.0f;
  x(0, 1).x = 3.0f;
  x(1, 1).x = 2.0f;
  EXPECT_DOUBLE_EQ(image_error(x, {r, {}}).smape, (1.0 + 0.5 + 1.0) / 12.0);
  Image2D<uint8_t> mask(2, 2, 1);
  mask(1, 1) = 0;
  EXPECT_DOUBLE_EQ(image_error(x, {r, {}}, &mask).smape, 1.5 / 9.0);
}

TEST(ImageError, OfGaussianNoiseIsItsExpectation) {
  // x = mu (1 + s z): E relmse = s^2 / (1 + 1e-4); its standard error sqrt(2 / n) relative.
  constexpr double kMean = 5.0, kNoise = 0.1;
  const Image2D<vec3> x = test::gaussian_image(200, 150, kMean, kNoise * kMean, 0, 2);
  const double expected = kNoise * kNoise / 1.0001, n = 3.0 * 200 * 150;
  EXPECT_NEAR(image_error(x, {flat(kMean, 200, 150), {}}).relmse, expected,
              4.0 * expected * std::sqrt(2.0 / n));
}

TEST(ImageError, AgainstANoisyReferenceIsRaisedByTheReferencesOwn) {
  // Truth is mu everywhere; x has relative noise s, the mean of n batches t / sqrt(n). The relative second
  // order, 3 t^2 / n (docs/metrics.md), is 0.3 %.
  constexpr double kMean = 5.0, kNoise = 0.1, kReferenceNoise = 0.1;
  constexpr int kBatches = 10, kWidth = 200, kHeight = 150;
  ImageBatches batches(kWidth, kHeight);
  for (uint32_t i = 0; i < kBatches; ++i)
    batches.add(test::gaussian_image(kWidth, kHeight, kMean, kReferenceNoise * kMean, i, 3));
  const ImageError error =
      image_error(test::gaussian_image(kWidth, kHeight, kMean, kNoise * kMean, 99, 3), batches.reference());
  const double own = kReferenceNoise * kReferenceNoise / kBatches, truth = kNoise * kNoise;
  const double deviation = 4.0 * std::sqrt(2.0 / (3.0 * kWidth * kHeight));
  EXPECT_NEAR(error.reference_relmse, own, own * (0.003 + deviation));
  EXPECT_NEAR(error.relmse, truth + own, (truth + own) * (0.003 + deviation));
  EXPECT_NEAR(error.relmse_debiased(), truth, (truth + own) * (0.003 + deviation));
  EXPECT_FALSE(error.at_floor());
}

TEST(ImageError, BelowThreeTimesTheReferencesOwnIsAtTheFloor) {
  EXPECT_TRUE(image_error(flat(2.1f), {flat(2.0f), flat(0.0034f)}).at_floor());   // 0.01 against 0.0102
  EXPECT_FALSE(image_error(flat(2.1f), {flat(2.0f), flat(0.0033f)}).at_floor());  // 0.01 against 0.0099
  EXPECT_FALSE(image_error(flat(2.0f), {flat(2.0f), {}}).at_floor()) << "an exact reference has no floor";
}

TEST(ImageError, ComparesOnlyWhereTheMaskIsSetButTakesTheFloorFromTheWholeReference) {
  Image2D<vec3> x = flat(1.0f), r = flat(1.0f);
  Image2D<uint8_t> mask(16, 9, 1);
  x(3, 2) = vec3(1000.0f);
  x(4, 5) = vec3(2.0f);
  mask(3, 2) = 0;
  const ImageError error = image_error(x, {r, flat(0.1f)}, &mask);
  EXPECT_NEAR(error.relmse, 1.0 / 1.0001 / 143.0, 1e-15);
  EXPECT_NEAR(error.reference_relmse, 0.1f / 1.0001, 1e-15);
  EXPECT_DOUBLE_EQ(error.energy_ratio, 144.0 / 143.0);
  r(3, 2) = vec3(1441.0f);  // the reference's mean becomes 11, e = 0.0121
  EXPECT_NEAR(image_error(x, {r, {}}, &mask).relmse, 1.0 / 1.0121 / 143.0, 1e-12);
}

TEST(ImageError, IsTheSameAtAnyThreadCount) {
  const Image2D<vec3> x = test::gaussian_image(101, 77, 5.0, 1.0, 0, 4),
                      r = test::gaussian_image(101, 77, 5.0, 1.0, 1, 4);
  ImageError one;
  {
    const ThreadLimit limit(1);
    one = image_error(x, {r, r});
  }
  const ImageError many = image_error(x, {r, r});
  EXPECT_EQ(one.relmse, many.relmse);
  EXPECT_EQ(one.reference_relmse, many.reference_relmse);
  EXPECT_EQ(one.energy_ratio, many.energy_ratio);
  EXPECT_EQ(one.rmse, many.rmse);
  EXPECT_EQ(one.smape, many.smape);
}

TEST(ImageError, RefusesWhatMustNotBeAveraged) {
  const ReferenceImage good{flat(1.0f), flat(0.1f)};
  EXPECT_THROW(image_error(flat(1.0f, 9, 16), good), InputError) << "size";
  EXPECT_THROW(image_error({}, good), InputError) << "no pixels";
  EXPECT_THROW(image_error(flat(1.0f), {flat(0.0f), {}}), InputError) << "black reference";
  EXPECT_THROW(image_error(flat(1.0f), {flat(1.0f), flat(0.1f, 9, 16)}), InputError)
      << "size of the variance";
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f}) {
    Image2D<vec3> image = flat(1.0f);
    image(15, 8).y = bad;
    EXPECT_THROW(image_error(image, good), InputError);
    EXPECT_THROW(image_error(flat(1.0f), {image, {}}), InputError);
    EXPECT_THROW(image_error(flat(1.0f), {flat(1.0f), image}), InputError);
    Image2D<uint8_t> mask(16, 9, 1);
    mask(15, 8) = 0;
    EXPECT_THROW(image_error(image, good, &mask), InputError) << "outside the mask too";
  }
  const Image2D<uint8_t> nothing(16, 9, 0), other_size(9, 16, 1);
  EXPECT_THROW(image_error(flat(1.0f), good, &nothing), InputError);
  EXPECT_THROW(image_error(flat(1.0f), good, &other_size), InputError);
}

}  // namespace
}  // namespace hybray::metrics
