// A tiled pool in the sun. The water is bounded by its wavy surface above and by the tiles, whose outer
// medium it is: the two meet along the walls, vertex by vertex, so that the water is a closed body.
#include "core/scene/procedural/caustic_stage.h"

#include <array>

namespace hybray::procedural {
namespace {

constexpr double kHalfX = 2.0, kHalfZ = 1.4, kBottom = -1.1, kRim = 0.14;  // the water stands at y = 0
constexpr int kTilesX = 20, kTilesZ = 14;

// A sum of waves of short and middle length. Their curvature, amplitude * number^2, sets the depth at which
// a crest brings the sun's rays together: about 4 / curvature, here from below a metre to a few.
class Waves {
 public:
  explicit Waves(Dice dice) {
    for (size_t i = 0; i < kCount; ++i) {
      const double length = 0.32 * std::pow(1.42, static_cast<double>(i)) * dice(0.93, 1.07);
      const double heading = dice(0.0, 2.0 * kPi), number = 2.0 * kPi / length;
      numbers_[i] = number * dvec2(std::cos(heading), std::sin(heading));
      amplitudes_[i] = 0.85 / (number * number);
      phases_[i] = dice(0.0, 2.0 * kPi);
    }
  }
  double operator()(double x, double z) const {
    double y = 0.0;
    for (size_t i = 0; i < kCount; ++i)
      y += amplitudes_[i] * std::sin(numbers_[i].x * x + numbers_[i].y * z + phases_[i]);
    return y;
  }

