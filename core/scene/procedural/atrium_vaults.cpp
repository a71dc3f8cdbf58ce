// Groin vaults over the atrium's aisles, with transverse ribs, and the barrel vaults at both ends of the
// nave.
#include "core/scene/procedural/atrium.h"

namespace hybray::procedural::atrium_parts {
namespace {

constexpr double kSpring = 3.74, kRise = 1.5;  // of the aisle's vaults

// The underside of two crossing barrels over the rectangle |x| <= a, |z| <= b: four curved triangles that
// meet in the middle.
void groin_vault(MeshBuilder& part, double a, double b, int across, int along) {
  const std::array<std::pair<dvec2, dvec2>, 4> patches{
      {{{a, 0}, {0, b}}, {{-a, 0}, {0, -b}}, {{0, b}, {-a, 0}}, {{0, -b}, {a, 0}}}};
  for (const auto& [axis, side] : patches)
    part.surface(across, along, {.pole_begin = true}, [&, axis = axis, side = side](double u, double v) {
      const double s = 1.0 - 2.0 * u;
      const dvec2 p = v * axis + v * s * side;
      return dvec3(p.x, kSpring + kRise * std::sqrt(std::max(0.0, 1.0 - v * s * v * s)), p.y);
    });
}

// A transverse rib from the arcade to the outer wall, square in section.
void rib(MeshBuilder& part, double from_z, double to_z, int segments) {
  const double middle = 0.5 * (from_z + to_z), half = 0.5 * (to_z - from_z);
  cloth(part, 1, segments, 0.2, [&](double u, double v) {
    const double a = kPi * v;
    return dvec3(0.36 * (u - 0.5), kSpring - 0.03 + (kRise - 0.05) * std::sin(a),
                 middle - half * std::cos(a));
  });
}

// Half an ellipse across the nave, x0..x1 along it.
void barrel(MeshBuilder& part, double x0, double x1, double half, double rise, double thickness, int along,
            int around) {
  cloth(part, along, around, thickness, [&](double u, double v) {
    const double a = kPi * v;
    return dvec3(x0 + (x1 - x0) * u, kRoof + 0.3 + rise * std::sin(a), half * std::cos(a));
  });
}

void add_nave_vault(Model& model, const Materials& m) {
  constexpr double kHalf = kRingZ - 0.1, kTop = 3.5;
  for (const double side : {-1.0, 1.0}) {
    const Lod lod = model.lod(key("nave_vault", side > 0));
    const int around = lod.even_segments(40, 2);
    MeshBuilder shell = model.part(), end = model.part();
    const double inner = side * 1.5 * kBay, outer = side * (kRingX + 0.1);
    barrel(shell, std::min(inner, outer), std::max(inner, outer), kHalf, kTop, 0.24, lod.segments(10, 1),
           around);
    model.add(std::move(shell), m.plaster, "nave_vault");
    Curve3 lunette;  // closes the outer end
    for (int i = 0; i <= around; ++i) {
      const double a = kPi * i / around;
      lunette.emplace_back(side * (kRingX - 0.02), kRoof + 0.3 + kTop * std::sin(a),
                           side * kHalf * std::cos(a));
    }
    end.face(lunette);
    model.add(std::move(end), m.plaster, "lunette");
  }
  for (int i = 0; i < 8; ++i) {
    const Lod lod = model.lod(key("nave_rib", i));
    if (!lod.wants(0.08)) continue;
    const double x = (i - 3.5) * kBay;
    MeshBuilder part = model.part();
    barrel(part, x - 0.19, x + 0.19, kHalf - 0.14, kTop - 0.12, 0.36, 1, lod.even_segments(40, 6));
    model.add(std::move(part), m.pale_stone, "nave_rib");
  }
}

}  // namespace

void add_vaults(Model& model, const Materials& m) {
  const double front = -0.27, depth = kAisle - 0.27, middle = 0.5 * (front - kAisle);
  for (const Place& bay : bays()) {
    const Lod lod = model.lod(key("vault", bay.number));
    if (!lod.wants(0.1)) continue;
    MeshBuilder part = model.part();
    part.set_frame(moved({0, 0, middle}));
    groin_vault(part, 0.5 * kBay, 0.5 * depth, lod.even_segments(20, 2), lod.segments(10, 2));
    model.add(std::move(part), m.plaster, "vault", bay.frame);
  }
  for (int corner = 0; corner < 4; ++corner) {
    const double x = corner % 2 ? 1.0 : -1.0, z = corner / 2 ? 1.0 : -1.0;
    const Lod lod = model.lod(key("corner_vault", corner));
    if (!lod.wants(0.1)) continue;
    MeshBuilder part = model.part();
    const double a = 0.5 * (kWallX - kRingX), b = 0.5 * (kWallZ - kRingZ);
    groin_vault(part, a, b, lod.even_segments(24, 2), lod.segments(12, 2));
    model.add(std::move(part), m.plaster, "corner_vault", moved({x * (kRingX + a), 0, z * (kRingZ + b)}));
  }
  for (const bool is_long :
       {true, false})  // every column carries a rib to the wall behind it, the corner ones carry two
    for (int i = 0; i < (is_long ? 16 : 8); ++i) {
      const Lod lod = model.lod(key(is_long ? "rib" : "end_rib", i));
      if (!lod.wants(0.14)) continue;
      const int count = is_long ? 8 : 4;
      const dmat4 side = is_long ? turned(i < count ? 0.0 : kPi) * moved({0, 0, -kRingZ})
                                 : turned(i < count ? 0.5 * kPi : -0.5 * kPi) * moved({0, 0, -kRingX});
      MeshBuilder part = model.part();
      rib(part, -kAisle - 0.05, 0.05, lod.even_segments(20, 4));
      model.add(std::move(part), m.pale_stone, "rib",
                side * moved({(i % count - 0.5 * (count - 1)) * kBay, 0, 0}));
    }
  add_nave_vault(model, m);
}

}  // namespace hybray::procedural::atrium_parts
