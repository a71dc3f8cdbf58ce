#include "core/metrics/error_bootstrap.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/metrics/image_error.h"
#include "tests/core/metrics/random_images.h"

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

constexpr int kWidth = 12, kHeight = 10;
constexpr double kMean = 5.0;

std::vector<Image2D<vec3>> noisy(int count, double sigma, uint32_t first, uint64_t seed) {
  std::vector<Image2D<vec3>> images;
  for (int i = 0; i < count; ++i)
    images.push_back(
        test::gaussian_image(kWidth, kHeight, kMean, sigma, first + static_cast<uint32_t>(i), seed));
  return images;
}

ReferenceImage reference_of(const std::vector<Image2D<vec3>>& batches) {
  ImageBatches sum(kWidth, kHeight);
  for (const auto& batch : batches) sum.add(batch);
  return sum.reference();
}

TEST(ErrorBootstrap, GivesTheValuesOfTheImageErrors) {
  const auto batches = noisy(7, 0.5, 100, 1), images = noisy(4, 1.0, 0, 1);
  Image2D<uint8_t> mask(kWidth, kHeight, 1);
  mask(3, 4) = mask(7, 1) = 0;
  for (const Image2D<uint8_t>* m : {static_cast<const Image2D<uint8_t>*>(nullptr), &std::as_const(mask)}) {
    ErrorBootstrap bootstrap(batches, m);
    double relmse = 0.0, energy = 0.0;
    for (const auto& image : images) {
      bootstrap.add(image);
      const ImageError error = image_error(image, reference_of(batches), m);
      relmse += error.relmse / 4.0;
      energy += error.energy_ratio / 4.0;
    }
    const ErrorIntervals result = bootstrap.intervals(1);
    const double own = image_error(images[0], reference_of(batches), m).reference_relmse;
    EXPECT_NEAR(result.relmse.value, relmse, 1e-12);
    EXPECT_NEAR(result.energy_ratio.value, energy, 1e-12);
    EXPECT_NEAR(result.reference_relmse, own, 1e-6 * own);  // the variance image is float
    EXPECT_DOUBLE_EQ(result.relmse_debiased.value, result.relmse.value - result.reference_relmse);
  }
}

TEST(ErrorBootstrap, ResamplesAsAveragingTheImagesAgainWould) {
  // Few enough that all resamples can be averaged here in full: 2 images, 2 batches, 16 equally likely draws.
  const auto batches = noisy(2, 0.5, 100, 2), images = noisy(2, 1.0, 0, 2);
  ErrorBootstrap bootstrap(batches);
  for (const auto& image : images) bootstrap.add(image);
  const ReferenceImage reference = reference_of(batches);
  const double e = relative_floor(reference.mean);
  double low = 1e300, high = -1e300;
  for (int draw = 0; draw < 16; ++draw) {
    const Image2D<vec3>*x[2] = {&images[draw & 1], &images[draw >> 1 & 1]},
          *r[2] = {&batches[draw >> 2 & 1], &batches[draw >> 3 & 1]};
    double sum = 0.0;
    for (size_t i = 0; i < reference.mean.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double r0 = (*r[0])[i][c], r1 = (*r[1])[i][c], mean = 0.5 * (r0 + r1), m = reference.mean[i][c];
        const double own = ((r0 - mean) * (r0 - mean) + (r1 - mean) * (r1 - mean)) / 2.0;
        for (const Image2D<vec3>* image : x) {
          const double apart = (*image)[i][c] - mean;
          sum += 0.5 * (apart * apart - own) / (m * m + e);
        }
      }
    low = std::min(low, sum / (3.0 * kWidth * kHeight));
    high = std::max(high, sum / (3.0 * kWidth * kHeight));
  }
  // Each of the 16 has probability 1/16, well above the 2.5 % at which the interval ends.
  const ErrorIntervals result = bootstrap.intervals(3);
  EXPECT_NEAR(result.relmse.low, low, 1e-7 * high);
  EXPECT_NEAR(result.relmse.high, high, 1e-7 * high);
}

