#include "core/ssrm/march_layers.h"

#include "core/gbuffer/guard_band.h"
#include "core/truth/march_layers_level0.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <cmath>
#include <iostream>
#include <memory>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

constexpr uint64_t kSeed = 64;

// A view with its rays, layers and, if wanted, the bounds that let rays skip cells.
struct LayeredMain {
  test::MainView main;
  DepthLayers layers;
  std::unique_ptr<SlotPyramid> slots;

  LayeredMain(const Tracer& tracer, const View& view, int count, FreeSpace rule, bool min_max = false)
      : main(tracer, view), layers(make_depth_layers(tracer, main.gbuffer, count)) {
    if (min_max) slots = std::make_unique<SlotPyramid>(main.depth(), layers, rule);
  }
  LayeredView view() const { return {main.depth(), main.gbuffer.primitive, layers, slots.get()}; }
  LayerResults march(const LayerOptions& options) const {
    LayerResults results;
    results.resize(main.rays.size());
    march_layers(view(), main.screen_rays, main.rays.pixel, options, results);
    return results;
  }
};

void add_box(Scene& scene, const vec3& low, const vec3& high) {
  const vec3 s = high - low;
  const vec3 x(s.x, 0, 0), y(0, s.y, 0), z(0, 0, s.z);
  test::add_rectangle(scene, low, y, x);           // faces -z
  test::add_rectangle(scene, high - x - y, x, y);  // faces +z
  test::add_rectangle(scene, low, z, y);           // faces -x
  test::add_rectangle(scene, high - y - z, y, z);  // faces +x
  test::add_rectangle(scene, low, x, z);           // faces -y
  test::add_rectangle(scene, high - x - z, z, x);  // faces +y
}

// A floor in front of a wall at z = -8, and a board (a box) between that hides a part of both from the
// viewer; a ray from the floor in front of it passes over the board or behind it, to the wall.
struct BoardScene {
  Scene scene = test::empty_scene();
  BoardScene() {
    test::add_rectangle(scene, vec3(-20, 0, -12), vec3(0, 0, 24), vec3(40, 0, 0), 1);  // floor, faces up
    test::add_rectangle(scene, vec3(-20, 0, -8), vec3(40, 0, 0), vec3(0, 16, 0));      // wall, faces +z
    add_box(scene, vec3(-3, 2.2f, -3.2f), vec3(3, 3.4f, -3));  // board above the floor
  }
};

TEST(MarchLayers, RaysBehindABoardHitTheWallOnALayerBehindIt) {
  const BoardScene board;
  const Tracer tracer(board.scene, {.robust = true, .layers = true});
  const View view(Camera{"c", vec3(0, 2.5f, 4), vec3(0, 2.2f, -8)}, {.width = 240, .height = 160},
                  board.scene.bounds);
  const LayeredMain one(tracer, view, 1, FreeSpace::closed), three(tracer, view, 3, FreeSpace::closed);
  const LayerResults single = one.march({}), layered = three.march({});
  size_t further = 0, gained = 0;
  for (size_t i = 0; i < layered.layer.size(); ++i) {
    if (single.march.verdict[i] == Verdict::hit) {
      EXPECT_EQ(layered.march.verdict[i], Verdict::hit) << i;
      EXPECT_EQ(layered.march.pixel[i], single.march.pixel[i]) << i;
    }
    gained += layered.march.verdict[i] == Verdict::hit && single.march.verdict[i] != Verdict::hit;
    if (layered.march.verdict[i] != Verdict::hit || layered.layer[i] == 0) continue;
    // The claim is the wall, where the closed form has it: z = -8 on the ray, within a pixel of the accepted
    // one.
    const auto& rays = three.main.rays;
    const double t = (-8.0 - rays.oz[i]) / rays.dz[i];
    const dvec2 p = view.project(dvec3(rays.origin(i)) + t * dvec3(rays.direction(i)));
    ASSERT_LT(three.view().primitive_of(layered.layer[i], layered.march.pixel[i]) / 2, 2u) << "floor or wall";
    if (three.view().primitive_of(layered.layer[i], layered.march.pixel[i]) / 2 != 1) continue;
    EXPECT_NEAR(layered.march.pixel[i] % 240 + 0.5, p.x, 0.501) << i;
    EXPECT_NEAR(layered.march.pixel[i] / 240 + 0.5, p.y, 0.501) << i;
    EXPECT_EQ(layered.layer[i], 2) << "front and back of the board are the first two";
    ++further;
  }
  EXPECT_GT(further, 200u);
  EXPECT_GE(gained, further);
}

