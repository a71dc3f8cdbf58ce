#include "core/ssrm/cell_walk.h"

#include "core/base/hash.h"

#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

constexpr int kWidth = 41, kHeight = 27;
constexpr uint64_t kSeed = 31;
using Pixels = std::set<std::pair<int, int>>;

ScreenRay<float> random_ray(uint64_t i) {
  const auto unit = [&](uint32_t d) { return 2.0 * random_unit(i, d, 0, kSeed) - 1.0; };
  ScreenRay<float> ray{};
  ray.ox = static_cast<float>(0.5 * kWidth * (1.0 + unit(0)));
  ray.oy = static_cast<float>(0.5 * kHeight * (1.0 + unit(1)));
  ray.dx = static_cast<float>(unit(2) * unit(2) * unit(2));
  ray.dy = static_cast<float>(unit(3));
  if (i % 5 == 0)
    ray.dy = ray.dx, ray.ox = std::floor(ray.ox) + 0.5f,
    ray.oy = std::floor(ray.oy) + 0.5f;          // exact diagonals
  if (i % 7 == 0) ray.dx = 0x1p-126f;            // along an axis
  if (i % 11 == 0) ray.ox = std::floor(ray.ox);  // from a cell's edge
  return ray;
}

// Pixels whose interior the ray meets for longer than `least`, each by clipping the ray against that pixel
// alone, in double.
Pixels clipped_pixels(const ScreenRay<float>& r, double least) {
  Pixels pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      double enter = 0.0, leave = 1e30;
      const auto clip = [&](double o, double d, double low) {
        const double a = (low - o) / d, b = (low + 1.0 - o) / d;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      };
      clip(r.ox, r.dx, x);
      clip(r.oy, r.dy, y);
      if (leave - enter > least) pixels.emplace(x, y);
    }
  return pixels;
}

Pixels walked_pixels(const ScreenRay<float>& r, int start_x, int start_y) {
  CellWalk<float> walk(r, kWidth, kHeight, start_x, start_y);
  Pixels pixels;
  do {
    pixels.emplace(walk.px, walk.py);
    EXPECT_LE(pixels.size(), static_cast<size_t>(kWidth + kHeight)) << "must end";
  } while (walk.advance(walk.exit(0)));
  return pixels;
}

TEST(CellWalk, VisitsEveryPixelThatTheRayCrossesAndNoOther) {
  for (uint64_t i = 0; i < 5000; ++i) {
    const ScreenRay<float> ray = random_ray(i);
    const int x = std::min(kWidth - 1, static_cast<int>(ray.ox)),
              y = std::min(kHeight - 1, static_cast<int>(ray.oy));
    // A ray that starts on its pixel's edge and goes the other way leaves that pixel at once; its own pixel
    // is right all the same.
    const Pixels walked = walked_pixels(ray, x, y);
    for (const auto& p : clipped_pixels(ray, 1e-3))
      EXPECT_TRUE(walked.count(p)) << "seed " << kSeed << " ray " << i;
    const Pixels touched = clipped_pixels(ray, -1e-3);
    for (const auto& p : walked) EXPECT_TRUE(touched.count(p)) << "seed " << kSeed << " ray " << i;
  }
}

TEST(CellWalk, ACoarseWalkEntersExactlyThePixelsThatTheFineWalkIsInThere) {
  for (uint64_t i = 0; i < 5000; ++i) {
    const ScreenRay<float> ray = random_ray(i);
    const int x = std::min(kWidth - 1, static_cast<int>(ray.ox)),
              y = std::min(kHeight - 1, static_cast<int>(ray.oy));
    struct State {
      int px, py;
      float l;
      bool operator==(const State&) const = default;
    };
    std::vector<State> fine;
    CellWalk<float> walk(ray, kWidth, kHeight, x, y);
    do fine.push_back({walk.px, walk.py, walk.l});
    while (walk.advance(walk.exit(0)));
    for (int level : {1, 2, 4}) {
      CellWalk<float> coarse(ray, kWidth, kHeight, x, y);
      size_t at = 0;
      do {
        for (int l = level; l > 0; --l) coarse.descend(l);
        const State here{coarse.px, coarse.py, coarse.l};
        while (at < fine.size() && !(fine[at] == here)) ++at;
        ASSERT_LT(at, fine.size()) << "seed " << kSeed << " ray " << i << " level " << level;
      } while (coarse.advance(coarse.exit(level)));
    }
  }
}

TEST(CellWalk, ThePreviousPixelIsTheOneWalkedBefore) {
  for (uint64_t i = 0; i < 2000; ++i) {
    const ScreenRay<float> ray = random_ray(i);
    CellWalk<float> walk(ray, kWidth, kHeight, std::min(kWidth - 1, static_cast<int>(ray.ox)),
                         std::min(kHeight - 1, static_cast<int>(ray.oy)));
    ivec2 before(walk.px, walk.py);
    while (walk.advance(walk.exit(0))) {
      ASSERT_EQ(walk.previous(), before) << "seed " << kSeed << " ray " << i;
      before = {walk.px, walk.py};
    }
  }
}

}  // namespace
}  // namespace hybray::ssrm
