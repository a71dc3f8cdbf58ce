// Reliefs and mouldings of the atrium: archivolts, rosettes over the columns, lion heads and doors on the
// outer walls.
#include "core/scene/procedural/atrium.h"

namespace hybray::procedural::atrium_parts {
namespace {

double bump(double x, double y, double sx, double sy) {
  return std::exp(-(x * x) / (sx * sx) - (y * y) / (sy * sy));
}

// Height of a lion's head over the unit disc.
double lion(double x, double y) {
  const double r = std::sqrt(x * x + y * y), a = std::atan2(y, x), ax = std::abs(x);
  const double mane = 0.2 * bump(r - 0.72, 0, 0.2, 1) *
                      (1.0 + 0.35 * std::sin(17.0 * a + 9.0 * r) + 0.2 * std::sin(29.0 * a - 6.0 * r));
  double h = mane + 0.42 * bump(x, y, 0.5, 0.56);                                // the skull
  h += 0.26 * bump(x, y + 0.2, 0.2, 0.2) + 0.1 * bump(x, y + 0.12, 0.09, 0.07);  // muzzle and nose
  h += 0.13 * bump(ax - 0.12, y + 0.27, 0.1, 0.09);                              // cheeks of the snout
  h -= 0.16 * bump(x, y + 0.42, 0.16, 0.04);                                     // mouth
  h +=
      0.1 * bump(ax - 0.22, y - 0.2, 0.14, 0.05) - 0.1 * bump(ax - 0.2, y - 0.08, 0.07, 0.05);  // brows, eyes
  h += 0.16 * bump(ax - 0.46, y - 0.45, 0.12, 0.13) + 0.12 * bump(x, y - 0.05, 0.07, 0.3);  // ears, bridge
  return h * (1.0 - std::pow(r, 8.0)) - 0.02;
}

// Height of a rosette with eight petals.
double rosette(double x, double y) {
  const double r = std::sqrt(x * x + y * y), a = std::atan2(y, x);
  const double petals = 0.22 * bump(r - 0.5, 0, 0.26, 1) * (0.55 + 0.45 * std::cos(8.0 * a));
  return (petals + 0.26 * bump(r, 0, 0.17, 1) + 0.13 * bump(r - 0.9, 0, 0.07, 1)) *
             (1.0 - std::pow(r, 24.0)) -
         0.03;
}

void add_archivolts(Model& model, const Materials& m) {
  for (const bool upper : {false, true})
    for (const Place& bay : bays()) {
      const Lod lod = model.lod(key(upper ? "upper_archivolt" : "archivolt", bay.number));
      if (!lod.wants(0.25)) continue;
      const double radius = upper ? 1.34 : 1.25, y = upper ? 8.79 : 3.59, z = upper ? 0.18 : 0.28;
      const int sides = lod.even_segments(8, 4), around = lod.even_segments(32, 8);
      MeshBuilder part = model.part();
      tube(part, arc({0, y, z}, {-1, 0, 0}, {0, 1, 0}, radius + 0.045, 0.0, kPi, around), 0.05, sides);
      tube(part, arc({0, y, z}, {-1, 0, 0}, {0, 1, 0}, radius + 0.17, 0.05, kPi - 0.05, around), 0.025,
           sides);
      part.bevelled_box({-0.11, y + radius - 0.04, z - 0.06}, {0.11, y + radius + 0.34, z + 0.1}, 0.02);
      model.add(std::move(part), m.pale_stone, "archivolt", bay.frame);
    }
}

void add_rosettes(Model& model, const Materials& m) {
  for (const Place& column : columns()) {
    const Lod lod = model.lod(key("rosette", column.number));
    const bool at_corner = column.number % 8 == 0 || column.number % 8 == 7;
    if (!lod.wants(0.3) || (at_corner && column.number < 16)) continue;
    MeshBuilder part = model.part();
    part.set_frame(moved({0, 4.62, 0.285}));
    relief(part, 0.3, lod.segments(64, 12), lod.segments(22, 4), rosette);
    model.add(std::move(part), m.pale_stone, "rosette", column.frame);
  }
}

void add_lion(Model& model, const Materials& m, double side) {
  const Lod lod = model.lod(key("lion", side > 0));
  if (!lod.wants(0.12)) return;
  const dmat4 frame = turned(-side * 0.5 * kPi) * moved({0, 0, -kWallX});
  MeshBuilder head = model.part(), frame_ring = model.part(), basin = model.part();
  head.set_frame(moved({0, 2.35, 0.01}));
  relief(head, 0.8, lod.segments(150, 12), lod.segments(70, 5), lion);
  model.add(std::move(head), m.gold, "lion_head", frame);
  ring(frame_ring, {0, 2.35, 0.0}, {1, 0, 0}, {0, 1, 0}, 0.86, 0.07, lod.segments(60, 10),
       lod.even_segments(12, 4));
  model.add(std::move(frame_ring), m.pale_stone, "lion_frame", frame);
  basin.set_frame(moved({0, 0, 0.3}));
  lathe(basin,
        smooth(Curve2{{0.34, -0.03},
                      {0.26, 0.12},
                      {0.17, 0.3},
                      {0.2, 0.55},
                      {0.5, 0.72},
                      {0.62, 0.86},
                      {0.62, 0.95},
                      {0.54, 0.95},
                      {0.45, 0.84},
                      {0.2, 0.74},
                      {0.0, 0.72}},
               lod.segments(30, 8)),
        lod.segments(40, 8));
  model.add(std::move(basin), m.stone, "wall_basin", frame);
}

// A panelled door in a stone frame, before the outer wall of a bay; `z` is toward the nave.
void add_door(Model& model, const Materials& m, const Place& bay) {
  const Lod lod = model.lod(key("door", bay.number));
  if (!lod.wants(0.1)) return;
  MeshBuilder leaf_part = model.part(), jambs = model.part(), knobs = model.part();
  for (auto* part : {&leaf_part, &jambs, &knobs}) part->set_frame(moved({0, 0, -kAisle}));
  leaf_part.box({-0.8, -0.02, -0.02}, {0.8, 2.62, 0.05}, kAllFaces & ~kBack & ~kBottom);
  for (int i = 0; i < 2 && lod.wants(0.25); ++i)
    for (int j = 0; j < 4; ++j) {
      const double x = i ? 0.06 : -0.74, y = 0.14 + 0.62 * j;
      leaf_part.bevelled_box({x, y, 0.02}, {x + 0.68, y + 0.54, 0.085}, 0.03);
    }
  for (const double x : {-1.0, 0.8}) jambs.bevelled_box({x, -0.02, -0.05}, {x + 0.2, 2.66, 0.15}, 0.02);
  jambs.bevelled_box({-1.1, 2.62, -0.05}, {1.1, 2.9, 0.2}, 0.03);
  for (const double x : {-0.07, 0.07})
    ball(knobs, {x, 1.08, 0.13}, 0.05, lod.segments(14, 5), lod.segments(9, 3));
  model.add(std::move(leaf_part), m.wood, "door", bay.frame);
  model.add(std::move(jambs), m.stone, "door_frame", bay.frame);
  if (lod.wants(0.3)) model.add(std::move(knobs), m.brass, "door_knob", bay.frame);
}

// A blind window: a pane behind a stone grid, on the outer wall of a bay, with its sill at height y.
void add_window(Model& model, const Materials& m, const Place& bay, double y) {
  const Lod lod = model.lod(key("window", bay.number + (y > 5.0 ? 100 : 0)));
  if (!lod.wants(0.2)) return;
  MeshBuilder pane = model.part(), tracery = model.part();
  for (auto* part : {&pane, &tracery}) part->set_frame(moved({0, y, -kAisle}));
  const int around = lod.even_segments(28, 6);
  Curve3 outline{{-0.6, 0, 0.03}, {0.6, 0, 0.03}};
  for (const dvec3& p : arc({0, 1.2, 0.03}, {1, 0, 0}, {0, 1, 0}, 0.6, 0.0, kPi, around))
    outline.push_back(p);
  pane.face(outline);
  model.add(std::move(pane), m.mirror, "window_pane", bay.frame);
  Curve3 border{{-0.62, -0.02, 0.02}};
  for (const dvec3& p : arc({0, 1.2, 0.02}, {-1, 0, 0}, {0, 1, 0}, 0.62, 0.0, kPi, around))
    border.push_back(p);
  border.push_back({0.62, -0.02, 0.02});
  tube(tracery, border, 0.07, lod.segments(8, 4));
  for (const double x : {-0.2, 0.2})
    tube(tracery, {{x, -0.02, 0.03}, {x, 1.78, 0.03}}, 0.022, lod.segments(6, 4));
  for (int i = 1; i < 5; ++i)
    tube(tracery, {{-0.6, 0.35 * i, 0.03}, {0.6, 0.35 * i, 0.03}}, 0.018, lod.segments(6, 4));
  tracery.bevelled_box({-0.78, -0.16, -0.05}, {0.78, -0.02, 0.16}, 0.02);
  model.add(std::move(tracery), m.pale_stone, "window_tracery", bay.frame);
}

}  // namespace

void add_ornaments(Model& model, const Materials& m) {
  add_archivolts(model, m);
  add_rosettes(model, m);
  add_lion(model, m, -1.0);
  add_lion(model, m, 1.0);
  for (const Place& bay : bays()) {
    const bool middle_of_end = bay.number == 15 || bay.number == 18;
    if (bay.number % 3 == 1 && !middle_of_end)
      add_door(model, m, bay);
    else if (!middle_of_end)
      add_window(model, m, bay, 1.1);
    add_window(model, m, bay, kGallery + 1.2);
  }
}

}  // namespace hybray::procedural::atrium_parts