TEST(MarchLayers, ARayThatComesIntoABodyBetweenPixelCentresIsUnknown) {
  // One row of pixels; a box fills pixels 3 to 6 from depth 0.4 to 0.6, a wall stands behind it at 0.8. The
  // ray's march depth rises slowly from 0.3, so that it meets the box's side face at the border of pixel 3 at
  // 0.45, which no pixel centre shows. It leaves through the back of the box inside pixel 5.
  GBuffer first(
      View(Camera{"c"},
           {.width = 10, .height = 1, .near = 1.0, .far = 2.0, .convention = DepthConvention::standard},
           Bounds3{}));
  first.depth = Image2D<float>(10, 1, 0.8f);
  first.depth_derivatives = Image2D<vec2>(10, 1);
  first.primitive = Image2D<uint32_t>(10, 1, 9u);
  DepthLayers layers;
  layers.fronts = Image2D<uint8_t>(10, 1, 1);
  for (int layer = 1; layer < 3; ++layer) {
    GBuffer g(first.view);
    g.depth = Image2D<float>(10, 1, 1.0f);
    g.depth_derivatives = Image2D<vec2>(10, 1);
    g.primitive = Image2D<uint32_t>(10, 1, kNoPrimitive);
    layers.further.push_back(g);
  }
  for (int x = 3; x < 7; ++x) {
    first.depth(x, 0) = 0.4f, first.primitive(x, 0) = 1;
    layers.further[0].depth(x, 0) = 0.6f, layers.further[0].primitive(x, 0) = 2;
    layers.further[1].depth(x, 0) = 0.8f, layers.further[1].primitive(x, 0) = 9;
    layers.fronts(x, 0) = 0b101;
  }
  DepthPyramid pyramid(10, 1);
  pyramid.build(first.depth, 1, 1.0f);
  const LayeredView view{{pyramid, first.depth_derivatives, 1}, first.primitive, layers};
  const ScreenRay<float> into{0.5f, 0.5f, 0.3f, 1.0f, 0x1p-126f, 0.06f, 100.0f, Verdict::miss};
  uint64_t steps = 0;
  for (FreeSpace rule : {FreeSpace::closed, FreeSpace::not_solids}) {
    const LayerHit hit = march_layers_ray(view, into, 0, {rule}, steps);
    EXPECT_EQ(hit.verdict, Verdict::behind);
    EXPECT_EQ(hit.pixel, kNoPixel);
  }
  const LayerHit naive = march_layers_ray(view, into, 0, {FreeSpace::any}, steps);
  EXPECT_EQ(naive.verdict, Verdict::hit) << "the naive rule takes the back face from inside for a surface";
  // The same ray deeper by 0.25 is behind the box where it comes to it, and hits the wall there or beyond.
  const ScreenRay<float> past{0.5f, 0.5f, 0.55f, 1.0f, 0x1p-126f, 0.05f, 100.0f, Verdict::miss};
  const LayerHit wall = march_layers_ray(view, past, 0, {FreeSpace::closed}, steps);
  EXPECT_EQ(wall.verdict, Verdict::hit);
  EXPECT_EQ(wall.pixel, 5u) << "0.8 = 0.55 + 0.05 * 5, half a pixel after the border of pixel 5";
  EXPECT_EQ(wall.layer, 2);
}

struct Size {
  int width, height;
};

class MarchLayersScenes : public testing::TestWithParam<const char*> {};

TEST_P(MarchLayersScenes, OneLayerWithoutMarchingOnIsThePapersMarcher) {
  const Scene scene = load_scene(test::scene_paths(), GetParam());
  const Tracer tracer(scene, {.robust = true, .layers = true});
  for (const Size& size : {Size{333, 217}, Size{160, 90}, Size{64, 1}, Size{1, 1}}) {
    const View view(scene.cameras.front(), {.width = size.width, .height = size.height}, scene.bounds);
    const LayeredMain v(tracer, view, 1, FreeSpace::closed);
    const LayerResults layered = v.march({.march_on = false});
    const MarchResults paper = v.main.march();
    EXPECT_EQ(layered.march.verdict, paper.verdict) << size.width << "x" << size.height;
    EXPECT_EQ(layered.march.pixel, paper.pixel) << size.width << "x" << size.height;
    EXPECT_EQ(layered.march.steps, paper.steps) << size.width << "x" << size.height;
  }
}

