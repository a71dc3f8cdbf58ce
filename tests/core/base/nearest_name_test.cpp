#include "core/base/nearest_name.h"

#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

const std::vector<std::string> kKnown = {"camera", "cameras", "resolution", "scene", "mirror_depth"};

TEST(NearestName, OneEditOfEachKindIsFound) {
  EXPECT_EQ(nearest_name("scne", kKnown), "scene");    // left out
  EXPECT_EQ(nearest_name("scenee", kKnown), "scene");  // added
  EXPECT_EQ(nearest_name("scane", kKnown), "scene");   // replaced
  EXPECT_EQ(nearest_name("secne", kKnown), "scene");   // swapped
  EXPECT_EQ(nearest_name("SCENE", kKnown), "scene");   // another case
  EXPECT_EQ(nearest_name("miror_dephts", kKnown), "mirror_depth");
}

TEST(NearestName, TheNearerOfTwoWins) {
  EXPECT_EQ(nearest_name("camera", kKnown), "camera");
  EXPECT_EQ(nearest_name("cameraz", kKnown), "camera");
  EXPECT_EQ(nearest_name("camerass", kKnown), "cameras");
}

TEST(NearestName, NothingIsSaidWhereNothingIsNear) {
  EXPECT_EQ(nearest_name("tessellation", kKnown), "");
  EXPECT_EQ(nearest_name("", kKnown), "");
  EXPECT_EQ(nearest_name("scene", {}), "");
}

}  // namespace
}  // namespace hybray
