#include "core/metrics/image_batches.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/metrics/random_images.h"

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

TEST(ImageBatches, GiveTheMeanAndTheVarianceOfTheMeanOfKnownNumbers) {
  ImageBatches batches(2, 1);
  for (float x : {2.0f, 4.0f, 4.0f, 6.0f}) {
    Image2D<vec3> image(2, 1, vec3(7.0f));
    image(1, 0) = vec3(x, 10.0f * x, 1.0f);
    batches.add(image);
  }
  EXPECT_EQ(batches.count(), 4);
  // Sum of squared deviations 8, sample variance 8/3, of the mean 8/12.
  const Image2D<vec3> mean = batches.mean(), variance = batches.variance_of_mean();
  EXPECT_EQ(mean(0, 0), vec3(7.0f));
  EXPECT_EQ(variance(0, 0), vec3(0.0f));
  EXPECT_EQ(mean(1, 0), vec3(4.0f, 40.0f, 1.0f));
  EXPECT_FLOAT_EQ(variance(1, 0).x, 8.0f / 12.0f);
  EXPECT_FLOAT_EQ(variance(1, 0).y, 800.0f / 12.0f);
  EXPECT_EQ(variance(1, 0).z, 0.0f);
}

TEST(ImageBatches, KeepSmallVarianceOverALargeMean) {
  // A sum of squares in double would lose it: 1e10^2 has no room for deviations of 1024 squared times 2^-53.
  ImageBatches batches(1, 1);
  for (float sign : {-1.0f, 1.0f, -1.0f, 1.0f})
    batches.add(Image2D<vec3>(1, 1, vec3(0x1p33f + sign * 1024.0f)));
  EXPECT_FLOAT_EQ(batches.variance_of_mean()(0, 0).x, 4.0f * 1024.0f * 1024.0f / 12.0f);
}

TEST(ImageBatches, MergedInOrderAreTheBatchesAddedOneByOne) {
  constexpr int kCount = 11;
  ImageBatches all(9, 7);
  for (uint32_t i = 0; i < kCount; ++i) all.add(test::gaussian_image(9, 7, 50.0, 3.0, i, 5));
  for (uint32_t split : {0u, 1u, 4u, 11u}) {
    ImageBatches first(9, 7), second(9, 7);
    for (uint32_t i = 0; i < kCount; ++i)
      (i < split ? first : second).add(test::gaussian_image(9, 7, 50.0, 3.0, i, 5));
    first.merge(second);
    ASSERT_EQ(first.count(), kCount);
    for (size_t i = 0; i < 63; ++i)
      for (int c = 0; c < 3; ++c) {
        EXPECT_FLOAT_EQ(first.mean()[i][c], all.mean()[i][c]);
        EXPECT_FLOAT_EQ(first.variance_of_mean()[i][c], all.variance_of_mean()[i][c]);
      }
  }
}

TEST(ImageBatches, EstimateTheVarianceOfTheMeanWithoutBias) {
  // 60 x 60 x 3 estimates, each of sigma^2 / n with relative standard deviation sqrt(2 / (n - 1)).
  constexpr int kCount = 5;
  constexpr double kSigma = 2.0;
  ImageBatches batches(60, 60);
  for (uint32_t i = 0; i < kCount; ++i) batches.add(test::gaussian_image(60, 60, 50.0, kSigma, i, 6));
  double sum = 0.0;
  const Image2D<vec3> variance = batches.variance_of_mean();
  for (const vec3& v : variance) sum += double{v.x} + double{v.y} + double{v.z};
  const double expected = kSigma * kSigma / kCount, n = 3.0 * 60 * 60;
  EXPECT_NEAR(sum / n, expected, 4.0 * expected * std::sqrt(2.0 / (kCount - 1) / n));
}

TEST(ImageBatches, RefuseWhatIsNotAnotherEstimateOfTheSameImage) {
  ImageBatches batches(4, 3);
  EXPECT_THROW(batches.mean(), InputError);
  EXPECT_THROW(batches.add(Image2D<vec3>(3, 4)), InputError);
  EXPECT_THROW(batches.add(Image2D<vec3>(4, 3, vec3(-1.0f))), InputError);
  EXPECT_EQ(batches.count(), 0);
  batches.add(Image2D<vec3>(4, 3, vec3(1.0f)));
  EXPECT_THROW(batches.variance_of_mean(), InputError) << "one batch says nothing of its variance";
  EXPECT_THROW(batches.merge(ImageBatches(3, 4)), InputError);
  EXPECT_THROW(ImageBatches(0, 4), InputError);
}

}  // namespace
}  // namespace hybray::metrics
