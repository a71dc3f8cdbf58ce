// The atrium's floors, walls, roof, columns and arches: what stays where it is at any number of triangles.
#include "core/scene/procedural/atrium.h"

namespace hybray::procedural::atrium_parts {
namespace {

// A slab around the nave from y0 to y1; it reaches 0.1 m into the outer walls.
void ring_slab(MeshBuilder& part, double y0, double y1) {
  const double ix = kRingX - kEdge, iz = kRingZ - kEdge, ox = kWallX + 0.1, oz = kWallZ + 0.1;
  const std::array<dvec2, 4> inner{{{-ix, -iz}, {ix, -iz}, {ix, iz}, {-ix, iz}}};
  const std::array<dvec2, 4> outer{{{-ox, -oz}, {ox, -oz}, {ox, oz}, {-ox, oz}}};
  const auto at = [](const dvec2& p, double y) { return dvec3(p.x, y, p.y); };
  for (size_t i = 0; i < 4; ++i) {
    const size_t k = (i + 1) % 4;
    part.quad(at(inner[i], y1), at(inner[k], y1), at(outer[k], y1), at(outer[i], y1));
    part.quad(at(outer[i], y0), at(outer[k], y0), at(inner[k], y0), at(inner[i], y0));
    part.quad(at(inner[i], y0), at(inner[k], y0), at(inner[k], y1), at(inner[i], y1));
  }
}

// Mouldings that run around the nave below the edge of a slab.
void add_cornice(Model& model, uint32_t material, double y, uint64_t number) {
  const Lod lod = model.lod(key("cornice", number));
  if (!lod.wants(0.06)) return;
  const int n = lod.segments(10, 2);
  for (int side = 0; side < 4; ++side) {
    MeshBuilder part = model.part();
    const double half = (side % 2 ? kRingZ : kRingX) - kEdge, away = (side % 2 ? kRingX : kRingZ) - kEdge;
    // The profile is mitred at the corners, where its length shrinks by its depth.
    const Curve2 profile = smooth(Curve2{{-0.02, -0.42},
                                         {0.05, -0.36},
                                         {0.06, -0.26},
                                         {0.16, -0.14},
                                         {0.15, -0.06},
                                         {0.19, 0.02},
                                         {0.1, 0.06},
                                         {-0.03, 0.06},
                                         {-0.08, -0.05}},
                                  n);
    part.surface(1, n, {}, [&](double u, double v) {
      const dvec2 p = profile[static_cast<size_t>(std::lround(v * n))];
      return dvec3((2.0 * u - 1.0) * (half - p.x), y + p.y, p.x - away);
    });
    model.add(std::move(part), material, "cornice", turned(-0.5 * kPi * side));
  }
}

void add_floor(Model& model, const Materials& m) {
  // Without tiles the floor is cut into as many strips as the other parts leave triangles for.
  const Lod lod = model.lod(key("floor"));
  const bool tiled = lod.wants(0.2);
  const int nx = tiled ? 38 : 1 + lod.filling(3), nz = tiled ? 22 : 1;
  const double x = kWallX + 0.1, z = kWallZ + 0.1;
  MeshBuilder light = model.part(), dark = model.part();
  for (int j = 0; j < nz; ++j)
    for (int i = 0; i < nx; ++i) {
      const double x0 = -x + 2 * x * i / nx, x1 = -x + 2 * x * (i + 1) / nx;
      const double z0 = -z + 2 * z * j / nz, z1 = -z + 2 * z * (j + 1) / nz;
      (tiled && (i + j) % 2 ? dark : light).quad({x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0});
    }
  model.add(std::move(light), m.marble_light, "floor");
  model.add(std::move(dark), m.marble_dark, "floor_dark");
}

void add_column(Model& model, const Materials& m, const Place& place, bool upper) {
  const Lod lod = model.lod(key(upper ? "upper_column" : "column", place.number));
  const double foot = upper ? kGallery + 1.05 : 0.0, top = upper ? 8.8 : 3.6, r = upper ? 0.17 : 0.26;
  const bool rich = lod.wants(0.12);
  MeshBuilder part = model.part();
  const int sides = lod.segments(28, 3);
  if (upper) part.box({-0.29, kGallery - 0.05, -0.29}, {0.29, foot, 0.29}, rich ? kAllFaces & ~kBottom : 0u);
  const double base = foot + (rich ? 0.8 * r + 0.1 : upper ? -1.07 : -0.02);
  const double neck = top - (rich ? 2.2 * r : 0.0);
  const int rises = rich ? lod.segments(8, 1) : 1;
  Curve2 shaft;
  for (int i = 0; i <= rises; ++i) {
    const double t = static_cast<double>(i) / rises;  // swells a little, then narrows (entasis)
    shaft.emplace_back(r * (1.0 - 0.12 * t * t + 0.03 * std::sin(kPi * t)), base + (neck - base) * t);
  }
  lathe(part, shaft, sides);
  if (rich) {
    const int curve = lod.segments(10, 4);
    lathe(part,
          smooth(Curve2{{1.42 * r, foot + 0.09},
                        {1.5 * r, foot + 0.09 + 0.2 * r},
                        {1.28 * r, foot + 0.09 + 0.4 * r},
                        {1.2 * r, foot + 0.09 + 0.52 * r},
                        {1.26 * r, foot + 0.09 + 0.66 * r},
                        {1.1 * r, foot + 0.09 + 0.82 * r},
                        {0.98 * r, foot + 0.1 + 0.9 * r}},
                 curve),
          sides);
    // The capital: a ring, a bell with eight leaf-like lobes, a square slab.
    lathe(part,
          smooth(Curve2{{0.85 * r, neck - 0.02},
                        {1.05 * r, neck + 0.05 * r},
                        {1.07 * r, neck + 0.15 * r},
                        {0.86 * r, neck + 0.25 * r}},
                 lod.segments(6, 2)),
          sides);
    const int bell = lod.segments(14, 3);
    part.surface(lod.segments(64, 8), bell, {.closed_u = true}, [&](double u, double v) {
      const double a = 2.0 * kPi * u, lobes = std::abs(std::cos(4.0 * a));
      const double curl = std::pow(v, 3.0) * 0.55 + 0.16 * std::sin(kPi * std::min(2.0 * v, 1.0)) + 0.1 * v;
      const double radius =
          r * (0.86 + curl * (0.75 + 0.35 * lobes) - 0.06 * (1.0 - lobes) * std::sin(3.0 * kPi * v));
      return dvec3(radius * std::cos(a), neck + 0.2 * r + v * (top - 0.32 * r - neck - 0.2 * r),
                   -radius * std::sin(a));
    });
    part.box({-1.45 * r, foot - 0.02, -1.45 * r}, {1.45 * r, foot + 0.1, 1.45 * r}, kAllFaces & ~kBottom);
    part.box({-1.52 * r, top - 0.4 * r, -1.52 * r}, {1.52 * r, top, 1.52 * r});
  }
  model.add(std::move(part), m.pale_stone, upper ? "upper_column" : "column", place.frame);
}

}  // namespace

void add_shell(Model& model, const Materials& m) {
  add_floor(model, m);
  const double thick = 0.4, top = kRoof + 0.4;
  for (int side = 0; side < 4; ++side) {  // long walls run past the short ones
    MeshBuilder wall = model.part();
    const bool is_long = side % 2 == 0;
    const double half = is_long ? kWallX + thick : kWallZ, away = is_long ? kWallZ : kWallX;
    wall.box({-half, -0.1, -away - thick}, {half, top, -away},
             !model.lod(key("outer_wall")).wants(0.05) ? kFront
             : is_long                                 ? kAllFaces & ~kBottom
                                                       : kFront | kBack | kTop);
    model.add(std::move(wall), m.plaster, "outer_wall", turned(-0.5 * kPi * side));
  }
  MeshBuilder gallery = model.part(), roof = model.part();
  ring_slab(gallery, kGallery - 0.3, kGallery);
  ring_slab(roof, kRoof, kRoof + 0.4);
  model.add(std::move(gallery), m.tile, "gallery_floor");
  model.add(std::move(roof), m.plaster, "roof");
  add_cornice(model, m.pale_stone, kGallery - 0.02, 0);
  add_cornice(model, m.pale_stone, kRoof + 0.36, 1);

  for (const Place& place : columns()) {  // pilasters on the outer wall and beams below the roof
    const Lod lod = model.lod(key("pilaster", place.number));
    if (!lod.wants(0.15)) continue;
    const double wall = -kAisle;
    MeshBuilder pilaster = model.part(), beam = model.part();
    pilaster.box({-0.28, 0.3, wall - 0.05}, {0.28, 3.5, wall + 0.12}, kAllFaces & ~kBack);
    pilaster.bevelled_box({-0.36, -0.03, wall - 0.05}, {0.36, 0.32, wall + 0.2}, 0.03);
    pilaster.bevelled_box({-0.37, 3.45, wall - 0.05}, {0.37, 3.76, wall + 0.22}, 0.04);
    beam.bevelled_box({-0.16, kRoof - 0.3, wall - 0.05}, {0.16, kRoof + 0.05, -0.2}, 0.025);
    model.add(std::move(pilaster), m.pale_stone, "pilaster", place.frame);
    model.add(std::move(beam), m.wood, "roof_beam", place.frame);
  }
}

void add_arcades(Model& model, const Materials& m) {
  for (const bool upper : {false, true})
    for (const Place& place : columns()) add_column(model, m, place, upper);
  for (const bool upper : {false, true})
    for (const Place& bay : bays()) {
      const Lod lod = model.lod(key(upper ? "upper_arch" : "arch", bay.number));
      MeshBuilder part = model.part();
      arch_bay(part,
               upper ? ArchBay{kBay, 8.79, kRoof + 0.1, 1.34, 0.36}
                     : ArchBay{kBay, 3.59, kGallery - 0.1, 1.25, 0.56},
               lod.even_segments(28, 2));
      model.add(std::move(part), m.stone, upper ? "upper_arch" : "arch", bay.frame);
    }
  // Corner piers cover the ends of the arcades that meet there.
  for (const double x : {-kRingX, kRingX})
    for (const double z : {-kRingZ, kRingZ}) {
      if (!model.lod(key("corner")).wants(0.05)) continue;
      MeshBuilder part = model.part();
      part.box({x - 0.3, 3.58, z - 0.3}, {x + 0.3, kGallery - 0.1, z + 0.3}, kAllFaces & ~kTop);
      part.box({x - 0.2, 8.78, z - 0.2}, {x + 0.2, kRoof + 0.1, z + 0.2}, kAllFaces & ~kTop);
      model.add(std::move(part), m.stone, "corner_pier");
    }
}

}  // namespace hybray::procedural::atrium_parts
