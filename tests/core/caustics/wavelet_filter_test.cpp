#include "core/caustics/wavelet_filter.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace hybray::caustics {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr FilterNormalisation kBoth[] = {FilterNormalisation::exchange, FilterNormalisation::gather};

GBuffer seen(const Scene& scene, int width, int height, const Camera& camera) {
  const Tracer tracer(scene, {.robust = true});
  const View view(camera, {.width = width, .height = height}, scene.bounds);
  return make_gbuffer(tracer, view, kDepth | kGeometricNormal | kShadingNormal | kMaterial);
}

// A floor that fills the view, seen at a slant.
GBuffer floor_view(int width = 101, int height = 81) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-300, 0, 300), vec3(600, 0, 0), vec3(0, 0, -600));
  return seen(scene, width, height, {"c", vec3(0, 2, 3), vec3(0, 0, 0)});
}

// A wall that fills the view, of material 0 where x < 0 and 1 elsewhere: the border is right of column
// width/2 - 1.
GBuffer two_materials(int width, int height) {
  Scene scene = test::empty_scene();
  scene.materials.push_back({});
  test::add_rectangle(scene, vec3(-50, -50, 0), vec3(50, 0, 0), vec3(0, 100, 0));
  Mesh right;
  right.positions = {vec3(0, -50, 0), vec3(50, -50, 0), vec3(50, 50, 0), vec3(0, 50, 0)};
  right.triangles = {uvec3(0, 1, 2), uvec3(0, 2, 3)};
  append_mesh(scene, right, mat4(1.0f), 1, "right");
  return seen(scene, width, height, {"c", vec3(0, 0, 5), vec3(0)});
}

// Two walls that meet at a right angle in the middle of the view, the view axis halving it.
GBuffer corner(int width, int height) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-40, -50, 40), vec3(40, 0, -40), vec3(0, 100, 0));
  test::add_rectangle(scene, vec3(0, -50, 0), vec3(40, 0, 40), vec3(0, 100, 0));
  return seen(scene, width, height, {"c", vec3(0, 0, 9), vec3(0)});
}

Image2D<vec3> random_image(const GBuffer& g, const std::function<double(double)>& value_of_unit,
                           uint64_t seed) {
  Image2D<vec3> image(g.view.width(), g.view.height());
  for (size_t i = 0; i < image.size(); ++i)
    for (uint32_t c = 0; c < 3; ++c)
      image[i][static_cast<int>(c)] = static_cast<float>(value_of_unit(random_unit(i, c, 0, seed)));
  return image;
}

double energy(const Image2D<vec3>& image) {
  double sum = 0.0;
  for (const vec3& v : image) sum += double{v.x} + double{v.y} + double{v.z};
  return sum;
}

TEST(WaveletFilter, LeavesConstantImagesExactlyAsTheyAre) {
  for (const GBuffer& g : {floor_view(), corner(60, 40), two_materials(60, 40)})
    for (FilterNormalisation normalisation : kBoth)
      for (float luminance_sigma : {1.5f, kInfinity}) {
        const Image2D<vec3> image(g.view.width(), g.view.height(), vec3(0.1f, 7.3f, 1e-20f));
        const Image2D<vec3> filtered =
            filter_wavelet(image, g, {.luminance_sigma = luminance_sigma, .normalisation = normalisation});
        for (size_t i = 0; i < image.size(); ++i) ASSERT_EQ(filtered[i], image[i]);
      }
}

TEST(WaveletFilter, TurnsAnImpulseOnAPlaneIntoTheB3Spline) {
  const GBuffer g = floor_view();
  Image2D<vec3> image(101, 81, vec3(0.0f));
  image(50, 40) = vec3(256.0f, 0.0f, 512.0f);
  const double spline[5] = {1, 4, 6, 4, 1};
  for (FilterNormalisation normalisation : kBoth) {
    const Image2D<vec3> filtered = filter_wavelet(
        image, g, {.iterations = 1, .luminance_sigma = kInfinity, .normalisation = normalisation});
    // A point's distance from the plane through another is zero but for the rounding of coordinates, some
    // 1e-6 m here against footprints of 3e-2 m.
    for (int y = 0; y < 81; ++y)
      for (int x = 0; x < 101; ++x) {
        const int i = x - 48, j = y - 38;
        const double expected = i >= 0 && i < 5 && j >= 0 && j < 5 ? spline[i] * spline[j] : 0.0;
        EXPECT_NEAR(filtered(x, y).x, expected, 1e-3);
        EXPECT_EQ(filtered(x, y).y, 0.0f);
        EXPECT_NEAR(filtered(x, y).z, 2.0 * expected, 2e-3);
      }
  }
}

