#include "core/base/develop.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(Filmic, IsNarkowiczsFitAndWhiteAtMost) {
  EXPECT_EQ(filmic(0.0f), 0.0f);
  EXPECT_NEAR(filmic(0.18f), 0.18 * (2.51 * 0.18 + 0.03) / (0.18 * (2.43 * 0.18 + 0.59) + 0.14), 1e-6);
  EXPECT_EQ(filmic(std::numeric_limits<float>::max()), 1.0f);
  EXPECT_EQ(filmic(std::numeric_limits<float>::infinity()), 1.0f);
  for (float x = 0.0f; x < 20.0f; x += 0.01f) ASSERT_LE(filmic(x), filmic(x + 0.01f)) << x;
}

TEST(DisplayImage, RoundsToWhatIsDeveloped) {
  Image2D<vec3> image(256, 1);
  for (int x = 0; x < 256; ++x) image(x, 0) = vec3(static_cast<float>(x) * 0.01f, 0.0f, 1e30f);
  const Image2D<vec3> shown = display_image(image, 0.7f);
  const auto bytes = develop(image, 0.7f);
  for (size_t i = 0; i < image.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(std::lround(255.0f * shown[i][c]), bytes[3 * i + static_cast<size_t>(c)]);
  EXPECT_EQ(shown(0, 0).x, 0.0f);
  EXPECT_NEAR(shown(0, 0).z, 1.0f, 1e-6f);
}

}  // namespace
}  // namespace hybray
