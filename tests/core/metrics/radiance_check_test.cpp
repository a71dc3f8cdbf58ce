#include "core/metrics/radiance_check.h"

#include "core/base/error.h"

#include <limits>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

std::string refusal(const Image2D<vec3>& image) {
  try {
    require_radiance(image, "out.exr");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RadianceCheck, AcceptsZeroAndTheLargestFloat) {
  EXPECT_EQ(refusal(Image2D<vec3>(3, 2, vec3(0.0f, -0.0f, std::numeric_limits<float>::max()))), "");
}

TEST(RadianceCheck, NamesTheFirstPixelThatIsNotRadiance) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity, -1e-30f})
    for (int channel = 0; channel < 3; ++channel) {
      Image2D<vec3> image(40, 50, vec3(1.0f));
      image(39, 49)[channel] = bad;
      image(17, 31)[channel] = bad;
      image(23, 31)[channel] = bad;
      EXPECT_TRUE(refusal(image).starts_with("out.exr: pixel (17, 31) is (")) << refusal(image);
    }
}

TEST(RadianceCheck, RefusesAnImageWithoutPixels) {
  EXPECT_EQ(refusal({}), "out.exr: the image has no pixels");
}

TEST(RadianceCheck, SaysBothSizesWhereTheyDiffer) {
  try {
    require_size(Image2D<vec3>(3, 2), "image", 2, 3, "the reference");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "image: it is 3 x 2 pixels, but the reference is 2 x 3");
  }
}

}  // namespace
}  // namespace hybray::metrics
