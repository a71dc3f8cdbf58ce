#include "core/base/image_io.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace hybray {
namespace {

Image2D<vec3> sample_image() {
  Image2D<vec3> image(37, 23);
  for (size_t i = 0; i < image.size(); ++i)
    for (uint32_t c = 0; c < 3; ++c)
      image[i][static_cast<int>(c)] = static_cast<float>(std::exp(20.0 * random_unit(i, c, 0, 1) - 10.0));
  return image;
}

TEST(ImageIo, KeepsEveryBitInExr) {
  const test::TemporaryFolder folder;
  Image2D<vec3> image = sample_image();
  image(0, 0) =
      vec3(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e-40f);
  image(36, 22) = vec3(0.0f, std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min());
  write_radiance(folder / "a.exr", image);
  const Image2D<vec3> read = read_radiance(folder / "a.exr");
  ASSERT_EQ(read.width(), 37);
  ASSERT_EQ(read.height(), 23);
  EXPECT_EQ(std::memcmp(read.data(), image.data(), image.size() * sizeof(vec3)), 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr.partial"));
}

TEST(ImageIo, WritesTheSameExrFileForTheSameImage) {
  const test::TemporaryFolder folder;
  write_radiance(folder / "a.exr", sample_image());
  write_radiance(folder / "b.exr", sample_image());
  EXPECT_EQ(test::content_of(folder / "a.exr"), test::content_of(folder / "b.exr"));
}

TEST(ImageIo, KeepsHdrToTheSharedExponent) {
  const test::TemporaryFolder folder;
  const Image2D<vec3> image = sample_image();
  write_radiance(folder / "a.HDR", image);
  const Image2D<vec3> read = read_radiance(folder / "a.HDR");
  ASSERT_EQ(read.size(), image.size());
  // 8 bits of mantissa below the largest channel's power of two: a step of at most 1/128 of that channel.
  for (size_t i = 0; i < image.size(); ++i) {
    const float largest = std::max({image[i].x, image[i].y, image[i].z});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(read[i][c], image[i][c], largest / 128.0f);
  }
}

TEST(ImageIo, RefusesWhatIsNotAnImageOfRadiance) {
  const test::TemporaryFolder folder;
  const auto starts = [&](const std::string& name, const std::string& message) {
    const std::string text = test::message_of<InputError>([&] { read_radiance(folder / name); });
    EXPECT_TRUE(text.starts_with((folder / name).string() + ": " + message)) << text;
  };
  starts("a.png", "radiance is kept in .exr or .hdr files");
  starts("missing.exr", "cannot be read: ");
  folder.write("text.exr", "not an image");
  starts("text.exr", "cannot be read: ");
  folder.write("text.hdr", "");
  starts("text.hdr", "cannot be read: ");
  write_radiance(folder / "whole.exr", sample_image());
  const std::string whole = test::content_of(folder / "whole.exr");
  folder.write("torn.exr", whole.substr(0, whole.size() / 2));
  starts("torn.exr", "cannot be read: ");
  EXPECT_THROW(write_radiance(folder / "a.png", sample_image()), InputError);
  EXPECT_THROW(write_radiance(folder / "a.exr", {}), InputError);
  EXPECT_THROW(write_radiance(folder / "nowhere/a.exr", sample_image()), RuntimeError);
}

}  // namespace
}  // namespace hybray
