// A clearing among trees and bushes whose leaves are cut out of flat pieces: rays have to ask a mask again
// and again before they hit or pass.
//
// Each leaf is two triangles that share its midrib as the edge from their second to their third vertex, as
// the masks of core/scene/cut_out.h want it.
#include "core/scene/procedural/model.h"
#include "core/scene/procedural/shapes.h"

#include <array>

namespace hybray::procedural {
namespace {

constexpr double kHalf = 14.0;  // half of the ground's side, metres

struct Materials {
  uint32_t soil, path, bark, stone, oak, beech, fern;
};

Materials make_materials(Model& model) {
  const auto cut = [&](const char* name, const vec3& color, CutOut shape) {
    return model.material({.name = name, .base_color = color, .roughness = 0.5f, .cut_out = shape});
  };
  return {model.material({.name = "soil", .base_color = vec3(0.13f, 0.10f, 0.05f)}),
          model.material({.name = "path", .base_color = vec3(0.38f, 0.34f, 0.27f)}),
          model.material({.name = "bark", .base_color = vec3(0.20f, 0.14f, 0.09f)}),
          model.material({.name = "stone", .base_color = vec3(0.45f, 0.44f, 0.42f), .roughness = 0.3f}),
          cut("oak_leaf", {0.12f, 0.26f, 0.05f}, CutOut::leaf),
          cut("beech_leaf", {0.22f, 0.32f, 0.07f}, CutOut::leaf),
          cut("fern_leaf", {0.07f, 0.22f, 0.06f}, CutOut::fern)};
}

double ground_height(double x, double z) {
  const double dip = 0.10 * std::sin(0.45 * x) * std::cos(0.38 * z) + 0.06 * std::sin(0.9 * z + 0.4 * x);
  return dip - 0.10;
}

// A leaf from `base` along `along`, its halves `half_width` wide and folded up by `fold` (radians).
void add_leaf(MeshBuilder& part, const dvec3& base, const dvec3& along, const dvec3& across,
              double half_width, double fold) {
  const dvec3 tip = base + along, middle = base + 0.5 * along;
  const dvec3 up = glm::normalize(glm::cross(along, across));
  const dvec3 rise = half_width * std::sin(fold) * up, out = half_width * std::cos(fold) * across;
  const std::array<dvec3, 3> left{middle - out + rise, base, tip}, right{middle + out + rise, tip, base};
  part.face(left);
  part.face(right);
}

dvec3 random_direction(Dice& dice) {
  const double y = dice(-1.0, 1.0), a = dice(0.0, 2.0 * kPi), r = std::sqrt(1.0 - y * y);
  return {r * std::cos(a), y, r * std::sin(a)};
}

struct Crown {
  dvec3 center, radii;
  double leaf;  // length of a leaf
};

void add_crown(MeshBuilder& leaves, const Crown& crown, int count, Dice& dice) {
  if (leaves.counting()) {
    leaves.add_count(2 * static_cast<size_t>(count));
    return;
  }
  for (int i = 0; i < count; ++i) {
    const dvec3 out = random_direction(dice);
    const double depth = std::cbrt(dice(0.12, 1.0));
    const dvec3 at = crown.center + crown.radii * out * depth;
    const dvec3 along = glm::normalize(out + 0.9 * random_direction(dice) - dvec3(0, 0.35, 0));
    const dvec3 across = glm::normalize(glm::cross(along, random_direction(dice)));
    const double length = crown.leaf * dice(0.7, 1.2);
    add_leaf(leaves, at, length * along, across, 0.42 * length, dice(0.05, 0.5));
  }
}

void add_tree(Model& model, const Materials& m, const dvec3& at, double height, uint64_t number) {
  const Lod lod = model.lod(key("tree", number));
  Dice dice = model.dice(key("tree", number));
  MeshBuilder wood = model.part(), leaves = model.part();
  const int sides = lod.segments(10, 4), n = lod.segments(6, 2);
  const double lean = dice(-0.4, 0.4);
  const dvec3 fork(lean, 0.5 * height, -0.6 * lean), top(1.3 * lean, 0.86 * height, -0.4 * lean);
  tube(wood, smooth(Curve3{{0, -0.15, 0}, {0.2 * lean, 0.2 * height, 0}, fork, top}, 2 * n), 0.03 * height,
       0.008 * height, sides);
  const double crown = 0.27 * height;
  add_crown(leaves, {top, dvec3(crown, 0.8 * crown, crown), 0.30}, lod.filling(1500), dice);
  for (int i = 0; i < 5; ++i) {
    const double yaw = 2.0 * kPi * i / 5 + dice(-0.4, 0.4), reach = height * dice(0.22, 0.30);
    const dvec3 tip = fork + dvec3(reach * std::cos(yaw), height * dice(0.08, 0.24), reach * std::sin(yaw));
    if (lod.wants(0.1))
      tube(wood, smooth(Curve3{fork, 0.5 * (fork + tip) - dvec3(0, 0.04 * height, 0), tip}, n),
           0.013 * height, 0.004 * height, sides);
    const double r = height * dice(0.15, 0.2);
    add_crown(leaves, {tip, dvec3(r, 0.7 * r, r), 0.30}, lod.filling(1100), dice);
  }
  model.add(std::move(wood), m.bark, "tree", moved(at));
  model.add(std::move(leaves), number % 2 ? m.oak : m.beech, "tree_leaves", moved(at));
}

void add_bush(Model& model, const Materials& m, const dvec3& at, double radius, uint64_t number) {
  const Lod lod = model.lod(key("bush", number));
  Dice dice = model.dice(key("bush", number));
  MeshBuilder leaves = model.part();
  add_crown(leaves, {{0, 0.62 * radius, 0}, dvec3(radius, 0.75 * radius, radius), 0.17}, lod.filling(900),
            dice);
  model.add(std::move(leaves), number % 3 ? m.beech : m.oak, "bush", moved(at));
}

// Fronds that rise from one point and bend outward, in three pieces each.
void add_fern(Model& model, const Materials& m, const dvec3& at, uint64_t number) {
  const Lod lod = model.lod(key("fern", number));
  Dice dice = model.dice(key("fern", number));
  MeshBuilder fronds = model.part();
  const int count = lod.filling(11);
  for (int i = 0; i < count; ++i) {
    const double yaw = dice(0.0, 2.0 * kPi), length = dice(0.55, 0.95), steep = dice(0.8, 1.25);
    const dvec3 out(std::cos(yaw), 0, std::sin(yaw)), across(-out.z, 0, out.x);
    dvec3 base(0.02 * out);
    for (int k = 0; k < 3; ++k) {
      const double pitch = steep - 0.55 * k;
      const dvec3 along = (length / 3.0) * (std::cos(pitch) * out + std::sin(pitch) * dvec3(0, 1, 0));
      // Neighbouring pieces overlap, because a mask tapers toward both ends of its midrib.
      add_leaf(fronds, base - 0.25 * along, 1.5 * along, across, (0.15 - 0.03 * k) * length / 0.75, 0.15);
      base += along;
    }
  }
  model.add(std::move(fronds), m.fern, "fern", moved(at));
}

void add_ground(Model& model, const Materials& m) {
  const int cells = model.lod(key("ground")).segments(48, 6);
  MeshBuilder ground = model.part();
  ground.surface(cells, cells, {}, [](double u, double v) {
    const double x = kHalf * (2.0 * u - 1.0), z = kHalf * (1.0 - 2.0 * v);
    return dvec3(x, ground_height(x, z), z);
  });
  model.add(std::move(ground), m.soil, "ground");
  for (int i = 0; i < 9; ++i) {  // stepping stones
    Dice dice = model.dice(key("step", static_cast<uint64_t>(i)));
    MeshBuilder step = model.part();
    step.box({-0.45, -0.3, -0.3}, {0.45, 0.06, 0.3}, kAllFaces & ~kBottom);
    model.add(std::move(step), m.path, "step",
              moved({dice(-0.3, 0.3), 0, 7.0 - 1.6 * i}) * turned(dice(-0.4, 0.4)));
  }
  MeshBuilder bench = model.part(), stone = model.part();
  bench.box({-0.8, 0.38, -0.25}, {0.8, 0.46, 0.25});
  bench.box({-0.7, -0.3, -0.2}, {-0.5, 0.38, 0.2}, kAllFaces & ~(kBottom | kTop));
  bench.box({0.5, -0.3, -0.2}, {0.7, 0.38, 0.2}, kAllFaces & ~(kBottom | kTop));
  model.add(std::move(bench), m.stone, "bench", moved({-2.1, 0, -1.5}) * turned(1.2));
  const Lod lod = model.lod(key("boulder"));
  ball(stone, {2.4, 0.1, 0.6}, 0.55, lod.even_segments(24, 6), lod.segments(14, 4));
  model.add(std::move(stone), m.stone, "boulder");
}

void layout(Model& model) {
  const Materials m = make_materials(model);
  add_ground(model, m);
  const std::array<dvec3, 12> trees{{{-5.6, 0, 4.2},
                                     {5.2, 0, 3.6},
                                     {-5.2, 0, -3.4},
                                     {5.8, 0, -4.0},
                                     {-2.0, 0, -8.6},
                                     {3.4, 0, -9.6},
                                     {-10.2, 0, 0.4},
                                     {10.4, 0, 0.2},
                                     {-9.4, 0, -8.8},
                                     {9.8, 0, -8.4},
                                     {-9.6, 0, 9.0},
                                     {9.2, 0, 9.4}}};
  for (size_t i = 0; i < trees.size(); ++i) {
    Dice dice = model.dice(key("height", i));
    add_tree(model, m, trees[i] + dvec3(0, ground_height(trees[i].x, trees[i].z), 0), dice(5.2, 7.0), i);
  }
  for (uint64_t i = 0; i < 22; ++i) {
    Dice dice = model.dice(key("bush_place", i));
    const double side = i % 2 ? 1.0 : -1.0;
    const double x = side * dice(2.6, 11.0), z = dice(-11.5, 10.5);
    add_bush(model, m, {x, ground_height(x, z), z}, dice(0.5, 0.95), i);
  }
  for (uint64_t i = 0; i < 220; ++i) {
    Dice dice = model.dice(key("fern_place", i));
    const double side = i % 2 ? 1.0 : -1.0;
    const double x = side * (0.9 + 10.0 * std::pow(dice(0.0, 1.0), 1.6)), z = dice(-12.5, 11.0);
    if (std::hypot(x + 2.1, z + 1.5) < 1.2 || std::hypot(x - 2.4, z - 0.6) < 0.9) continue;
    add_fern(model, m, {x, ground_height(x, z), z}, i);
  }
  model.light({.name = "sun",
               .kind = LightKind::directional,
               .direction = glm::normalize(vec3(0.5f, -1.0f, -0.35f)),
               .color = vec3(1.0f, 0.94f, 0.82f),
               .intensity = 7.0f});
  model.camera("path", {0.2f, 1.6f, 9.0f}, {-0.1f, 1.2f, 0.0f}, 65.0f);
  model.camera("bench", {0.5f, 1.35f, 1.2f}, {-2.6f, 0.7f, -2.2f}, 65.0f);
  model.camera("ferns", {0.1f, 0.75f, 4.6f}, {2.8f, 0.35f, 1.0f}, 65.0f);
  model.camera("crowns", {0.0f, 1.6f, -1.0f}, {-3.6f, 4.6f, -5.0f}, 70.0f);
}

}  // namespace

Scene foliage(const Parameters& parameters) {
  return build("foliage", parameters, uint32_t{3} << 17, layout);
}

}  // namespace hybray::procedural
