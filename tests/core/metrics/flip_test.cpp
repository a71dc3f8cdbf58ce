// Truth: the authors' own implementation, flip-evaluator 1.7 (PyPI), on images that both sides compute alike
// (formula_images.h): evaluate(reference, test, "LDR", inputsRGB=False, applyMagma=False, parameters={"ppd":
// ...}).
#include "core/metrics/flip.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/metrics/formula_images.h"
#include "tests/core/metrics/published_map.h"

#include <limits>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

Image2D<vec3> flat(const vec3& color, int width = 24, int height = 17) {
  return {width, height, color};
}

TEST(Flip, GivesTheErrorsOfTheAuthorsImplementation) {
  test::expect_published_map(
      flip(test::display_range(test::formula_test), test::display_range(test::formula_reference)),
      0.124452876, {0.4347045f,  0.1287008f,  0.1744252f,  0.1125035f, 0.0002679986f, 0.0f,
                    0.1434018f,  0.0736387f,  0.1001508f,  0.2477395f, 0.0005591149f, 0.0f,
                    0.1366004f,  0.09004826f, 0.08619156f, 0.2504621f, 0.6401042f,    0.0003170123f,
                    0.06407212f, 0.07597352f, 0.2417232f,  0.2851279f, 0.001780974f,  0.0f});
}

TEST(Flip, GivesThemAlsoFromFarAway) {
  test::expect_published_map(
      flip(test::display_range(test::formula_test), test::display_range(test::formula_reference), 25.0),
      0.162031554,
      {0.5828694f, 0.2566248f, 0.1134996f,  0.0827511f, 0.0f,       0.0f,       0.4350475f,  0.1640958f,
       0.1281353f, 0.381039f,  0.0f,        0.0f,       0.3054815f, 0.151187f,  0.09805513f, 0.3444401f,
       0.7324615f, 0.0f,       0.08167855f, 0.1171941f, 0.1876898f, 0.2944551f, 0.0f,        0.0f});
}

TEST(Flip, OfConstantImagesIsTheDifferenceOfTheirColors) {
  const auto error = [](const vec3& a, const vec3& b) {
    const Image2D<float> map = flip(flat(a), flat(b));
    for (const float e : map) EXPECT_NEAR(e, map[0], test::kFlipTolerance);
    return mean_error(map);
  };
  // HyAB of Hunt-adjusted L*a*b*, its power, the knee: by hand in double. flip-evaluator 1.7: 0.967395365,
  // 0.478361428, 0.986679077, 0.0847396404.
  EXPECT_NEAR(error(vec3(0.0f), vec3(1.0f)), 0.967379761, test::kFlipTolerance);
  EXPECT_NEAR(error({0.25f, 0.5f, 0.75f}, vec3(0.5f)), 0.478328763, test::kFlipTolerance);
  EXPECT_NEAR(error({1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}), 0.986662275, test::kFlipTolerance);
  EXPECT_NEAR(error(vec3(0.1f), vec3(0.11f)), 0.084724053, test::kFlipTolerance);
  // By definition: no colours of a display are further apart (paper, Section 4).
  EXPECT_NEAR(error({0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}), 1.0, test::kFlipTolerance);
}

TEST(Flip, IsZeroForTheSameImageAndTheSameBothWays) {
  const auto a = test::display_range(test::formula_test), b = test::display_range(test::formula_reference);
  for (const float e : flip(a, a)) ASSERT_EQ(e, 0.0f);
  const Image2D<float> ab = flip(a, b), ba = flip(b, a);
  for (size_t i = 0; i < ab.size(); ++i) ASSERT_EQ(ab[i], ba[i]);
}

TEST(Flip, TakesWhatIsBrighterThanWhiteForWhiteAndBlackForBlack) {
  for (const float e : flip(flat(vec3(100.0f)), flat(vec3(1.0f)))) ASSERT_EQ(e, 0.0f);
  for (const float e : flip(flat(vec3(std::numeric_limits<float>::max())), flat(vec3(1.0f))))
    ASSERT_EQ(e, 0.0f);
  for (const float e : flip(flat(vec3(0.0f)), flat(vec3(0.0f)))) ASSERT_EQ(e, 0.0f);
}

TEST(Flip, WorksOnImagesSmallerThanItsFilters) {
  EXPECT_NEAR(mean_error(flip(flat(vec3(0.0f), 1, 1), flat(vec3(1.0f), 1, 1))), 0.967379761,
              test::kFlipTolerance);
  EXPECT_NEAR(mean_error(flip(flat(vec3(0.0f), 3, 200), flat(vec3(1.0f), 3, 200))), 0.967379761,
              test::kFlipTolerance);
}

TEST(Flip, IsTheSameAtAnyThreadCount) {
  const auto a = test::display_range(test::formula_test), b = test::display_range(test::formula_reference);
  const Image2D<float> many = flip(a, b);
  const ThreadLimit limit(1);
  const Image2D<float> one = flip(a, b);
  for (size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i], many[i]);
  EXPECT_EQ(mean_error(one), mean_error(many));
}

TEST(Flip, RefusesWhatCannotBeCompared) {
  EXPECT_THROW(flip(flat(vec3(0.5f)), flat(vec3(0.5f), 17, 24)), InputError) << "size";
  EXPECT_THROW(flip({}, {}), InputError) << "no pixels";
  EXPECT_THROW(flip(flat(vec3(0.5f)), flat(vec3(0.5f)), 0.0), InputError) << "no display";
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f}) {
    Image2D<vec3> image = flat(vec3(0.5f));
    image(23, 16).z = bad;
    EXPECT_THROW(flip(image, flat(vec3(0.5f))), InputError);
    EXPECT_THROW(flip(flat(vec3(0.5f)), image), InputError);
  }
}

}  // namespace
}  // namespace hybray::metrics