TEST(ErrorBootstrap, IntervalsCoverTheTrueErrorAboutAsOftenAsTheySay) {
  // Truth is kMean; images are kMean + bias + noise, so that E relmse and the energy ratio are known. The
  // reference's noise is as large a part of the uncertainty as the images'.
  constexpr int kTrials = 300, kImages = 16, kBatches = 16;
  constexpr double kSigma = 0.4, kBias = 0.5, kReferenceSigma = 0.4;
  const double e = 1e-4 * kMean * kMean, weight = 1.0 / (kMean * kMean + e);
  const double error = weight * (kBias * kBias + kSigma * kSigma),
               raised = error + weight * kReferenceSigma * kReferenceSigma / kBatches,
               energy = 1.0 + kBias / kMean;
  int plain = 0, debiased = 0, ratio = 0;
  for (uint64_t trial = 0; trial < kTrials; ++trial) {
    const auto batches = noisy(kBatches, kReferenceSigma, 1000, 10 + trial);
    ErrorBootstrap bootstrap(batches);
    for (uint32_t i = 0; i < kImages; ++i)
      bootstrap.add(test::gaussian_image(kWidth, kHeight, kMean + kBias, kSigma, i, 10 + trial));
    const ErrorIntervals result = bootstrap.intervals(trial, 400);
    const auto covers = [](const Interval& i, double truth) { return i.low <= truth && truth <= i.high; };
    plain += covers(result.relmse, raised);
    debiased += covers(result.relmse_debiased, error);
    ratio += covers(result.energy_ratio, energy);
  }
  // A percentile interval of n draws is 1.96 sqrt((n - 1) / n) = 1.898 standard errors wide for n = 16, which
  // Student's t covers with 92.3 % at 15 degrees of freedom and 93.3 % at 30 (both sources equally
  // uncertain). Limits: four binomial standard errors, 1.49 %, about the middle.
  for (int covered : {plain, debiased, ratio}) {
    EXPECT_GT(covered, kTrials * (0.928 - 4 * 0.0149)) << plain << " " << debiased << " " << ratio;
    EXPECT_LT(covered, kTrials * (0.928 + 4 * 0.0149)) << plain << " " << debiased << " " << ratio;
  }
}

TEST(ErrorBootstrap, AgainstAnExactReferenceResamplesTheImagesOnly) {
  const Image2D<vec3> exact(kWidth, kHeight, vec3(kMean));
  ErrorBootstrap bootstrap = ErrorBootstrap::against_exact(exact);
  for (const auto& image : noisy(3, 0.0, 0, 1)) bootstrap.add(image);
  const ErrorIntervals same = bootstrap.intervals(1);
  for (double v : {same.relmse.low, same.relmse.value, same.relmse.high, same.reference_relmse})
    EXPECT_EQ(v, 0.0);
  for (double v : {same.energy_ratio.low, same.energy_ratio.value, same.energy_ratio.high})
    EXPECT_DOUBLE_EQ(v, 1.0);
  bootstrap.add(Image2D<vec3>(kWidth, kHeight, vec3(2 * kMean)));
  const ErrorIntervals other = bootstrap.intervals(1);
  EXPECT_DOUBLE_EQ(other.energy_ratio.value, 1.25);
  EXPECT_DOUBLE_EQ(other.energy_ratio.low, 1.0);  // the odd image left out: probability (3/4)^4 = 0.32
}

TEST(ErrorBootstrap, IsTheSameForASeedAtAnyThreadCount) {
  const auto batches = noisy(5, 0.5, 100, 4), images = noisy(5, 1.0, 0, 4);
  const auto result = [&](uint64_t seed) {
    ErrorBootstrap bootstrap(batches);
    for (const auto& image : images) bootstrap.add(image);
    return bootstrap.intervals(seed);
  };
  const ErrorIntervals many = result(7);
  const ThreadLimit limit(1);
  EXPECT_EQ(result(7).relmse.low, many.relmse.low);
  EXPECT_EQ(result(7).energy_ratio.high, many.energy_ratio.high);
  EXPECT_NE(result(8).energy_ratio.high, many.energy_ratio.high);
}

TEST(ErrorBootstrap, RefusesTooFewImagesAndBatchesAndWhatAnErrorRefuses) {
  const auto batches = noisy(3, 0.5, 100, 5);
  EXPECT_THROW(ErrorBootstrap(std::span(batches).first(1)), InputError);
  EXPECT_THROW(ErrorBootstrap(std::span(batches).first(0)), InputError);
  auto black = batches;
  black[1] = Image2D<vec3>(kWidth, kHeight, vec3(0.0f));
  EXPECT_THROW(ErrorBootstrap{black}, InputError);
  const Image2D<uint8_t> nothing(kWidth, kHeight, 0);
  EXPECT_THROW(ErrorBootstrap(batches, &nothing), InputError);
  ErrorBootstrap bootstrap(batches);
  EXPECT_THROW(bootstrap.add(Image2D<vec3>(kHeight, kWidth, vec3(1.0f))), InputError);
  EXPECT_THROW(bootstrap.add(Image2D<vec3>(kWidth, kHeight, vec3(-1.0f))), InputError);
  bootstrap.add(batches[0]);
  EXPECT_THROW(bootstrap.intervals(1), InputError);
}

}  // namespace
}  // namespace hybray::metrics
