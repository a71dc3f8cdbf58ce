#include "core/metrics/magma.h"

#include "core/base/develop.h"
#include "core/base/vec.h"

#include <cmath>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

TEST(Magma, IsThePublishedTableToOneHundredth) {
  // Of the 256 colours in matplotlib's _cm_listed.py, CC0; between the own knots, where straight lines are
  // worst.
  struct Entry {
    int index;
    vec3 color;
  };
  for (const Entry& e : {Entry{0, {0.001462f, 0.000466f, 0.013866f}},
                         {8, {0.013708f, 0.011771f, 0.068667f}},
                         {26, {0.083446f, 0.056225f, 0.220755f}},
                         {42, {0.171713f, 0.067305f, 0.370771f}},
                         {60, {0.291366f, 0.064553f, 0.475462f}},
                         {77, {0.396467f, 0.102902f, 0.502658f}},
                         {94, {0.500438f, 0.143719f, 0.507920f}},
                         {111, {0.607238f, 0.179779f, 0.499492f}},
                         {128, {0.716387f, 0.214982f, 0.475290f}},
                         {145, {0.822926f, 0.259016f, 0.433573f}},
                         {162, {0.913354f, 0.330052f, 0.382563f}},
                         {178, {0.965549f, 0.432519f, 0.359529f}},
                         {196, {0.990138f, 0.565296f, 0.395122f}},
                         {213, {0.997077f, 0.690088f, 0.471811f}},
                         {230, {0.995680f, 0.812706f, 0.572645f}},
                         {247, {0.989815f, 0.934329f, 0.690198f}},
                         {255, {0.987053f, 0.991438f, 0.749504f}}}) {
    const auto rgb = magma(Image2D<float>(1, 1, static_cast<float>(e.index) / 255.0f));
    ASSERT_EQ(rgb.size(), 3u);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(static_cast<float>(rgb[static_cast<size_t>(c)]) / 255.0f, e.color[c], 0.01f + 0.5f / 255.0f)
          << e.index;
  }
}

TEST(Magma, GrowsBrighterEverywhere) {
  Image2D<float> ramp(256, 1);
  for (int i = 0; i < 256; ++i) ramp(i, 0) = static_cast<float>(i) / 255.0f;
  const auto rgb = magma(ramp);
  float before = -1.0f;
  for (size_t i = 0; i < 256; i += 4) {
    vec3 linear;
    for (int c = 0; c < 3; ++c)
      linear[c] = std::pow(static_cast<float>(rgb[3 * i + static_cast<size_t>(c)]) / 255.0f, 2.2f);
    EXPECT_GT(luminance(linear), before) << i;
    before = luminance(linear);
  }
}

TEST(Magma, ClampsWhatLiesOutside) {
  EXPECT_EQ(magma(Image2D<float>(1, 1, -3.0f)), magma(Image2D<float>(1, 1, 0.0f)));
  EXPECT_EQ(magma(Image2D<float>(1, 1, 7.0f)), magma(Image2D<float>(1, 1, 1.0f)));
  EXPECT_TRUE(magma({}).empty());
}

}  // namespace
}  // namespace hybray::metrics
