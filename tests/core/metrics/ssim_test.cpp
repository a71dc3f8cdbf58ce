#include "core/metrics/ssim.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/metrics/formula_images.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

Image2D<vec3> flat(float value, int width = 20, int height = 15) {
  return {width, height, vec3(value)};
}

// scikit-image 0.26.0 in double: structural_similarity(..., gaussian_weights=True, sigma=1.5,
// use_sample_covariance=False, channel_axis=2), which leaves out the same border; sums in another order.
TEST(Ssim, IsThatOfScikitImage) {
  const auto x = test::display_range(test::formula_test), r = test::display_range(test::formula_reference);
  EXPECT_NEAR(ssim(x, r, 1.0), 0.874021883106793, 1e-12);
  EXPECT_NEAR(ssim(x, r, 2.0), 0.91406624691019, 1e-12);
}

TEST(Ssim, OfConstantImagesIsItsClosedForm) {
  // No variance: (2 x r + C1) / (x^2 + r^2 + C1), C1 = 1e-4.
  EXPECT_NEAR(ssim(flat(0.25f), flat(0.5f)), (0.25 + 1e-4) / (0.0625 + 0.25 + 1e-4), 1e-12);
  EXPECT_NEAR(ssim(flat(0.0f), flat(1.0f)), 1e-4 / (1.0 + 1e-4), 1e-12);
  EXPECT_DOUBLE_EQ(ssim(flat(0.0f), flat(0.0f)), 1.0);
}

TEST(Ssim, IsOneForTheSameImageAndTheSameBothWays) {
  const auto x = test::display_range(test::formula_test), r = test::display_range(test::formula_reference);
  EXPECT_DOUBLE_EQ(ssim(x, x), 1.0);
  EXPECT_DOUBLE_EQ(ssim(x, r), ssim(r, x));
}

TEST(Ssim, OfOneWindowIsThatOfItsMoments) {
  // One pixel of 11 x 11 is lit, in the middle: its weight is the middle one's square.
  Image2D<vec3> x(11, 11), r(11, 11, vec3(0.0f));
  x(5, 5) = vec3(1.0f);
  double sum = 0.0;
  for (int i = -5; i <= 5; ++i) sum += std::exp(-i * i / 4.5);
  const double w = 1.0 / (sum * sum), c1 = 1e-4, c2 = 9e-4;
  EXPECT_NEAR(ssim(x, r), c1 / (w * w + c1) * c2 / (w - w * w + c2), 1e-12);
}

TEST(Psnr, IsThatOfScikitImageAndItsClosedForm) {
  const auto x = test::display_range(test::formula_test), r = test::display_range(test::formula_reference);
  EXPECT_NEAR(psnr(x, r), 25.1505333230189, 1e-11);  // scikit-image 0.26.0: peak_signal_noise_ratio
  EXPECT_NEAR(psnr(flat(0.25f), flat(0.5f)), 20.0 * std::log10(4.0), 1e-12);
  EXPECT_NEAR(psnr(flat(0.25f), flat(0.5f), 10.0), 20.0 * std::log10(40.0), 1e-12);
  EXPECT_NEAR(psnr(flat(0.25f, 1, 1), flat(0.5f, 1, 1)), 20.0 * std::log10(4.0), 1e-12);
}

TEST(Psnr, OfTheSameImageIsInfinite) {
  EXPECT_EQ(psnr(flat(0.5f), flat(0.5f)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(psnr(flat(0.0f), flat(0.0f)), std::numeric_limits<double>::infinity());
}

TEST(SsimAndPsnr, AreTheSameAtAnyThreadCount) {
  const auto x = test::display_range(test::formula_test), r = test::display_range(test::formula_reference);
  const double many_ssim = ssim(x, r), many_psnr = psnr(x, r);
  const ThreadLimit limit(1);
  EXPECT_EQ(ssim(x, r), many_ssim);
  EXPECT_EQ(psnr(x, r), many_psnr);
}

TEST(SsimAndPsnr, RefuseWhatCannotBeCompared) {
  EXPECT_THROW(ssim(flat(1.0f, 10, 30), flat(1.0f, 10, 30)), InputError) << "smaller than a window";
  for (const auto metric : {ssim, psnr}) {
    EXPECT_THROW(metric(flat(1.0f), flat(1.0f, 15, 20), 1.0), InputError) << "size";
    EXPECT_THROW(metric({}, {}, 1.0), InputError) << "no pixels";
    for (double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
      EXPECT_THROW(metric(flat(1.0f), flat(1.0f), bad), InputError);
    for (float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f}) {
      Image2D<vec3> image = flat(0.5f);
      image(0, 14).x = bad;
      EXPECT_THROW(metric(image, flat(1.0f), 1.0), InputError);
      EXPECT_THROW(metric(flat(1.0f), image, 1.0), InputError);
    }
  }
}

}  // namespace
}  // namespace hybray::metrics
