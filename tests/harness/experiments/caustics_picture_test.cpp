// The pictures of `caustics`.
#include "tests/harness/experiments/caustics_fixture.h"

#include <algorithm>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace hybray {
namespace {

class CausticsPicture : public test::CausticsFixture {
 protected:
  // The pixels of a picture of the fixture's point; empty where there is no such file.
  std::vector<uint8_t> pixels(const std::string& what, const std::string& size = "64x36") const {
    const std::filesystem::path file =
        folder_ / ("out/pictures/glass_ball_front_" + size + "_0123456789abcdef_" + what + ".png");
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) return {};
    const OIIO::ImageSpec& spec = input->spec();
    EXPECT_EQ(std::to_string(spec.width) + "x" + std::to_string(spec.height), size);
    EXPECT_EQ(spec.nchannels, 3);
    std::vector<uint8_t> values(static_cast<size_t>(spec.width * spec.height * spec.nchannels));
    EXPECT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, values.data()));
    return values;
  }
  static bool is_black(const std::vector<uint8_t>& picture) {
    return std::all_of(picture.begin(), picture.end(), [](uint8_t v) { return v == 0; });
  }
};

TEST_F(CausticsPicture, IsWrittenOnlyWhenAskedFor) {
  run({{"camera", text("front")}});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CausticsPicture, ShowsTheSceneWithoutAndWithCausticsTheCausticsTheReferenceAndTheirDifference) {
  run({{"camera", text("front")},
       {"picture", true},
       {"rays_per_texel", 16.0},
       {"mirror_depth", int64_t{6}},
       {"reference_paths", 1e5}});
  const auto off = pixels("off"), on = pixels("on"), caustics = pixels("caustics"),
             reference = pixels("reference"), flip = pixels("flip");
  for (const auto* picture : {&off, &on, &caustics, &reference, &flip}) {
    ASSERT_EQ(picture->size(), 64u * 36u * 3u);
    EXPECT_FALSE(is_black(*picture));
  }
  EXPECT_NE(on, off);
  EXPECT_NE(caustics, on);
  // Light is added and none taken, at one exposure: no value of the one falls below that of the other.
  for (size_t i = 0; i < on.size(); ++i) ASSERT_GE(on[i], off[i]) << i;
  // Somewhere the ball's caustic lights its shadow, which direct light leaves dark.
  size_t lit = 0;
  for (size_t i = 0; i < on.size(); ++i) lit += on[i] > off[i] + 40;
  EXPECT_GT(lit, 10u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "out/pictures"), {}), 5);
}

TEST_F(CausticsPicture, OfPointsThatShareAReferenceAreShownAtOneExposure) {
  Workspace workspace(settings());
  const Changes common{{"camera", text("front")}, {"picture", true}, {"reference_paths", 2e4}};
  const auto run_with = [&](const Changes& own) {
    Changes changes = common;
    changes.insert(own.begin(), own.end());
    run_in(workspace, changes);
  };
  run_with({{"rays_per_texel", 0.25}, {"mirror_depth", int64_t{1}}, {"roulette_threshold", 0.0}});
  const auto off = pixels("off"), on = pixels("on"), reference = pixels("reference");
  run_with({{"rays_per_texel", 64.0}, {"filter", text("wavelet")}, {"camera_paths", int64_t{3}}});
  ASSERT_FALSE(off.empty());
  EXPECT_EQ(pixels("off"), off);
  EXPECT_EQ(pixels("reference"), reference);
  EXPECT_NE(pixels("on"), on);
}

TEST_F(CausticsPicture, WithoutCausticsIsTheSceneAlone) {
  run({{"camera", text("front")}, {"picture", true}, {"caustics", false}, {"resolution", text("32x18")}});
  EXPECT_FALSE(is_black(pixels("off", "32x18")));
  EXPECT_TRUE(pixels("on", "32x18").empty());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "out/pictures"), {}), 1);
}

}  // namespace
}  // namespace hybray
