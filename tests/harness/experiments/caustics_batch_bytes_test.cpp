#include "harness/experiments/caustics_batch_bytes.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics_parts;
using truth::CausticReferenceBatch;

Image2D<vec3> image(int width, int height, float first) {
  Image2D<vec3> result(width, height);
  for (size_t i = 0; i < result.size(); ++i)
    result[i] = vec3(first + static_cast<float>(i), 0.1f * first, std::numeric_limits<float>::denorm_min());
  return result;
}

CausticReferenceBatch example(bool mixed) {
  CausticReferenceBatch batch;
  batch.illumination = image(5, 3, 1.0f);
  if (mixed) batch.mixed = image(5, 3, 20.0f), batch.mixed_wide = image(5, 3, 40.0f);
  batch.ledger = {1.0 / 3.0, 2, 3, 4, 5, 6, -7};
  batch.counts = {8, 9, 10, 0.1};
  batch.rays = uint64_t{1} << 40, batch.paths = 12, batch.overflows = 13;
  return batch;
}

bool same(const Image2D<vec3>& a, const Image2D<vec3>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(vec3)) == 0;
}

TEST(CausticsBatchBytes, ABatchComesBackBitForBit) {
  for (const bool mixed : {false, true}) {
    const CausticReferenceBatch batch = example(mixed);
    const std::string bytes = to_bytes(batch);
    EXPECT_EQ(bytes, to_bytes(batch));
    const auto back = batch_from_bytes(bytes, 5, 3);
    ASSERT_TRUE(back);
    EXPECT_TRUE(same(back->illumination, batch.illumination));
    EXPECT_EQ(back->mixed.empty(), !mixed);
    EXPECT_TRUE(same(back->mixed, batch.mixed) && same(back->mixed_wide, batch.mixed_wide));
    EXPECT_EQ(std::memcmp(&back->ledger, &batch.ledger, sizeof batch.ledger), 0);
    EXPECT_EQ(std::memcmp(&back->counts, &batch.counts, sizeof batch.counts), 0);
    EXPECT_EQ(back->rays, batch.rays);
    EXPECT_EQ(back->paths, batch.paths);
    EXPECT_EQ(back->overflows, batch.overflows);
  }
}

TEST(CausticsBatchBytes, BytesOfAnotherSizeAreRefused) {
  const std::string bytes = to_bytes(example(true));
  EXPECT_FALSE(batch_from_bytes(bytes, 3, 5));
  EXPECT_FALSE(batch_from_bytes(bytes, 5, 4));
  for (size_t length = 0; length < bytes.size(); length += 7)
    EXPECT_FALSE(batch_from_bytes(std::string_view(bytes).substr(0, length), 5, 3)) << length;
  EXPECT_FALSE(batch_from_bytes(bytes + "x", 5, 3));
}

}  // namespace
}  // namespace hybray