TEST(WaveletFilter, KeepsTheEnergyOfAnImpulseOnAPlaneToRounding) {
  const GBuffer g = floor_view(301, 281);
  Image2D<vec3> image(301, 281, vec3(0.0f));
  image(150, 140) = vec3(1.0f);
  for (FilterNormalisation normalisation : kBoth)
    for (float luminance_sigma : {1.5f, kInfinity}) {
      const Image2D<vec3> filtered =
          filter_wavelet(image, g, {.luminance_sigma = luminance_sigma, .normalisation = normalisation});
      const bool spreads = luminance_sigma == kInfinity;
      // Five iterations reach 62 pixels, inside the view, whose pixels have the whole kernel each.
      if (spreads || normalisation == FilterNormalisation::exchange) {
        EXPECT_NEAR(energy(filtered), 3.0, 3.0 * 1e-5);
      }
      if (spreads) {
        EXPECT_LT(filtered(150, 140).x, 0.01f);
      }
    }
}

TEST(WaveletFilter, ByExchangeKeepsTheEnergyOfAnyImage) {
  for (const GBuffer& g : {floor_view(), corner(80, 60), two_materials(80, 60)}) {
    const Image2D<vec3> image = random_image(
        g, [](double u) { return u < 0.05 ? 20.0 * u : 0.0; }, 3);
    for (float luminance_sigma : {1.5f, kInfinity})
      EXPECT_NEAR(energy(filter_wavelet(image, g, {.luminance_sigma = luminance_sigma})) / energy(image), 1.0,
                  1e-6);
  }
}

TEST(WaveletFilter, ByGatheringLosesAtABorderWhatItsWeightsSay) {
  // One iteration; an impulse in the last column before another material. A column at distance 0, 1, 2, ...
  // from the border has 11/16, 15/16, 16/16, ... of the kernel and divides by that.
  const GBuffer g = two_materials(60, 40);
  Image2D<vec3> image(60, 40, vec3(0.0f));
  image(29, 20) = vec3(1.0f);
  const Image2D<vec3> gathered = filter_wavelet(image, g,
                                                {.iterations = 1,
                                                 .luminance_sigma = kInfinity,
                                                 .normalisation = FilterNormalisation::gather}),
                      exchanged = filter_wavelet(image, g, {.iterations = 1, .luminance_sigma = kInfinity});
  EXPECT_NEAR(energy(gathered) / 3.0, 6.0 / 11 + 4.0 / 15 + 1.0 / 16, 1e-5);
  EXPECT_NEAR(energy(exchanged) / 3.0, 1.0, 1e-6);
  EXPECT_NEAR(exchanged(29, 20).x, 6.0 / 16 * 6 / 16 + 5.0 / 16, 1e-6) << "what is cut off stays";
}

TEST(WaveletFilter, DoesNotBlurAcrossCreasesMaterialsAndSilhouettes) {
  Scene step = test::empty_scene();  // a plate 0.5 m, some 20 footprints, before a wall
  test::add_rectangle(step, vec3(-50, -50, 0), vec3(100, 0, 0), vec3(0, 100, 0));
  test::add_rectangle(step, vec3(-20, -20, 0.5f), vec3(20, 0, 0), vec3(0, 40, 0));
  const GBuffer plate = seen(step, 80, 60, {"c", vec3(0, 0, 2), vec3(0)});
  for (const GBuffer& g : {corner(80, 60), two_materials(80, 60), plate}) {
    Image2D<vec3> image(80, 60, vec3(0.0f));
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 40; ++x) image(x, y) = vec3(1.0f);
    for (FilterNormalisation normalisation : kBoth) {
      const Image2D<vec3> filtered =
          filter_wavelet(image, g, {.luminance_sigma = kInfinity, .normalisation = normalisation});
      for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) ASSERT_EQ(filtered(x, y), image(x, y)) << x << " " << y;
    }
  }
}

