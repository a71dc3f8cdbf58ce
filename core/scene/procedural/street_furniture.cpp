// Lamps, cables with bulbs, bollards and chains, benches, bins and tubs with plants.
#include "core/scene/procedural/street.h"

namespace hybray::procedural::street_parts {
namespace {

void add_lamp(Model& model, const Materials& m, const dvec3& at, double yaw, uint64_t number) {
  const Lod lod = model.lod(key("lamp", number));
  const dmat4 frame = moved(at) * turned(yaw);
  if (lod.wants(0.08)) {
    MeshBuilder post = model.part(), lantern = model.part(), bulb = model.part();
    const int sides = lod.segments(20, 5), thin = lod.segments(10, 4);
    lathe(post,
          smooth(Curve2{{0.2, -0.02},
                        {0.19, 0.12},
                        {0.13, 0.2},
                        {0.15, 0.32},
                        {0.09, 0.5},
                        {0.1, 0.62},
                        {0.065, 0.8},
                        {0.055, 2.0},
                        {0.05, 3.2},
                        {0.075, 3.3},
                        {0.05, 3.4},
                        {0.045, 3.85},
                        {0.06, 3.95},
                        {0.0, 4.1}},
                 lod.segments(40, 8)),
          sides);
    const Curve3 arm = smooth(
        Curve3{
            {0, 3.35, 0}, {0, 3.55, 0.25}, {0, 3.9, 0.45}, {0, 4.02, 0.75}, {0, 3.9, 0.95}, {0, 3.78, 0.98}},
        lod.segments(20, 5));
    tube(post, arm, 0.028, 0.02, thin);
    if (lod.wants(0.25))
      ring(post, {0, 3.62, 0.12}, {0, 1, 0}, {0, 0, 1}, 0.1, 0.014, lod.segments(24, 8), lod.segments(8, 3));
    const dmat4 head = moved({0, 0, 0.98});
    post.set_frame(head);
    lathe(post,
          smooth(Curve2{{0.0, 3.6}, {0.16, 3.59}, {0.13, 3.66}, {0.05, 3.73}, {0.04, 3.79}, {0.0, 3.8}},
                 lod.segments(14, 5)),
          sides);
    lathe(post, smooth(Curve2{{0.0, 3.14}, {0.05, 3.16}, {0.095, 3.23}, {0.0, 3.24}}, lod.segments(9, 4)),
          sides);
    for (int i = 0; i < 6; ++i) {
      const double a = kPi * i / 3.0;
      tube(
          post,
          {{0.085 * std::cos(a), 3.22, 0.085 * std::sin(a)}, {0.145 * std::cos(a), 3.6, 0.145 * std::sin(a)}},
          0.008, lod.segments(6, 3));
    }
    lantern.set_frame(head);
    lathe(lantern, {{0.078, 3.235}, {0.136, 3.597}}, 6);
    bulb.set_frame(head);
    ball(bulb, {0, 3.42, 0}, 0.055, lod.segments(14, 5), lod.segments(10, 3));
    model.add(std::move(post), m.iron, "street_lamp", frame);
    if (lod.wants(0.2)) model.add(std::move(lantern), m.sheet, "lamp_glass", frame);
    model.add(std::move(bulb), m.bulb, "lamp_bulb", frame);
  }
  const dvec4 bulb_at = frame * dvec4(0, 3.3, 0.98, 1);
  if (number % 2 == 0)
    model.light({.name = "street_lamp",
                 .position = vec3(dvec3(bulb_at)) - vec3(0, 0.2f, 0),
                 .color = vec3(1.0f, 0.72f, 0.42f),
                 .intensity = 6.0f});
}

// A cable that sags between two facades, with bulbs on it.
void add_cable(Model& model, const Materials& m, const dvec3& a, const dvec3& b, double sag,
               uint64_t number) {
  const Lod lod = model.lod(key("cable", number));
  if (!lod.wants(0.12)) return;
  MeshBuilder cable = model.part(), bulbs = model.part();
  const auto at = [&](double t) { return glm::mix(a, b, t) - dvec3(0, 4.0 * sag * t * (1.0 - t), 0); };
  const int n = lod.segments(48, 6);
  Curve3 path;
  for (int i = 0; i <= n; ++i) path.push_back(at(static_cast<double>(i) / n));
  tube(cable, path, 0.011, lod.segments(6, 3));
  const int count = 14;
  for (int i = 1; i < count && lod.wants(0.2); ++i) {
    const dvec3 p = at(static_cast<double>(i) / count);
    cable.set_frame(moved(p));
    lathe(cable, {{0.0, -0.09}, {0.02, -0.085}, {0.024, -0.01}, {0.0, 0.012}}, lod.segments(10, 4));
    ball(bulbs, p - dvec3(0, 0.125, 0), 0.045, lod.segments(14, 5), lod.segments(10, 3));
  }
  model.add(std::move(cable), m.rubber, "cable");
  model.add(std::move(bulbs), m.bulb, "bulb");
}

// Bollards along a line with chains between them.
void add_bollards(Model& model, const Materials& m, const dvec3& from, const dvec3& to, int count,
                  uint64_t number) {
  const Lod lod = model.lod(key("bollards", number));
  if (!lod.wants(0.1)) return;
  MeshBuilder posts = model.part(), chain = model.part();
  const int sides = lod.segments(18, 5), curve = lod.segments(20, 5);
  const Curve2 profile = smooth(Curve2{{0.1, -0.02},
                                       {0.09, 0.1},
                                       {0.07, 0.16},
                                       {0.06, 0.6},
                                       {0.085, 0.66},
                                       {0.05, 0.72},
                                       {0.09, 0.8},
                                       {0.07, 0.88},
                                       {0.0, 0.91}},
                                curve);
  const dvec3 step = (to - from) / static_cast<double>(count - 1);
  const double yaw = std::atan2(-step.z, step.x);
  for (int i = 0; i < count; ++i) {
    posts.set_frame(moved(from + step * static_cast<double>(i)));
    lathe(posts, profile, sides);
    if (i + 1 == count || !lod.wants(0.5)) continue;
    const double length = glm::length(step) - 0.14;
    const int links = static_cast<int>(length / 0.058);
    for (int k = 0; k < links; ++k) {  // every other link stands upright
      const double t = (k + 0.5) / links, slope = -1.6 * (1.0 - 2.0 * t) * 0.6;
      chain.set_frame(moved(from + step * static_cast<double>(i)) * turned(yaw) *
                      moved({0.07 + length * t, 0.68 - 0.9 * t * (1.0 - t) * 1.1, 0}) *
                      turned(std::atan(slope * 0.55), dvec3(0, 0, 1)));
      const dvec3 across = k % 2 ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
      ring(chain, dvec3(0), {1.35, 0, 0}, across, 0.027, 0.008, lod.segments(12, 6), lod.segments(6, 3));
    }
  }
  model.add(std::move(posts), m.iron, "bollard");
  model.add(std::move(chain), m.steel, "chain");
}

void add_bench(Model& model, const Materials& m, const dmat4& frame, uint64_t number) {
  const Lod lod = model.lod(key("bench", number));
  if (!lod.wants(0.12)) return;
  MeshBuilder slats = model.part(), sides_part = model.part();
  for (int i = 0; i < 5; ++i)
    slats.bevelled_box({-0.85, 0.43, -0.2 + 0.09 * i}, {0.85, 0.46, -0.125 + 0.09 * i}, 0.008);
  for (int i = 0; i < 4; ++i) {
    slats.set_frame(moved({0, 0.52 + 0.1 * i, -0.235 - 0.025 * i}) * turned(-0.25, dvec3(1, 0, 0)));
    slats.bevelled_box({-0.85, 0, -0.015}, {0.85, 0.075, 0.012}, 0.008);
  }
  const int n = lod.segments(22, 6), s = lod.segments(8, 4);
  for (const double x : {-0.72, 0.72}) {
    tube(sides_part,
         smooth(Curve3{{x, -0.01, 0.24},
                       {x, 0.2, 0.2},
                       {x, 0.4, 0.24},
                       {x, 0.42, 0.05},
                       {x, 0.4, -0.2},
                       {x, 0.6, -0.28},
                       {x, 0.93, -0.36}},
                n),
         0.022, s);
    tube(sides_part, smooth(Curve3{{x, -0.01, -0.3}, {x, 0.2, -0.22}, {x, 0.41, -0.2}}, lod.segments(8, 2)),
         0.022, s);
    tube(sides_part,
         smooth(Curve3{{x, 0.4, 0.24}, {x, 0.6, 0.26}, {x, 0.67, 0.12}, {x, 0.66, -0.1}, {x, 0.7, -0.3}},
                lod.segments(16, 4)),
         0.018, s);
  }
  model.add(std::move(slats), m.wood, "bench_slats", frame);
  model.add(std::move(sides_part), m.iron, "bench_iron", frame);
}

// A round tub with a bush, or (odd numbers) a square one with a cone of leaves.
void add_tub(Model& model, const Materials& m, const dvec3& at, uint64_t number) {
  const Lod lod = model.lod(key("tub", number));
  if (!lod.wants(0.06)) return;
  MeshBuilder tub = model.part(), soil = model.part(), leaves = model.part();
  const int sides = lod.segments(28, 6);
  const double top = number % 2 ? 0.5 : 0.56;
  if (number % 2) {
    tub.bevelled_box({-0.28, -0.02, -0.28}, {0.28, top, 0.28}, 0.02);
    for (int i = 0; i < 4; ++i) {
      tub.set_frame(turned(0.5 * kPi * i));
      tub.bevelled_box({-0.31, -0.03, 0.23}, {-0.23, top + 0.05, 0.31}, 0.012);
    }
    tub.set_frame(dmat4(1.0));
    lathe(soil, {{0.2, top - 0.02}, {0.12, top + 0.03}, {0.0, top + 0.05}}, sides);
  } else {
    lathe(tub,
          smooth(Curve2{{0.22, -0.02},
                        {0.26, 0.1},
                        {0.33, 0.3},
                        {0.34, 0.46},
                        {0.38, 0.52},
                        {0.38, 0.57},
                        {0.33, 0.58},
                        {0.31, 0.53},
                        {0.3, 0.46}},
                 lod.segments(20, 4)),
          sides);
    lathe(soil, {{0.32, 0.5}, {0.15, 0.53}, {0.0, 0.54}}, sides);
  }
  model.add(std::move(tub), number % 2 ? m.shutter[number % 4] : m.terracotta, "tub", moved(at));
  model.add(std::move(soil), m.soil, "tub_soil", moved(at));
  if (number % 2)
    for (int i = 0; i < 5; ++i)
      add_bush(leaves, model, lod, moved({0, top + 0.2 + 0.2 * i, 0}), 0.36 - 0.06 * i,
               2 + lod.filling(110 - 18 * i), 0.12, 0.15, key("cone", number * 8 + static_cast<uint64_t>(i)));
  else
    add_bush(leaves, model, lod, moved({0, top + 0.22, 0}), 0.42, 6 + lod.filling(330), 0.16, 0.3,
             key("bush", number));
  model.add(std::move(leaves), number % 2 ? m.dark_leaf : m.leaf, "tub_leaves", moved(at));
}

}  // namespace

void add_furniture(Model& model, const Materials& m) {
  const std::array<std::pair<dvec3, double>, 12> lamps{{{{-40, kPavement, -4.3}, 0.0},
                                                        {{-31, kPavement, 4.2}, kPi},
                                                        {{-22.5, kPavement, -4.2}, 0.0},
                                                        {{-14.5, kPavement, 4.1}, kPi},
                                                        {{-9.8, kPavement, -5.0}, kPi},
                                                        {{6.8, kPavement, -5.2}, kPi},
                                                        {{-8.5, kPavement, -18.5}, 0.8},
                                                        {{3.5, kPavement, -18.6}, -0.8},
                                                        {{3, kPavement, 4.5}, kPi},
                                                        {{17, kPavement, -1.0}, 0.3},
                                                        {{20.5, kPavement, 9.2}, kPi + 0.3},
                                                        {{33, kPavement, 4.2}, 0.3}}};
  for (size_t i = 0; i < lamps.size(); ++i) add_lamp(model, m, lamps[i].first, lamps[i].second, i);
  const std::array<std::pair<dvec3, dvec3>, 6> cables{{{{-35, 6.2, -6.5}, {-33, 6.4, 6.5}},
                                                       {{-25, 6.6, -6.5}, {-26, 6.3, 6.5}},
                                                       {{-16, 6.1, -6.6}, {-17, 6.5, 6.4}},
                                                       {{-12.3, 6.0, -12}, {9.6, 6.3, -11.5}},
                                                       {{14, 6.4, -4.36}, {9, 6.2, 7.94}},
                                                       {{28, 6.2, 0.22}, {24, 6.5, 12.6}}}};
  for (size_t i = 0; i < cables.size(); ++i) add_cable(model, m, cables[i].first, cables[i].second, 0.9, i);
  add_bollards(model, m, {-10.4, kPavement, -4.25}, {-2.0, kPavement, -4.0}, 7, 0);
  add_bollards(model, m, {1.0, kPavement, -3.9}, {8.6, kPavement, -3.25}, 6, 1);
  add_bollards(model, m, {-12.5, kPavement, 3.95}, {-5.5, kPavement, 3.9}, 6, 2);
  add_bench(model, m, moved({-6.0, kPavement, -15.6}) * turned(0.6), 0);
  add_bench(model, m, moved({1.5, kPavement, -16.2}) * turned(-0.5), 1);
  add_bench(model, m, moved({-27, kPavement, 5.2}) * turned(kPi), 2);
  add_bench(model, m, moved({7.2, kPavement, 6.3}) * turned(kPi - 0.25), 3);
  const std::array<dvec3, 22> tubs{
      {{-37.2, kPavement, -5.9},  {-33.5, kPavement, -5.9}, {-30.0, kPavement, -5.9},
       {-28.0, kPavement, -5.9},  {-24.8, kPavement, -5.9}, {-21.3, kPavement, -5.9},
       {-18.8, kPavement, -5.9},  {-13.2, kPavement, -6.0}, {-11.8, kPavement, -10.2},
       {-11.6, kPavement, -18.0}, {-6.5, kPavement, -21.3}, {-1.5, kPavement, -21.8},
       {3.6, kPavement, -21.3},   {8.0, kPavement, -16.2},  {9.2, kPavement, -9.0},
       {-36, kPavement, 5.8},     {-31.5, kPavement, 5.8},  {-20, kPavement, 5.8},
       {-8.5, kPavement, 5.6},    {2.0, kPavement, 6.0},    {15.2, kPavement, -3.2},
       {25.0, kPavement, 12.2}}};
  for (size_t i = 0; i < tubs.size(); ++i) add_tub(model, m, tubs[i], i);
}

}  // namespace hybray::procedural::street_parts