 private:
  static constexpr size_t kCount = 5;
  std::array<dvec2, kCount> numbers_;
  std::array<double, kCount> amplitudes_{}, phases_{};
};

// The lines along which water cells meet, `cells` of them to a tile: all that stands at such a line takes its
// coordinates from here, so that it meets to the last bit.
struct Grid {
  int cells;
  int nx() const { return kTilesX * cells; }
  int nz() const { return kTilesZ * cells; }
  double x(int i) const { return kHalfX * (2 * i - nx()) / nx(); }
  double z(int j) const { return kHalfZ * (2 * j - nz()) / nz(); }
};

// A wall along `line`, the water's edge, as seen from the pool from left to right. Every tile is a fan of its
// own.
void add_wall(const Curve3& line, int cells, MeshBuilder& wet, MeshBuilder& dry) {
  const auto at = [](const dvec3& p, double y) { return dvec3(p.x, y, p.z); };
  for (size_t first = 0; first + 1 < line.size(); first += static_cast<size_t>(cells)) {
    const size_t last = first + static_cast<size_t>(cells);
    const dvec3 &a = line[first], &b = line[last];
    Curve3 below{at(a, kBottom), at(b, kBottom)}, above{at(b, kRim), at(a, kRim)};
    for (size_t i = first; i <= last; ++i) {
      below.push_back(line[last - (i - first)]);
      above.push_back(line[i]);
    }
    wet.face(below);
    dry.face(above);
  }
}

void add_bottom(Model& model, uint32_t light, uint32_t dark, const Grid& grid) {
  MeshBuilder parts[2] = {model.part(), model.part()};
  const auto corner = [&](int i, int j) {
    return dvec3(grid.x(i * grid.cells), kBottom, grid.z(j * grid.cells));
  };
  for (int j = 0; j < kTilesZ; ++j)
    for (int i = 0; i < kTilesX; ++i)
      parts[(i + j) % 2].quad(corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j));
  model.add(std::move(parts[0]), light, "bottom_tiles");
  model.add(std::move(parts[1]), dark, "bottom_tiles_dark");
}

void add_pool(Model& model) {
  const Material water = caustic_stage::clear_water();
  const auto tile = [&](const char* name, const vec3& color, bool under_water) {
    Material m = caustic_stage::matte(name, color);
    if (under_water) m.outer_ior = water.ior, m.outer_absorption = water.absorption;
    return model.material(m);
  };
  const uint32_t light = tile("tile", {0.62f, 0.74f, 0.78f}, true);
  const uint32_t dark = tile("tile_dark", {0.42f, 0.6f, 0.7f}, true);
  const uint32_t dry_tile = tile("tile_dry", {0.62f, 0.74f, 0.78f}, false);

  const Waves waves(model.dice(key("waves")));
  const Grid grid{model.lod(key("water")).segments(7.0, 1)};
  const int nx = grid.nx(), nz = grid.nz();
  const auto point = [&](int i, int j) { return dvec3(grid.x(i), waves(grid.x(i), grid.z(j)), grid.z(j)); };
  MeshBuilder surface = model.part(), wet = model.part(), dry = model.part();
  surface.surface(nx, nz, {}, [&](double u, double v) {
    return point(static_cast<int>(std::lround(u * nx)), nz - static_cast<int>(std::lround(v * nz)));
  });
  Curve3 back, front, left, right;
  for (int i = 0; i <= nx; ++i) back.push_back(point(i, 0)), front.push_back(point(nx - i, nz));
  for (int j = 0; j <= nz; ++j) left.push_back(point(0, nz - j)), right.push_back(point(nx, j));
  for (const Curve3& line : {back, front, left, right}) add_wall(line, grid.cells, wet, dry);
  model.add(std::move(surface), model.material(water), "water");
  model.add(std::move(wet), light, "wall_tiles");
  model.add(std::move(dry), dry_tile, "wall_tiles_dry");
  add_bottom(model, light, dark, grid);
}

// The ground about the pool, and a wall at its far end.
void add_surroundings(Model& model) {
  const uint32_t stone = model.material(caustic_stage::matte("stone", {0.5f, 0.46f, 0.4f}));
  const uint32_t plaster = model.material(caustic_stage::matte("plaster", {0.62f, 0.55f, 0.46f}));
  const double x = kHalfX, z = kHalfZ, out = 1.2;
  MeshBuilder part = model.part(), wall = model.part();
  const auto strip = [&](uint64_t number, const dvec3& corner, const dvec3& along, const dvec3& across) {
    caustic_stage::ground(part, model.lod(key("ground", number)), corner, along, across);
  };
  strip(0, {-x - out, kRim, z + out}, {2 * (x + out), 0, 0}, {0, 0, -out});
  strip(1, {-x - out, kRim, -z}, {2 * (x + out), 0, 0}, {0, 0, -out});
  strip(2, {-x - out, kRim, z}, {out, 0, 0}, {0, 0, -2 * z});
  strip(3, {x, kRim, z}, {out, 0, 0}, {0, 0, -2 * z});
  caustic_stage::ground(wall, model.lod(key("wall")), {-x - out, kRim, -z - out}, {2 * (x + out), 0, 0},
                        {0, 1.6, 0});
  model.add(std::move(part), stone, "ground");
  model.add(std::move(wall), plaster, "wall");
}

void layout(Model& model) {
  add_pool(model);
  add_surroundings(model);
  model.light({.name = "sun",
               .kind = LightKind::directional,
               .direction = glm::normalize(vec3(0.28f, -1.0f, -0.2f)),
               .color = vec3(1.0f, 0.95f, 0.86f),
               .intensity = 10.0f});
  model.camera("front", {0.4f, 1.65f, 2.5f}, {0.0f, -0.7f, -0.2f}, 60.0f);
  model.camera("corner", {2.6f, 1.5f, 1.9f}, {-0.5f, -0.6f, -0.4f}, 60.0f);
  model.camera("above", {0.1f, 1.7f, 0.9f}, {0.0f, -0.9f, -0.05f}, 70.0f);
}

}  // namespace

Scene water_pool(const Parameters& parameters) {
  return build("water_pool", parameters, uint32_t{1} << 16, layout);
}

}  // namespace hybray::procedural
