// Trees of the square, each in an iron grate, and the fountain between them.
#include "core/scene/procedural/street.h"

namespace hybray::procedural::street_parts {
namespace {

void add_tree(Model& model, const Materials& m, const dvec3& at, uint64_t number) {
  const Lod lod = model.lod(key("tree", number));
  Dice dice = model.dice(key("tree", number));
  MeshBuilder wood = model.part(), leaves = model.part(), grate = model.part();
  const double height = dice(2.5, 3.0), lean = dice(-0.15, 0.15);
  const dvec3 fork(lean, height, 0.5 * lean);
  const int s = lod.segments(16, 4), n = lod.segments(12, 2);
  tube(wood, smooth(Curve3{{0, -0.03, 0}, {0.05, 0.3, 0.02}, {0.3 * lean, 0.5 * height, -0.04}, fork}, n),
       0.17, 0.11, s);
  const int branches = 6;
  for (int i = 0; i < branches; ++i) {
    const double yaw = 2.0 * kPi * i / branches + dice(-0.3, 0.3), reach = dice(0.8, 1.25),
                 rise = dice(0.5, 2.3);
    const dvec3 out(std::cos(yaw), 0, std::sin(yaw)), tip = fork + out * reach + dvec3(0, rise, 0);
    if (lod.wants(0.15))
      tube(
          wood,
          smooth(Curve3{fork - dvec3(0, 0.15, 0), fork + out * (0.35 * reach) + dvec3(0, 0.5 * rise, 0), tip},
                 n),
          0.08, 0.02, s);
    add_bush(leaves, model, lod, moved(tip), 0.95, lod.filling(700), 0.17, 0.0,
             key("crown", number * 16 + static_cast<uint64_t>(i)));
  }
  add_bush(leaves, model, lod, moved(fork + dvec3(0, 2.0, 0)), 1.25, lod.filling(1100), 0.17, 0.0,
           key("crown", number * 16 + 15));
  model.add(std::move(wood), m.bark, "tree", moved(at));
  model.add(std::move(leaves), m.leaf, "tree_leaves", moved(at));
  if (!lod.wants(0.3)) return;
  for (int i = 0; i < 3; ++i)
    ring(grate, {0, 0.005, 0}, {1, 0, 0}, {0, 0, 1}, 0.35 + 0.17 * i, 0.016, lod.segments(40, 8),
         lod.segments(6, 4));
  for (int i = 0; i < 16; ++i) {
    const dvec3 out(std::cos(kPi * i / 8.0), 0, std::sin(kPi * i / 8.0));
    tube(grate, {out * 0.34 + dvec3(0, 0.004, 0), out * 0.7 + dvec3(0, 0.004, 0)}, 0.012, lod.segments(6, 4));
  }
  model.add(std::move(grate), m.iron, "tree_grate", moved(at));
}

void add_fountain(Model& model, const Materials& m, const dvec3& at) {
  const Lod lod = model.lod(key("fountain"));
  if (!lod.wants(0.04)) return;
  const int sides = lod.segments(64, 8);
  MeshBuilder stone = model.part(), water = model.part(), figure = model.part();
  lathe(stone,
        smooth(Curve2{{1.5, -0.03},
                      {1.5, 0.14},
                      {1.36, 0.2},
                      {1.38, 0.42},
                      {1.5, 0.52},
                      {1.48, 0.58},
                      {1.28, 0.57},
                      {1.22, 0.4},
                      {1.15, 0.15},
                      {0.6, 0.1},
                      {0.0, 0.1}},
               lod.segments(36, 8)),
        sides);
  lathe(
      stone,
      smooth(
          Curve2{{0.42, 0.05}, {0.3, 0.3}, {0.2, 0.5}, {0.24, 0.95}, {0.34, 1.05}, {0.3, 1.15}, {0.0, 1.18}},
          lod.segments(24, 6)),
      sides);
  ball(figure, {0, 1.52, 0}, 0.36, lod.segments(64, 8), lod.segments(36, 6));
  water.surface(sides, lod.segments(18, 2), {.closed_u = true, .pole_end = true}, [&](double u, double v) {
    const double r = 1.285 * (1.0 - v), a = 2.0 * kPi * u;
    return dvec3(r * std::cos(a), 0.46 + 0.006 * std::sin(24.0 * r) * v, -r * std::sin(a));
  });
  model.add(std::move(stone), m.stone, "fountain", moved(at));
  model.add(std::move(figure), m.chrome, "fountain_ball", moved(at));
  model.add(std::move(water), m.sheet, "fountain_water", moved(at));
}

}  // namespace

void add_trees(Model& model, const Materials& m) {
  add_tree(model, m, {-8.4, kPavement, -17.0}, 0);
  add_tree(model, m, {4.6, kPavement, -17.2}, 1);
  add_tree(model, m, {-9.4, kPavement, -7.4}, 2);
  add_tree(model, m, {7.3, kPavement, -8.0}, 3);
  add_fountain(model, m, {-1.6, kPavement, -15.2});
}

}  // namespace hybray::procedural::street_parts
