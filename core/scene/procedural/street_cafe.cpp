// Pavement cafes: round tables with cups, glasses and bottles, bistro chairs, parasols.
#include "core/scene/procedural/street.h"

namespace hybray::procedural::street_parts {
namespace {

void add_chair(Model& model, const Materials& m, const dmat4& frame, uint64_t number) {
  const Lod lod = model.lod(key("chair", number));
  if (!lod.wants(0.13)) return;
  MeshBuilder metal = model.part(), seat = model.part();
  const int s = lod.segments(9, 3);
  tube(metal,
       smooth(Curve3{{-0.2, -0.01, -0.24},
                     {-0.19, 0.44, -0.19},
                     {-0.19, 0.72, -0.24},
                     {-0.13, 0.88, -0.27},
                     {0, 0.92, -0.28},
                     {0.13, 0.88, -0.27},
                     {0.19, 0.72, -0.24},
                     {0.19, 0.44, -0.19},
                     {0.2, -0.01, -0.24}},
              lod.segments(36, 8)),
       0.012, s);
  for (const double x : {-0.18, 0.18})
    tube(metal,
         smooth(Curve3{{x * 1.1, -0.01, 0.22}, {x, 0.3, 0.17}, {x * 0.8, 0.445, 0.12}}, lod.segments(8, 1)),
         0.012, s);
  if (lod.wants(0.3)) {
    ring(metal, {0, 0.27, -0.01}, {1, 0, 0}, {0, 0, 1}, 0.18, 0.008, lod.segments(28, 8), s);
    for (const double x : {-0.09, 0.0, 0.09})
      tube(metal,
           smooth(Curve3{{x, 0.44, -0.17}, {x * 1.3, 0.65, -0.22}, {x, 0.9 - 2.0 * x * x, -0.275}},
                  lod.segments(8, 2)),
           0.008, s);
  }
  lathe(seat,
        smooth(Curve2{{0.0, 0.435}, {0.19, 0.435}, {0.215, 0.45}, {0.2, 0.47}, {0.1, 0.462}, {0.0, 0.46}},
               lod.segments(14, 5)),
        lod.segments(28, 6));
  model.add(std::move(metal), m.iron, "chair_frame", frame);
  model.add(std::move(seat), number % 3 ? m.wood : m.fabric[number % 4], "chair_seat", frame);
}

// What is on a table: a cup on a saucer, a wine glass, a bottle or a small vase.
void set_table(Model& model, const Materials& m, const dmat4& frame, uint64_t number) {
  const Lod lod = model.lod(key("tableware", number));
  if (!lod.wants(0.3)) return;
  Dice dice = model.dice(key("tableware", number));
  const int sides = lod.segments(22, 6);
  MeshBuilder china = model.part(), clear = model.part(), bottle = model.part();
  for (int i = 0; i < 2; ++i) {
    const dmat4 at = turned(dice(0.0, 1.0) + kPi * i) * moved({0.17, 0.738, 0});
    china.set_frame(at);
    lathe(china,
          smooth(Curve2{{0.0, 0.0}, {0.04, 0.0}, {0.075, 0.014}, {0.07, 0.019}, {0.03, 0.008}, {0.0, 0.008}},
                 lod.segments(12, 5)),
          sides);
    lathe(china,
          smooth(Curve2{{0.0, 0.006},
                        {0.022, 0.01},
                        {0.036, 0.03},
                        {0.04, 0.065},
                        {0.036, 0.065},
                        {0.03, 0.03},
                        {0.0, 0.018}},
                 lod.segments(16, 6)),
          sides);
    ring(china, {0.05, 0.04, 0}, {1, 0, 0}, {0, 1, 0}, 0.015, 0.004, lod.segments(12, 6), lod.segments(6, 3));
    if (i == 1 && number % 2) continue;
    clear.set_frame(at * turned(0.9) * moved({-0.04, 0, 0.12}));
    lathe(clear,
          smooth(Curve2{{0.0, 0.0},
                        {0.034, 0.001},
                        {0.03, 0.006},
                        {0.005, 0.012},
                        {0.004, 0.075},
                        {0.02, 0.09},
                        {0.036, 0.125},
                        {0.03, 0.17},
                        {0.027, 0.17},
                        {0.032, 0.126},
                        {0.016, 0.098},
                        {0.0, 0.093}},
                 lod.segments(28, 8)),
          sides);
  }
  bottle.set_frame(moved({dice(-0.05, 0.05), 0.737, dice(-0.05, 0.05)}));
  lathe(bottle,
        smooth(Curve2{{0.0, 0.0},
                      {0.034, 0.002},
                      {0.037, 0.02},
                      {0.037, 0.16},
                      {0.032, 0.19},
                      {0.014, 0.225},
                      {0.0125, 0.28},
                      {0.015, 0.285},
                      {0.014, 0.3},
                      {0.0, 0.302}},
               lod.segments(28, 8)),
        sides);
  model.add(std::move(china), m.ceramic, "cup", frame);
  model.add(std::move(clear), m.glass, "wine_glass", frame);
  if (number % 3 != 2) model.add(std::move(bottle), m.wine, "bottle", frame);
}

void add_table(Model& model, const Materials& m, const dmat4& frame, uint64_t number) {
  const Lod lod = model.lod(key("table", number));
  if (lod.wants(0.1)) {
    MeshBuilder top = model.part(), foot = model.part();
    const int sides = lod.segments(36, 8);
    lathe_pieces(top,
                 {{{0.0, 0.71}, {0.33, 0.71}},
                  smooth(Curve2{{0.33, 0.71}, {0.345, 0.725}, {0.33, 0.74}}, lod.segments(6, 2)),
                  {{0.33, 0.74}, {0.0, 0.74}}},
                 sides);
    lathe(foot,
          smooth(Curve2{{0.05, 0.06}, {0.06, 0.12}, {0.03, 0.2}, {0.025, 0.6}, {0.05, 0.68}, {0.1, 0.715}},
                 lod.segments(16, 3)),
          lod.segments(14, 4));
    for (int i = 0; i < 3; ++i) {
      foot.set_frame(turned(2.0 * kPi * i / 3.0));
      tube(foot,
           smooth(Curve3{{0, 0.14, 0}, {0, 0.13, 0.1}, {0, 0.05, 0.2}, {0, 0.01, 0.27}}, lod.segments(10, 3)),
           0.025, 0.018, lod.segments(8, 4));
    }
    model.add(std::move(top), number % 2 ? m.ceramic : m.brass, "table_top", frame);
    model.add(std::move(foot), m.iron, "table_foot", frame);
  }
  set_table(model, m, frame, number);
}

void add_parasol(Model& model, const Materials& m, const dmat4& frame, uint64_t number) {
  const Lod lod = model.lod(key("parasol", number));
  if (!lod.wants(0.07)) return;
  MeshBuilder canopy = model.part(), pole = model.part();
  const int ribs = 8, around = ribs * lod.segments(6, 1), rings = lod.segments(12, 2);
  const auto canvas = [&](double u, double v,
                          double lift) {  // v = 0 at the rim; the cloth sags between the ribs
    const double a = 2.0 * kPi * u, between = std::abs(std::sin(0.5 * ribs * a)),
                 r = 1.45 * (1.0 - v) * (1.0 - 0.07 * between * (1.0 - v));
    return dvec3(r * std::cos(a), 2.25 + 0.5 * v + 0.1 * v * v - 0.1 * between * (1.0 - v) + lift,
                 -r * std::sin(a));
  };
  canopy.surface(around, rings, {.closed_u = true, .pole_end = true},
                 [&](double u, double v) { return canvas(u, v, 0.0); });
  canopy.surface(around, rings, {.closed_u = true, .pole_end = true},
                 [&](double u, double v) { return canvas(1.0 - u, v, -0.012); });
  canopy.surface(around, 1, {.closed_u = true},
                 [&](double u, double v) { return canvas(u, 0.0, -0.19 * (1.0 - v)); });
  canopy.surface(around, 1, {.closed_u = true}, [&](double u, double v) {
    const dvec3 p = canvas(1.0 - u, 0.0, -0.19 * (1.0 - v));
    return dvec3(p.x * 0.994, p.y - 0.002, p.z * 0.994);
  });
  canopy.surface(around, 1, {.closed_u = true}, [&](double u, double v) {  // the hem
    const dvec3 p = canvas(u, 0.0, -0.19);
    const double scale = 0.994 + 0.006 * v;
    return dvec3(p.x * scale, p.y - 0.002 * (1.0 - v), p.z * scale);
  });
  const int s = lod.segments(12, 4);
  tube(pole, {{0, -0.02, 0}, {0, 2.86, 0}}, 0.024, s);
  ball(pole, {0, 2.89, 0}, 0.04, s, lod.segments(8, 3));
  lathe(
      pole,
      smooth(Curve2{{0.3, -0.02}, {0.3, 0.06}, {0.1, 0.1}, {0.05, 0.25}, {0.023, 0.3}}, lod.segments(12, 4)),
      2 * s);
  for (int i = 0; i < ribs && lod.wants(0.25); ++i) {
    const double a = 2.0 * kPi * i / ribs;
    tube(pole,
         {{0.02 * std::cos(a), 2.2, 0.02 * std::sin(a)}, {0.78 * std::cos(a), 2.48, 0.78 * std::sin(a)}},
         0.008, lod.segments(6, 3));
  }
  model.add(std::move(canopy), number % 2 ? m.canvas : m.fabric[number % 4], "parasol", frame);
  model.add(std::move(pole), m.wood, "parasol_pole", frame);
}

}  // namespace

void add_cafes(Model& model, const Materials& m) {
  struct Terrace {
    dvec3 corner;
    double yaw;
    int columns, rows;
    bool parasols;
  };
  uint64_t table = 0, chair = 0, parasol = 0;
  for (const Terrace& t : {Terrace{{-10.6, kPavement, -12.6}, 0.1, 4, 2, true},
                           {{2.4, kPavement, -12.4}, -0.15, 3, 2, true},
                           {{-33.0, kPavement, -5.0}, 0.0, 3, 1, false},
                           {{-18.6, kPavement, 5.0}, 0.0, 3, 1, false},
                           {{11.0, kPavement, 6.9}, -0.3, 3, 1, false},
                           {{20.0, kPavement, -1.1}, -0.31, 3, 1, false}})
    for (int row = 0; row < t.rows; ++row)
      for (int column = 0; column < t.columns; ++column, ++table) {
        Dice dice = model.dice(key("terrace", table));
        const dmat4 at = moved(t.corner) * turned(t.yaw) *
                         moved({column * 1.95 + dice(-0.15, 0.15), 0, row * 2.3 + dice(-0.15, 0.15)});
        add_table(model, m, at, table);
        const int chairs = t.rows == 1 ? 2 : 3;
        const double first = t.rows == 1 ? 0.5 * kPi : dice(0.0, 6.28);
        for (int i = 0; i < chairs; ++i)
          add_chair(model, m,
                    at * turned(first + 2.0 * kPi * i / chairs + dice(-0.25, 0.25)) *
                        moved({0, 0, -dice(0.52, 0.62)}) * turned(dice(-0.3, 0.3)),
                    chair++);
        if (t.parasols && (row + column) % 2 == 0)
          add_parasol(model, m, at * moved({0.98, 0, 1.15}), parasol++);
      }
}

}  // namespace hybray::procedural::street_parts