// One iteration in double, by the formulas of docs/metrics.md, pixel by pixel.
TEST(WaveletFilter, IsItsDefinitionOnCurvedSurfaces) {
  Scene scene = test::triangle_soup(60, 3.0f, 2.0f, 5);
  Mesh bowl;  // z = (x^2 + y^2) / 8 with smooth normals
  for (int j = 0; j <= 40; ++j)
    for (int i = 0; i <= 40; ++i) {
      const float x = 0.25f * static_cast<float>(i) - 5.0f, y = 0.25f * static_cast<float>(j) - 5.0f;
      bowl.positions.emplace_back(x, y, (x * x + y * y) / 8.0f - 3.0f);
      bowl.normals.push_back(glm::normalize(vec3(-x / 4.0f, -y / 4.0f, 1.0f)));
    }
  for (uint32_t j = 0; j < 40; ++j)
    for (uint32_t i = 0; i < 40; ++i) {
      const uint32_t p = 41 * j + i;
      bowl.triangles.emplace_back(p, p + 1, p + 42);
      bowl.triangles.emplace_back(p, p + 42, p + 41);
    }
  append_mesh(scene, bowl, mat4(1.0f), 0, "bowl");
  const GBuffer g = seen(scene, 90, 70, {"c", vec3(0, 0, 9), vec3(0)});
  const Image2D<vec3> image = random_image(
      g, [](double u) { return u; }, 4);
  const double spline[5] = {1, 4, 6, 4, 1};
  for (FilterNormalisation normalisation : kBoth) {
    const Image2D<vec3> filtered = filter_wavelet(image, g,
                                                  {.iterations = 1,
                                                   .normal_power = 20.0f,
                                                   .plane_sigma = 2.0f,
                                                   .luminance_sigma = kInfinity,
                                                   .normalisation = normalisation});
    int partial = 0;
    for (int y = 0; y < 70; ++y)
      for (int x = 0; x < 90; ++x) {
        if (g.material(x, y) == kNoPrimitive) {
          EXPECT_EQ(filtered(x, y), image(x, y));
          continue;
        }
        const auto point = [&](int px, int py) {
          return g.view.view_depth_of(g.depth(px, py)) * g.view.ray_direction(px + 0.5, py + 0.5);
        };
        double gain = 0.0, sum = 36.0 / 256;
        for (int j = -2; j <= 2; ++j)
          for (int i = -2; i <= 2; ++i) {
            const int qx = x + i, qy = y + j;
            if ((i == 0 && j == 0) || qx < 0 || qy < 0 || qx >= 90 || qy >= 70) continue;
            if (g.material(qx, qy) == kNoPrimitive) continue;
            const dvec3 p = point(x, y), q = point(qx, qy);
            const double at_p = glm::dot(q - p, dvec3(g.geometric_normal(x, y))),
                         at_q = glm::dot(q - p, dvec3(g.geometric_normal(qx, qy)));
            const double focal = g.view.focal(), depth_p = glm::dot(p, g.view.forward()),
                         depth_q = glm::dot(q, g.view.forward());
            const double cosine = glm::dot(dvec3(g.shading_normal(x, y)), dvec3(g.shading_normal(qx, qy)));
            const double t = 20.0 * (1.0 - cosine) +
                             (at_p * at_p + at_q * at_q) / (2.0 * depth_p / focal * 2.0 * depth_q / focal);
            const double weight =
                spline[i + 2] * spline[j + 2] / 256 * std::pow(std::max(0.0, 1.0 - t / 8.0), 8);
            gain += weight * (image(qx, qy).x - image(x, y).x);
            sum += weight;
          }
        partial += sum > 0.2 && sum < 0.9;
        const double scale = normalisation == FilterNormalisation::gather ? 1.0 / sum : 1.0;
        // Coordinates of 10 m in float, 1e-6 m, against 2 footprints of 0.1 m: 1e-5 in t and in the weights.
        EXPECT_NEAR(filtered(x, y).x, image(x, y).x + scale * gain, 1e-4) << x << " " << y;
      }
    EXPECT_GT(partial, 1000) << "the weights must be put to the test";
  }
}

TEST(WaveletFilter, SmoothsSparsePhotonsAndKeepsAStepWhereItIs) {
  // Photons of value 1, on average 0.3 a pixel on the left and 3 on the right: Poisson numbers by inversion.
  const GBuffer g = floor_view(160, 120);
  Image2D<vec3> image(160, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      const double mean = x < 80 ? 0.3 : 3.0, u = random_unit(static_cast<uint64_t>(160 * y + x), 0, 0, 8);
      int count = 0;
      for (double p = std::exp(-mean), sum = p; u > sum && count < 50; sum += p) p *= mean / ++count;
      image(x, y) = vec3(static_cast<float>(count));
    }
  const Image2D<vec3> filtered = filter_wavelet(image, g);
  const auto relative_rms = [&](const Image2D<vec3>& of, int first, int last, double mean) {
    double sum = 0.0;
    for (int y = 10; y < 110; ++y)
      for (int x = first; x < last; ++x)
        sum += std::pow(of(x, y).x / mean - 1.0, 2) / (100.0 * (last - first));
    return std::sqrt(sum);
  };
  EXPECT_NEAR(relative_rms(image, 10, 72, 0.3), 1.0 / std::sqrt(0.3), 0.1);
  EXPECT_LT(relative_rms(filtered, 10, 72, 0.3), 0.25 / std::sqrt(0.3));
  EXPECT_LT(relative_rms(filtered, 88, 150, 3.0), 0.25 / std::sqrt(3.0));
  // The step stays within three pixels: without the comparison of brightness it is smeared over 60.
  const Image2D<vec3> blurred = filter_wavelet(image, g, {.luminance_sigma = kInfinity});
  EXPECT_LT(relative_rms(filtered, 73, 77, 0.3), 1.0);
  EXPECT_GT(relative_rms(blurred, 73, 77, 0.3), 2.0);
}

