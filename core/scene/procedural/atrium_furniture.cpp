// What stands and hangs in the atrium: the fountain, pots with plants, pedestals, benches, lamps and
// chandeliers.
#include "core/scene/procedural/atrium.h"

namespace hybray::procedural::atrium_parts {
namespace {

void add_fountain(Model& model, const Materials& m) {
  const Lod lod = model.lod(key("fountain"));
  const int sides = lod.segments(72, 6), curve = lod.segments(24, 3);
  MeshBuilder basin = model.part(), pool = model.part(), column = model.part(), bowl_water = model.part();
  if (!lod.wants(0.04)) return;
  lathe(basin,
        smooth(Curve2{{1.78, -0.03},
                      {1.72, 0.1},
                      {1.6, 0.2},
                      {1.6, 0.4},
                      {1.74, 0.5},
                      {1.78, 0.58},
                      {1.7, 0.62},
                      {1.5, 0.61},
                      {1.45, 0.5},
                      {1.42, 0.25},
                      {1.3, 0.12},
                      {0.7, 0.1},
                      {0.0, 0.1}},
               curve),
        sides);
  model.add(std::move(basin), m.pale_stone, "fountain_basin");
  if (!lod.wants(0.1)) return;
  const auto ripples = [&](MeshBuilder& part, double radius, double y, int rings) {
    part.surface(sides, rings, {.closed_u = true, .pole_end = true}, [&](double u, double v) {
      const double r = radius * (1.0 - v), a = 2.0 * kPi * u;
      return dvec3(r * std::cos(a), y + 0.006 * std::sin(22.0 * r) * (1.0 - r / radius), -r * std::sin(a));
    });
  };
  ripples(pool, 1.5, 0.47, lod.segments(30, 3));
  model.add(std::move(pool), m.water, "fountain_pool");
  lathe(column,
        smooth(Curve2{{0.34, 0.05},
                      {0.3, 0.2},
                      {0.16, 0.34},
                      {0.14, 0.6},
                      {0.22, 0.78},
                      {0.15, 0.92},
                      {0.14, 1.1},
                      {0.3, 1.2},
                      {0.66, 1.3},
                      {0.8, 1.42},
                      {0.79, 1.47},
                      {0.72, 1.46},
                      {0.5, 1.34},
                      {0.2, 1.28},
                      {0.1, 1.32},
                      {0.09, 1.6},
                      {0.16, 1.7},
                      {0.09, 1.82},
                      {0.0, 1.9}},
               lod.segments(60, 12)),
        sides);
  model.add(std::move(column), m.pale_stone, "fountain_column");
  ripples(bowl_water, 0.74, 1.42, lod.segments(16, 2));
  model.add(std::move(bowl_water), m.water, "fountain_bowl");
}

void add_pot(Model& model, const Materials& m, const dvec3& at, uint64_t number) {
  const Lod lod = model.lod(key("pot", number));
  if (!lod.wants(0.12)) return;
  Dice dice = model.dice(key("pot", number));
  const double size = dice(0.9, 1.25);
  const int sides = lod.segments(36, 6);
  MeshBuilder pot = model.part(), soil = model.part();
  for (auto* part : {&pot, &soil}) part->set_frame(glm::scale(dmat4(1.0), dvec3(size)));
  lathe(pot,
        smooth(Curve2{{0.19, -0.02},
                      {0.23, 0.08},
                      {0.31, 0.28},
                      {0.3, 0.42},
                      {0.25, 0.5},
                      {0.31, 0.55},
                      {0.32, 0.59},
                      {0.28, 0.6},
                      {0.25, 0.56},
                      {0.24, 0.48}},
               lod.segments(26, 4)),
        sides);
  lathe(soil, {{0.272, 0.51}, {0.12, 0.54}, {0.0, 0.55}}, sides);
  model.add(std::move(pot), m.terracotta, "pot", moved(at));
  model.add(std::move(soil), m.soil, "pot_soil", moved(at));
  MeshBuilder leaves = model.part();
  const int count = 4 + lod.filling(50), cut = lod.segments(6, 2);
  for (int i = 0; i < count; ++i) {
    Dice each = model.dice(key("leaf", number * 100000 + static_cast<uint64_t>(i)));
    const double yaw = each(0.0, 2.0 * kPi), pitch = each(0.35, 1.35), length = each(0.35, 0.8);
    leaves.set_frame(moved({0.1 * std::cos(yaw), 0.52 * size, 0.1 * std::sin(yaw)}) * turned(yaw) *
                     turned(-pitch, dvec3(1, 0, 0)));
    leaf(leaves, length, each(0.06, 0.12), each(0.1, 0.4) * length, cut);
  }
  model.add(std::move(leaves), m.leaf, "pot_leaves", moved(at));
}

// A stone pedestal with a vase, a mirror ball or a glass ball on it.
void add_pedestal(Model& model, const Materials& m, const dvec3& at, uint64_t number) {
  const Lod lod = model.lod(key("pedestal", number));
  if (!lod.wants(0.05)) return;
  MeshBuilder part = model.part(), top = model.part();
  part.bevelled_box({-0.34, -0.03, -0.34}, {0.34, 0.18, 0.34}, 0.03);
  part.box({-0.26, 0.15, -0.26}, {0.26, 0.95, 0.26}, kAllFaces & ~kTop & ~kBottom);
  part.bevelled_box({-0.33, 0.92, -0.33}, {0.33, 1.06, 0.33}, 0.03);
  model.add(std::move(part), m.stone, "pedestal", moved(at));
  const int sides = lod.segments(56, 8);
  if (number % 3 == 2)
    lathe(top,
          smooth(Curve2{{0.0, 1.05},
                        {0.16, 1.05},
                        {0.1, 1.12},
                        {0.09, 1.18},
                        {0.24, 1.42},
                        {0.26, 1.56},
                        {0.15, 1.72},
                        {0.12, 1.82},
                        {0.2, 1.92},
                        {0.18, 1.92},
                        {0.1, 1.83},
                        {0.12, 1.7},
                        {0.0, 1.4}},
                 lod.segments(48, 8)),
          sides);
  else
    ball(top, {0, 1.055 + 0.3, 0}, 0.3, sides, lod.segments(32, 5));
  model.add(std::move(top),
            number % 3 == 0   ? m.mirror
            : number % 3 == 1 ? m.glass
                              : m.brass,
            "pedestal_piece", moved(at));
}

void add_bench(Model& model, const Materials& m, const dmat4& frame, uint64_t number) {
  const Lod lod = model.lod(key("bench", number));
  if (!lod.wants(0.15)) return;
  MeshBuilder part = model.part();
  for (int i = 0; i < 4; ++i)
    part.bevelled_box({-0.9, 0.42, -0.2 + 0.11 * i}, {0.9, 0.46, -0.11 + 0.11 * i}, 0.01);
  for (const double x : {-0.7, 0.62}) {
    part.bevelled_box({x, -0.02, -0.19}, {x + 0.08, 0.43, -0.11}, 0.012);
    part.bevelled_box({x, -0.02, 0.12}, {x + 0.08, 0.43, 0.2}, 0.012);
    part.box({x + 0.01, 0.33, -0.15}, {x + 0.07, 0.425, 0.16});
  }
  model.add(std::move(part), m.wood, "bench", frame);
}

// A lantern on a chain from the crown of an aisle's vault, with its light.
void add_lantern(Model& model, const Materials& m, const Place& bay, double crown, double low,
                 const vec3& world) {
  const Lod lod = model.lod(key("lantern", bay.number + (low > 5 ? 100 : 0)));
  if (lod.wants(0.2)) {
    MeshBuilder metal = model.part(), flame = model.part();
    for (auto* part : {&metal, &flame}) part->set_frame(moved({0, low, -0.5 * kAisle}));
    const int sides = lod.segments(16, 5);
    tube(metal, {{0, 0.4, 0}, {0, crown - low, 0}}, 0.012, lod.segments(6, 3));
    lathe(
        metal,
        smooth(Curve2{{0.0, 0.29}, {0.17, 0.28}, {0.1, 0.33}, {0.03, 0.42}, {0.0, 0.45}}, lod.segments(8, 3)),
        sides);
    ring(metal, {0, 0.28, 0}, {1, 0, 0}, {0, 0, 1}, 0.165, 0.014, sides, lod.segments(6, 3));
    ring(metal, {0, -0.1, 0}, {1, 0, 0}, {0, 0, 1}, 0.12, 0.016, sides, lod.segments(6, 3));
    lathe(metal, smooth(Curve2{{0.0, -0.2}, {0.04, -0.17}, {0.12, -0.1}, {0.0, -0.06}}, lod.segments(8, 4)),
          sides);
    for (int i = 0; i < 6; ++i) {
      const double a = kPi * i / 3.0;
      tube(metal,
           {{0.12 * std::cos(a), -0.1, 0.12 * std::sin(a)}, {0.165 * std::cos(a), 0.28, 0.165 * std::sin(a)}},
           0.008, lod.segments(6, 3));
    }
    ball(flame, {0, 0.08, 0}, 0.06, lod.segments(14, 5), lod.segments(9, 3));
    model.add(std::move(metal), m.iron, "lantern", bay.frame);
    model.add(std::move(flame), m.flame, "lantern_flame", bay.frame);
  }
  model.light({.name = "lantern", .position = world, .color = vec3(1.0f, 0.7f, 0.4f), .intensity = 5.0f});
}

void add_chandelier(Model& model, const Materials& m, double x, uint64_t number) {
  const double y = 6.4;
  model.light({.name = "chandelier",
               .position = vec3(static_cast<float>(x), static_cast<float>(y - 0.15), 0.0f),
               .color = vec3(1.0f, 0.72f, 0.42f),
               .intensity = 14.0f});
  const Lod lod = model.lod(key("chandelier", number));
  if (!lod.wants(0.25)) return;
  MeshBuilder metal = model.part(), flames = model.part();
  const double crown = kRoof + 0.3 + 3.2;
  const int sides = lod.segments(8, 3);
  tube(metal, {{x, y + 0.9, 0}, {x, crown, 0}}, 0.015, sides);
  ring(metal, {x, y, 0}, {1, 0, 0}, {0, 0, 1}, 0.9, 0.035, lod.segments(64, 8), lod.segments(10, 4));
  for (int i = 0; i < 12; ++i) {
    const double a = kPi * i / 6.0;
    const dvec3 foot(x + 0.9 * std::cos(a), y, 0.9 * std::sin(a));
    metal.set_frame(moved(foot));
    lathe(metal,
          smooth(Curve2{{0.0, 0.0},
                        {0.03, 0.02},
                        {0.07, 0.07},
                        {0.065, 0.085},
                        {0.025, 0.07},
                        {0.02, 0.22},
                        {0.0, 0.22}},
                 lod.segments(14, 6)),
          lod.segments(12, 4));
    metal.set_frame(dmat4(1.0));
    if (i % 3 == 0) tube(metal, {foot, {x, y + 0.92, 0}}, 0.01, sides);
    flames.set_frame(moved(foot + dvec3(0, 0.25, 0)));
    lathe(flames, smooth(Curve2{{0.0, -0.05}, {0.02, -0.01}, {0.018, 0.03}, {0.0, 0.08}}, lod.segments(8, 3)),
          lod.segments(8, 4));
  }
  model.add(std::move(metal), m.brass, "chandelier");
  model.add(std::move(flames), m.flame, "chandelier_flames");
}

}  // namespace

void add_furniture(Model& model, const Materials& m) {
  add_fountain(model, m);
  uint64_t pot = 0;
  for (const double x : {-9.6, -6.4, -3.2, 3.2, 6.4, 9.6})
    for (const double side : {-1.0, 1.0}) add_pot(model, m, {x, 0, side * (kRingZ - 0.95)}, pot++);
  for (const double x : {-13.6, 13.6})
    for (const double z : {-7.2, 7.2}) add_pot(model, m, {x, 0, z}, pot++);
  add_pedestal(model, m, {-5.2, 0, 2.1}, 0);
  add_pedestal(model, m, {5.4, 0, -2.0}, 1);
  add_pedestal(model, m, {-5.2, 0, -2.1}, 2);
  add_pedestal(model, m, {5.4, 0, 2.0}, 3);
  for (uint64_t i = 0; i < 4; ++i) add_bench(model, m, moved({i % 2 ? 4.8 : -4.8, 0, i < 2 ? -7.9 : 7.9}), i);
  for (const Place& bay : bays()) {
    if (bay.number % 3 != 0) continue;
    for (const bool upper : {false, true}) {
      const double low = upper ? kGallery + 2.6 : 2.9, crown = upper ? kRoof + 0.02 : 5.2;
      const dvec4 world = bay.frame * dvec4(0, low - 0.3, -0.5 * kAisle, 1);
      add_lantern(model, m, bay, crown, low, vec3(dvec3(world)));
    }
  }
  add_chandelier(model, m, -1.5 * kBay, 0);
  add_chandelier(model, m, 1.5 * kBay, 1);
}

}  // namespace hybray::procedural::atrium_parts