TEST_P(MarchLayersScenes, SkippingCellsChangesNoResult) {
  const Scene scene = load_scene(test::scene_paths(), GetParam());
  const Tracer tracer(scene, {.robust = true, .layers = true});
  for (const Size& size : {Size{333, 217}, Size{64, 1}, Size{1, 1}})
    for (FreeSpace rule : {FreeSpace::closed, FreeSpace::any}) {
      const View view(scene.cameras.back(), {.width = size.width, .height = size.height}, scene.bounds);
      const LayeredMain walked(tracer, view, 3, rule), skipped(tracer, view, 3, rule, true);
      const LayerResults a = walked.march({.free_space = rule}), b = skipped.march({.free_space = rule});
      EXPECT_EQ(a.march.verdict, b.march.verdict) << size.width << "x" << size.height;
      EXPECT_EQ(a.march.pixel, b.march.pixel);
      EXPECT_EQ(a.layer, b.layer);
    }
}

// Float borders and depths against double: only rays within rounding of a decision may differ. march_paper
// allows 2 in 100,000 of its one decision a pixel; here a pixel has up to one for each of three layers at
// both ends.
TEST_P(MarchLayersScenes, AgreesWithTheExhaustiveDoubleMarcher) {
  const Scene scene = load_scene(test::scene_paths(), GetParam());
  const Tracer tracer(scene, {.robust = true, .layers = true});
  size_t compared = 0, different = 0, late = 0;
  for (size_t c = 0; c < std::min<size_t>(2, scene.cameras.size()); ++c)
    for (const Size& size : {Size{333, 217}, Size{64, 1}, Size{1, 1}})
      for (FreeSpace rule : {FreeSpace::closed, FreeSpace::not_solids, FreeSpace::any}) {
        const auto convention = c % 2 ? DepthConvention::standard : DepthConvention::reversed;
        const View view(scene.cameras[c],
                        {.width = size.width, .height = size.height, .convention = convention}, scene.bounds);
        const LayeredMain v(tracer, view, 3, rule, true);
        const LayerOptions options{.free_space = rule};
        const LayerResults results = v.march(options);
        for (size_t i = 0; i < results.layer.size(); ++i) {
          const LayerHit exact = truth::march_layers_level0(v.view(), v.main.screen_rays.get<double>(i),
                                                            v.main.rays.pixel[i], options);
          different += exact.verdict != results.march.verdict[i] || exact.pixel != results.march.pixel[i] ||
                       (exact.verdict == Verdict::hit && exact.layer != results.layer[i]);
          late += results.late[i];
        }
        compared += results.layer.size();
      }
  std::cout << GetParam() << ": " << different << " of " << compared << " rays labelled differently, " << late
            << " late HITs\n";
  EXPECT_LE(static_cast<double>(different), 12e-5 * static_cast<double>(compared));
  EXPECT_GT(late, compared / 100);
}

INSTANTIATE_TEST_SUITE_P(Procedural, MarchLayersScenes, testing::Values("sphere", "atrium", "street"),
                         [](const auto& test) { return std::string(test.param); });

TEST(MarchLayers, WithoutARuleForFreeSpaceMoreIsResolvedAndWithItNoRayChangesItsHit) {
  const Scene scene = test::triangle_soup(60, 1.5f, 2.0f, kSeed);
  const Tracer tracer(scene, {.robust = true, .layers = true});
  const View view(Camera{"c", vec3(0, 0, 3.5f), vec3(0)}, {.width = 160, .height = 100}, scene.bounds);
  const LayeredMain v(tracer, view, 4, FreeSpace::any);
  const LayerResults any = v.march({.free_space = FreeSpace::any}),
                     closed = v.march({.free_space = FreeSpace::closed});
  size_t only_any = 0;
  for (size_t i = 0; i < any.layer.size(); ++i) {
    if (closed.march.verdict[i] == Verdict::hit) {
      EXPECT_EQ(any.march.pixel[i], closed.march.pixel[i]) << "seed " << kSeed << " ray " << i;
      EXPECT_EQ(any.layer[i], closed.layer[i]);
    }
    only_any += any.march.verdict[i] == Verdict::hit && closed.march.verdict[i] != Verdict::hit;
  }
  EXPECT_GT(only_any, any.layer.size() / 100);
}

}  // namespace
}  // namespace hybray::ssrm