TEST(WaveletFilter, LeavesTextureAloneWhereTheAlbedoIsGiven) {
  const GBuffer g = floor_view();
  Image2D<vec3> albedo = random_image(
                    g, [](double u) { return 0.05 + 0.9 * u; }, 6),
                image = albedo;
  albedo(50, 40).y = 0.0f;
  for (vec3& v : image) v *= 3.0f;
  image(50, 40).y = 0.25f;
  const Image2D<vec3> with = filter_wavelet(image, g, {}, &albedo), without = filter_wavelet(image, g);
  double kept = 0.0, blurred = 0.0;
  for (int y = 0; y < 81; ++y)
    for (int x = 0; x < 101; ++x) {
      kept = std::max(kept, std::abs(double{with(x, y).x} / image(x, y).x - 1.0));
      blurred = std::max(blurred, std::abs(double{without(x, y).x} / image(x, y).x - 1.0));
    }
  EXPECT_LT(kept, 1e-6);
  EXPECT_GT(blurred, 1.0);
  EXPECT_EQ(with(50, 40).y, 0.25f) << "a channel that reflects nothing";
}

TEST(WaveletFilter, IsTheSameAtAnyThreadCountAndNeverNegative) {
  const GBuffer g = corner(97, 61);
  const Image2D<vec3> image = random_image(
      g, [](double u) { return u < 0.1 ? 1e6 * u : 0.0; }, 7);
  const Image2D<vec3> many = filter_wavelet(image, g);
  const ThreadLimit limit(1);
  const Image2D<vec3> one = filter_wavelet(image, g);
  for (size_t i = 0; i < image.size(); ++i) {
    ASSERT_EQ(one[i], many[i]);
    ASSERT_TRUE(one[i].x >= 0.0f && one[i].y >= 0.0f && one[i].z >= 0.0f);
  }
}

TEST(WaveletFilter, LeavesTheImageWithoutIterationsAndWithoutSurfaces) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-1, -1, 90), vec3(2, 0, 0), vec3(0, 2, 0));
  const GBuffer away = seen(scene, 20, 10, {"c", vec3(0, 0, 3), vec3(0)}), floor = floor_view(20, 10);
  const Image2D<vec3> image = random_image(
      floor, [](double u) { return u; }, 9);
  ASSERT_EQ(away.covered_pixels, 0u);
  EXPECT_TRUE(std::ranges::equal(filter_wavelet(image, away), image));
  EXPECT_TRUE(std::ranges::equal(filter_wavelet(image, floor, {.iterations = 0}), image));
  EXPECT_FALSE(std::ranges::equal(filter_wavelet(image, floor), image));
}

TEST(WaveletFilter, RefusesSettingsOutOfRangeAndImagesOfAnotherSize) {
  const GBuffer g = floor_view(20, 10);
  const Image2D<vec3> image(20, 10, vec3(1.0f)), other(10, 20, vec3(1.0f));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const WaveletFilterSettings& bad :
       std::initializer_list<WaveletFilterSettings>{{.iterations = -1},
                                                    {.iterations = 11},
                                                    {.normal_power = -1.0f},
                                                    {.normal_power = nan},
                                                    {.plane_sigma = 0.0f},
                                                    {.plane_sigma = kInfinity},
                                                    {.luminance_sigma = 0.0f},
                                                    {.luminance_sigma = nan},
                                                    {.luminance_sigma = 1e7f}})
    EXPECT_THROW(filter_wavelet(image, g, bad), InputError);
  EXPECT_THROW(filter_wavelet(other, g), InputError);
  EXPECT_THROW(filter_wavelet(image, g, {}, &other), InputError);
}

}  // namespace
}  // namespace hybray::caustics
