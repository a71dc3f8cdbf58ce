// What fills and surrounds the openings of a facade: windows, shutters, balconies, flower boxes, awnings and
// doors.
#include "core/scene/procedural/street.h"

namespace hybray::procedural::street_parts {
namespace {

constexpr double kReveal = 0.2;  // how deep panes lie behind the wall

// The four sides of an opening, facing into it.
void reveal(MeshBuilder& part, double half, double height) {
  const double d = -kReveal;
  part.quad({-half, 0, 0}, {-half, 0, d}, {-half, height, d}, {-half, height, 0});
  part.quad({half, 0, d}, {half, 0, 0}, {half, height, 0}, {half, height, d});
  part.quad({-half, height, 0}, {-half, height, d}, {half, height, d}, {half, height, 0});
  part.quad({-half, 0, 0}, {half, 0, 0}, {half, 0, d}, {-half, 0, d});
}

// A bar of a window or door, seen from the front and its sides.
void bar(MeshBuilder& part, const Lod& lod, const dvec3& lower, const dvec3& upper) {
  if (lod.wants(0.8))
    part.bevelled_box(lower, upper, 0.008);
  else
    part.box(lower, upper, kAllFaces & ~kBack);
}

}  // namespace

void add_window(FacadeParts& parts, const Lod& lod, const dmat4& at, double width, double height, bool lit) {
  const double half = 0.5 * width, z = -kReveal;
  for (auto* part : {&parts.wall, &parts.sash, &parts.pane, &parts.lit_pane, &parts.trim})
    part->set_frame(at);
  reveal(parts.wall, half, height);
  (lit ? parts.lit_pane : parts.pane)
      .quad({-half, 0, z}, {half, 0, z}, {half, height, z}, {-half, height, z});
  if (lod.wants(0.16)) {
    const double e = 0.012, t = 0.065;  // into the reveal, width of the frame
    bar(parts.sash, lod, {-half - e, -e, z - 0.02}, {-half + t, height + e, z + 0.06});
    bar(parts.sash, lod, {half - t, -e, z - 0.02}, {half + e, height + e, z + 0.06});
    bar(parts.sash, lod, {-half - e, -e, z - 0.02}, {half + e, t, z + 0.055});
    bar(parts.sash, lod, {-half - e, height - t, z - 0.02}, {half + e, height + e, z + 0.055});
  }
  if (lod.wants(0.24)) {
    bar(parts.sash, lod, {-0.045, 0.03, z - 0.02}, {0.045, height - 0.03, z + 0.05});
    for (const double share : {0.33, 0.67})
      bar(parts.sash, lod, {-half, share * height - 0.015, z - 0.02},
          {half, share * height + 0.015, z + 0.035});
  }
  if (lod.wants(0.2)) parts.trim.bevelled_box({-half - 0.1, -0.09, -0.04}, {half + 0.1, -0.005, 0.11}, 0.015);
}

void add_shutters(FacadeParts& parts, const Lod& lod, const dmat4& at, double width, double height) {
  if (!lod.wants(0.2)) return;
  const double leaf_width = 0.5 * width - 0.02;
  for (const double side : {-1.0, 1.0}) {
    // Hinged at the edge of the opening and opened almost flat against the wall.
    parts.shutter.set_frame(at * moved({side * (0.5 * width + 0.015), 0.0, 0.03}) * turned(-side * 0.1));
    const double x0 = side > 0 ? 0.0 : -leaf_width, x1 = x0 + leaf_width;
    if (!lod.wants(0.4)) {
      parts.shutter.box({x0, 0, -0.02}, {x1, height, 0.02}, kAllFaces & ~kBack);
      continue;
    }
    const double t = 0.055;
    parts.shutter.bevelled_box({x0, 0, -0.018}, {x0 + t, height, 0.022}, 0.006);
    parts.shutter.bevelled_box({x1 - t, 0, -0.018}, {x1, height, 0.022}, 0.006);
    for (const double y : {0.0, 0.48 * height, height - 0.08})
      parts.shutter.bevelled_box({x0 + 0.02, y, -0.016}, {x1 - 0.02, y + 0.08, 0.02}, 0.006);
    const int slats = std::min(lod.segments(22, 6), 34);
    const dmat4 frame = parts.shutter.frame();
    for (int i = 0; i < slats; ++i) {
      const double y = 0.09 + (height - 0.18) * (i + 0.5) / slats, half = 0.4 * (height - 0.18) / slats;
      parts.shutter.set_frame(frame * moved({0, y, 0}) * turned(0.6, dvec3(1, 0, 0)));
      parts.shutter.box({x0 + 0.04, -half, -0.004}, {x1 - 0.04, half, 0.004},
                        kBack | kFront | kTop | kBottom);
    }
  }
}

void add_balcony(FacadeParts& parts, const Lod& lod, const dmat4& at, double width) {
  if (!lod.wants(0.14)) return;
  const double half = 0.5 * width, deep = 0.5, rail = 0.95;
  for (auto* part : {&parts.trim, &parts.iron}) part->set_frame(at * moved({0, -0.1, 0}));
  parts.trim.bevelled_box({-half - 0.06, -0.1, -0.05}, {half + 0.06, 0.04, deep + 0.08}, 0.02);
  if (!lod.wants(0.22)) {
    parts.iron.box({-half, 0.1, deep - 0.01}, {half, rail, deep + 0.01}, kFront | kBack | kTop);
    return;
  }
  for (const double x : {-0.7 * half, 0.7 * half}) {  // consoles
    const int n = lod.segments(10, 3);
    const Curve3 path = smooth(
        Curve3{{x, -0.5, 0.03}, {x, -0.42, 0.1}, {x, -0.25, 0.14}, {x, -0.14, 0.34}, {x, -0.06, 0.42}}, n);
    tube(parts.trim, path, 0.05, 0.08, lod.segments(8, 4));
  }
  const int sides = lod.segments(7, 3);
  for (const double y : {0.12, rail - 0.1, rail}) {
    const double r = y > 0.9 ? 0.022 : 0.012;
    tube(parts.iron, {{-half, y, -0.03}, {-half, y, deep}}, r, sides);
    tube(parts.iron, {{-half - r, y, deep}, {half + r, y, deep}}, r, sides);
    tube(parts.iron, {{half, y, deep}, {half, y, -0.03}}, r, sides);
  }
  const int count = std::max(5, static_cast<int>(width / 0.12));
  const int bend = lod.segments(9, 1);
  for (int i = 0; i <= count; ++i) {  // bars with a belly
    const double x = -half + width * i / count;
    Curve3 path{{x, 0.03, deep},       {x, 0.12, deep}, {x, 0.3, deep + 0.06},
                {x, 0.5, deep + 0.04}, {x, 0.75, deep}, {x, rail, deep}};
    path = bend > 2 ? smooth(path, bend) : Curve3{path.front(), path.back()};
    tube(parts.iron, path, 0.009, lod.segments(6, 3));
    if (i < count && lod.wants(0.6))
      ring(parts.iron, {x + 0.5 * width / count, rail - 0.05, deep}, {1, 0, 0}, {0, 1, 0}, 0.036, 0.007,
           lod.segments(12, 6), 4);
  }
  for (const double x : {-half, half})
    for (const double z : {0.14, 0.32})
      tube(parts.iron, {{x, 0.03, z}, {x, rail, z}}, 0.009, lod.segments(6, 3));
}

void add_bush(MeshBuilder& part, const Model& model, const Lod& lod, const dmat4& at, double radius,
              int count, double leaf_length, double upward, uint64_t bush) {
  const int cut = std::min(lod.segments(3.2, 2), 12);
  if (part.counting()) {  // leaf by leaf only where vertices are made
    MeshBuilder one(true);
    leaf(one, 1, 1, 0, cut);
    part.add_count(one.triangle_count() * static_cast<size_t>(count));
    return;
  }
  for (int i = 0; i < count; ++i) {
    Dice dice = model.dice(bush * 1000003 + static_cast<uint64_t>(i));
    const double yaw = dice(0.0, 2.0 * kPi), sine = upward + (1.0 - upward) * dice(-1.0, 1.0),
                 r = radius * std::cbrt(dice(0.15, 1.0));
    const double pitch = std::asin(std::min(1.0, std::max(-1.0, sine * dice(0.3, 1.0))));
    const double length = leaf_length * dice(0.7, 1.3);
    part.set_frame(at * turned(yaw) * turned(-pitch, dvec3(1, 0, 0)) * moved({0, 0, r}) *
                   turned(dice(-1.2, 1.2)) * turned(dice(-0.6, 0.6), dvec3(1, 0, 0)) *
                   turned(dice(-0.8, 0.8), dvec3(0, 0, 1)));
    leaf(part, length, length * dice(0.35, 0.55), length * dice(0.05, 0.35), cut);
  }
}

void add_flower_box(FacadeParts& parts, const Model& model, const Lod& lod, const dmat4& at, double width,
                    uint64_t number) {
  if (!lod.wants(0.25)) return;
  parts.pot.set_frame(at);
  parts.pot.bevelled_box({-0.45 * width, 0.0, 0.02}, {0.45 * width, 0.17, 0.2}, 0.015);
  for (int i = 0; i < 4; ++i) {
    const dmat4 clump = at * moved({(i - 1.5) * 0.22 * width, 0.2, 0.11});
    const uint64_t bush = key("flower_box", number * 10 + static_cast<uint64_t>(i));
    add_bush(parts.leaf, model, lod, clump, 0.1, lod.filling(26), 0.1, 0.3, bush);
    add_bush(parts.flower, model, lod, clump * moved({0, 0.05, 0.02}), 0.14, lod.filling(9), 0.05, 0.4,
             bush + 1);
  }
}

void add_awning(FacadeParts& parts, const Lod& lod, const dmat4& at, double width) {
  if (!lod.wants(0.08)) return;
  const int stripes = lod.wants(0.3) ? 2 * static_cast<int>(width / 0.7) + 1 : 1;
  const double reach = 1.35, drop = 0.75;
  const int nv = lod.segments(14, 2), nu = lod.segments(5, 1);
  for (int i = 0; i < stripes; ++i) {
    MeshBuilder& part = i % 2 ? parts.fabric_2 : parts.fabric;
    part.set_frame(at);
    const double x0 = -0.5 * width + width * i / stripes, x1 = -0.5 * width + width * (i + 1) / stripes;
    // From the wall down to the front bar with a little sag; then the valance, scalloped, a stripe a scallop.
    cloth(part, nu, nv, 0.008, [=](double u, double v) {
      const double x = x1 + (x0 - x1) * u;
      return dvec3(x, -drop * v - 0.07 * std::sin(kPi * v), reach * v);
    });
    cloth(part, nu, std::max(2, nv / 2), 0.008, [=](double u, double v) {
      const double x = x1 + (x0 - x1) * u, length = 0.14 + 0.1 * std::sin(kPi * u);
      return dvec3(x, -drop - 0.002 - length * v, reach + 0.006 + 0.02 * v * std::sin(9.0 * x));
    });
  }
  if (!lod.wants(0.2)) return;
  parts.iron.set_frame(at);
  const int sides = lod.segments(8, 3);
  tube(parts.iron,
       {{-0.5 * width - 0.03, -drop - 0.02, reach - 0.03}, {0.5 * width + 0.03, -drop - 0.02, reach - 0.03}},
       0.018, sides);
  for (const double x : {-0.5 * width - 0.02, 0.5 * width + 0.02})
    tube(parts.iron, {{x, -drop - 0.35, -0.04}, {x, -drop - 0.02, reach - 0.03}}, 0.014, sides);
}

void add_door(FacadeParts& parts, const Lod& lod, const dmat4& at, double width, double height) {
  const double half = 0.5 * width, z = -kReveal;
  for (auto* part : {&parts.wall, &parts.shutter, &parts.pane, &parts.trim, &parts.iron}) part->set_frame(at);
  reveal(parts.wall, half, height);
  parts.shutter.quad({-half, 0, z}, {half, 0, z}, {half, height, z}, {-half, height, z});
  if (lod.wants(0.2)) {
    parts.shutter.bevelled_box({-half + 0.08, 0.12, z - 0.03}, {half - 0.08, 0.95, z + 0.04}, 0.02);
    parts.pane.box({-half + 0.12, 1.1, z - 0.01}, {half - 0.12, height - 0.45, z + 0.015},
                   kAllFaces & ~kBack);
    bar(parts.shutter, lod, {-0.03, 1.08, z - 0.01}, {0.03, height - 0.43, z + 0.035});
    bar(parts.shutter, lod, {-half + 0.1, 1.7, z - 0.01}, {half - 0.1, 1.76, z + 0.03});
    parts.trim.bevelled_box({-half - 0.1, -0.14, -0.1}, {half + 0.1, 0.02, 0.22}, 0.02);  // the step
  }
  if (lod.wants(0.3)) {
    for (const double x : {-half - 0.14, half})
      parts.trim.bevelled_box({x, -0.02, -0.03}, {x + 0.14, height + 0.02, 0.05}, 0.012);
    parts.trim.bevelled_box({-half - 0.18, height, -0.03}, {half + 0.18, height + 0.18, 0.09}, 0.015);
    tube(parts.iron, {{half - 0.17, 1.0, z + 0.06}, {half - 0.17, 1.35, z + 0.06}}, 0.014,
         lod.segments(8, 4));
  }
}

}  // namespace hybray::procedural::street_parts
