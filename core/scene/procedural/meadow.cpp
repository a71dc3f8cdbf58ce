// A meadow with a pond: grass, reeds and seed heads as curves on a ground of triangles. A ray has to ask many
// thin, long primitives whose boxes overlap.
#include "core/scene/procedural/model.h"
#include "core/scene/procedural/shapes.h"

#include <array>

namespace hybray::procedural {
namespace {

constexpr double kHalf = 8.0;  // half of the ground's side, metres
const dvec3 kPond(2.6, -0.12, -1.4);
constexpr double kPondRadius = 1.9;

struct Materials {
  uint32_t soil, water, stone, wood, grass, straw, reed;
};

Materials make_materials(Model& model) {
  const auto plain = [&](const char* name, const vec3& color, float roughness) {
    return model.material({.name = name, .base_color = color, .roughness = roughness});
  };
  return {plain("soil", {0.14f, 0.11f, 0.06f}, 1.0f),  plain("water", {0.05f, 0.09f, 0.10f}, 0.05f),
          plain("stone", {0.44f, 0.43f, 0.41f}, 0.4f), plain("wood", {0.36f, 0.25f, 0.15f}, 0.6f),
          plain("grass", {0.16f, 0.34f, 0.06f}, 0.5f), plain("straw", {0.52f, 0.45f, 0.20f}, 0.5f),
          plain("reed", {0.24f, 0.36f, 0.12f}, 0.4f)};
}

double from_pond(double x, double z) {
  return std::hypot(x - kPond.x, z - kPond.z) / kPondRadius;
}

double ground_height(double x, double z) {
  const double swell = 0.07 * std::sin(0.7 * x) * std::cos(0.6 * z) + 0.04 * std::sin(1.3 * z + 0.5 * x);
  const double r = from_pond(x, z);
  return swell - 0.45 * std::exp(-r * r * r * r);
}

// A path of bare soil that winds from the front to the back.
double beside_path(double x, double z) {
  return std::abs(x + 0.9 - 0.6 * std::sin(0.5 * z));
}

struct Blade {
  dvec3 foot, lean;  // lean: what its tip lies beside its foot, horizontal
  double height, radius;
  bool pointed = true;
};

// Upright at the foot, leaning over toward the tip; its foot is in the ground.
void add_blade(Model& model, uint32_t material, const Blade& b) {
  const dvec3 up(0, b.height, 0);
  RoundCurve curve;
  curve.material = material;
  const auto set = [&](size_t i, const dvec3& p, double radius) {
    curve.control[i] = vec4(vec3(p), static_cast<float>(radius));
  };
  set(0, b.foot - dvec3(0, 0.03, 0), b.radius);
  set(1, b.foot + 0.40 * up + 0.05 * b.lean, 0.95 * b.radius);
  set(2, b.foot + 0.80 * up + 0.40 * b.lean, 0.75 * b.radius);
  set(3, b.foot + 0.95 * up + b.lean, b.pointed ? 0.0 : 0.6 * b.radius);
  model.curve(curve);
}

dvec3 heading(double yaw) {
  return {std::cos(yaw), 0.0, std::sin(yaw)};
}

// Whether grass grows at a place: not on the path, nor in the water, nor under the boulder and the bench.
bool grows(double x, double z) {
  return beside_path(x, z) > 0.35 && from_pond(x, z) > 0.95 && std::hypot(x + 2.6, z + 2.2) > 0.55 &&
         std::hypot(x + 2.8, z - 2.6) > 0.6;
}

void add_tuft(Model& model, const Materials& m, uint64_t number) {
  const Lod lod = model.lod(key("tuft", number));
  Dice dice = model.dice(key("tuft", number));
  const int count = lod.filling(75);
  if (model.counting()) {
    model.count_curves(static_cast<size_t>(count));
    return;
  }
  double x = 0.0, z = 0.0;
  do x = dice(-7.6, 7.6), z = dice(-7.6, 7.6);
  while (!grows(x, z));
  const bool dry = dice(0.0, 1.0) < 0.15;
  const double tall = dice(0.16, 0.42), spread = dice(0.10, 0.26);
  for (int i = 0; i < count; ++i) {
    double bx = x, bz = z;
    for (int attempt = 0; attempt < 4; ++attempt) {
      const double r = spread * std::sqrt(dice(0.0, 1.0)), a = dice(0.0, 2.0 * kPi);
      bx = x + r * std::cos(a), bz = z + r * std::sin(a);
      if (grows(bx, bz)) break;
    }
    const double height = tall * dice(0.55, 1.15);
    add_blade(model, dry ? m.straw : m.grass,
              {{bx, ground_height(bx, bz), bz},
               height * dice(0.1, 0.7) * heading(dice(0.0, 2.0 * kPi)),
               height,
               dice(0.0016, 0.0034)});
  }
}

// Reeds in and around the pond: stems with long leaves.
void add_reed(Model& model, const Materials& m, uint64_t number) {
  const Lod lod = model.lod(key("reed", number));
  Dice dice = model.dice(key("reed", number));
  const int leaves = lod.filling(5);
  if (model.counting()) {
    model.count_curves(static_cast<size_t>(leaves) + 1);
    return;
  }
  const double a = dice(-0.4, 4.2), r = kPondRadius * dice(0.72, 1.12);
  const double x = kPond.x + r * std::cos(a), z = kPond.z - r * std::sin(a);
  const dvec3 foot(x, ground_height(x, z), z);
  const double height = dice(1.0, 1.8);
  add_blade(
      model, m.reed,
      {foot, 0.12 * height * heading(dice(0.0, 2.0 * kPi)), height, dice(0.005, 0.009), number % 3 != 0});
  for (int i = 0; i < leaves; ++i) {
    const double length = height * dice(0.5, 0.9);
    add_blade(model, m.reed,
              {foot + 0.02 * heading(dice(0.0, 2.0 * kPi)),
               length * dice(0.4, 0.9) * heading(dice(0.0, 2.0 * kPi)), length, dice(0.003, 0.006)});
  }
}

void add_solids(Model& model, const Materials& m) {
  const int cells = model.lod(key("ground")).segments(96, 8);
  MeshBuilder ground = model.part(), water = model.part(), stone = model.part(), bench = model.part();
  ground.surface(cells, cells, {}, [](double u, double v) {
    const double x = kHalf * (2.0 * u - 1.0), z = kHalf * (1.0 - 2.0 * v);
    return dvec3(x, ground_height(x, z), z);
  });
  model.add(std::move(ground), m.soil, "ground");
  const double s = 1.3 * kPondRadius;
  water.quad(kPond + dvec3(-s, 0, s), kPond + dvec3(s, 0, s), kPond + dvec3(s, 0, -s),
             kPond + dvec3(-s, 0, -s));
  model.add(std::move(water), m.water, "water");
  const Lod lod = model.lod(key("boulder"));
  ball(stone, {-2.6, 0.08, -2.2}, 0.5, lod.even_segments(48, 6), lod.segments(28, 4));
  ball(stone, {0.4, 0.0, -3.4}, 0.3, lod.even_segments(40, 6), lod.segments(24, 4));
  model.add(std::move(stone), m.stone, "boulders");
  bench.box({-0.7, 0.40, -0.2}, {0.7, 0.45, 0.2});
  bench.box({-0.6, -0.3, -0.15}, {-0.5, 0.40, 0.15}, kAllFaces & ~(kBottom | kTop));
  bench.box({0.5, -0.3, -0.15}, {0.6, 0.40, 0.15}, kAllFaces & ~(kBottom | kTop));
  model.add(std::move(bench), m.wood, "bench", moved({-2.8, 0, 2.6}) * turned(0.9));
}

void layout(Model& model) {
  const Materials m = make_materials(model);
  add_solids(model, m);
  for (uint64_t i = 0; i < 2000; ++i) add_tuft(model, m, i);
  for (uint64_t i = 0; i < 260; ++i) add_reed(model, m, i);
  model.light({.name = "sun",
               .kind = LightKind::directional,
               .direction = glm::normalize(vec3(-0.6f, -1.0f, -0.4f)),
               .color = vec3(1.0f, 0.95f, 0.86f),
               .intensity = 7.0f});
  model.camera("path", {-0.9f, 1.55f, 6.2f}, {-0.2f, 0.3f, 0.0f}, 60.0f);
  model.camera("pond", {0.1f, 1.25f, 1.6f}, {3.0f, 0.25f, -1.8f}, 60.0f);
  model.camera("grass", {-0.75f, 0.42f, 1.2f}, {-2.7f, 0.15f, -2.2f}, 55.0f);
  model.camera("reeds", {-0.6f, 0.8f, -2.6f}, {3.4f, 0.6f, -1.9f}, 55.0f);
}

}  // namespace

Scene meadow(const Parameters& parameters) {
  return build("meadow", parameters, uint32_t{3} << 16, layout);
}

}  // namespace hybray::procedural
