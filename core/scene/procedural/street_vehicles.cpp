// Bicycles at racks and walls, and small round-backed cars along the kerb.
#include "core/scene/procedural/street.h"

namespace hybray::procedural::street_parts {
namespace {

// A bicycle that heads along +x and stands on y = 0 in the plane z = 0.
void add_bicycle(Model& model, const Materials& m, const dmat4& frame, uint64_t number) {
  const Lod lod = model.lod(key("bicycle", number));
  if (!lod.wants(0.14)) return;
  MeshBuilder tyres = model.part(), metal = model.part(), body = model.part(), leather = model.part();
  const int around = lod.segments(48, 8), s = lod.segments(8, 3);
  const dvec3 x(1, 0, 0), y(0, 1, 0), rear(-0.53, 0.345, 0), front(0.53, 0.345, 0), crank(-0.08, 0.29, 0),
      seat(-0.22, 0.8, 0), head(0.36, 0.82, 0), neck(0.39, 0.68, 0);
  for (const dvec3& hub : {rear, front}) {
    ring(tyres, hub, x, y, 0.33, 0.019, around, s);
    ring(metal, hub, x, y, 0.308, 0.009, around, lod.segments(6, 3));
    tube(metal, {hub - dvec3(0, 0, 0.06), hub + dvec3(0, 0, 0.06)}, 0.02, s);
    const int spokes = lod.wants(0.25) ? 24 : 6;
    for (int i = 0; i < spokes; ++i) {
      const double a = 2.0 * kPi * i / spokes, b = a + (i % 4 < 2 ? 0.35 : -0.35);
      const dvec3 from = hub + dvec3(0.018 * std::cos(b), 0.018 * std::sin(b), i % 2 ? 0.03 : -0.03);
      tube(metal, {from, hub + 0.303 * dvec3(std::cos(a), std::sin(a), 0)}, 0.0022, 3);
    }
    tube(body, arc(hub, x, y, 0.365, 0.5, 2.9, lod.segments(20, 4)), 0.012, s);  // mudguard
  }
  for (const auto& [a, b] : {std::pair{crank, seat},
                             {crank, neck},
                             {seat - dvec3(0.01, 0.06, 0), head - dvec3(0, 0.05, 0)},
                             {neck, head}})
    tube(body, {a, b}, 0.016, s);
  for (const double z : {-0.05, 0.05}) {
    tube(body, {crank + dvec3(0, 0, 0.4 * z), rear + dvec3(0, 0, z)}, 0.009, s);
    tube(body, {seat - dvec3(0, 0.06, -0.3 * z), rear + dvec3(0, 0, z)}, 0.008, s);
    tube(metal,
         smooth(Curve3{neck + dvec3(0.005, -0.02, z), {0.44, 0.5, z}, front + dvec3(0, 0, z)},
                lod.segments(8, 2)),
         0.011, s);
  }
  tube(metal, {seat, seat + dvec3(-0.02, 0.12, 0)}, 0.012, s);
  tube(metal, {head, head + dvec3(-0.02, 0.14, 0)}, 0.012, s);
  tube(metal,
       smooth(Curve3{{0.18, 0.96, -0.29},
                     {0.28, 0.99, -0.26},
                     {0.35, 0.96, -0.1},
                     {0.345, 0.955, 0},
                     {0.35, 0.96, 0.1},
                     {0.28, 0.99, 0.26},
                     {0.18, 0.96, 0.29}},
              lod.segments(30, 6)),
       0.011, s);
  ring(metal, crank + dvec3(0, 0, 0.035), x, y, 0.09, 0.006, lod.segments(28, 8), lod.segments(6, 3));
  for (const double side : {-1.0, 1.0}) {
    const dvec3 end = crank + dvec3(0.16 * side, -0.05 * side, 0.06 * side);
    tube(metal, {crank + dvec3(0, 0, 0.06 * side), end}, 0.01, s);
    tube(leather, {end, end + dvec3(0, 0, 0.09 * side)}, 0.014, s);
    tube(leather, {{0.26, 0.985, 0.263 * side}, {0.17, 0.957, 0.293 * side}}, 0.017, s);
  }
  leather.surface(lod.segments(18, 6), lod.segments(12, 4),
                  {.closed_u = true, .pole_begin = true, .pole_end = true}, [&](double u, double v) {
                    const double a = 2.0 * kPi * u, r = std::sin(kPi * v),
                                 wide = 0.035 + 0.05 * glm::smoothstep(0.4, 1.0, v);
                    return dvec3(-0.1 - 0.27 * v, 0.94 + 0.03 * r * std::sin(a) + 0.02 * v,
                                 wide * r * std::cos(a));
                  });
  model.add(std::move(tyres), m.rubber, "bicycle_tyre", frame);
  model.add(std::move(metal), m.chrome, "bicycle_metal", frame);
  model.add(std::move(body), m.paint[number % 4], "bicycle_frame", frame);
  model.add(std::move(leather), m.wood, "bicycle_leather", frame);
}

// A body lofted along x from -1 to 1: its cross-sections are superellipses of exponent `square`.
template <class Section>
void loft(MeshBuilder& part, int around, int along, double square, const Section& section) {
  part.surface(
      around, along, {.closed_u = true, .pole_begin = true, .pole_end = true}, [&](double u, double v) {
        const double a = 2.0 * kPi * u, t = -std::cos(kPi * v);
        const auto power = [&](double c) { return std::copysign(std::pow(std::abs(c), 2.0 / square), c); };
        const auto [x, low, high, half] = section(t);
        return dvec3(x, 0.5 * (low + high) + 0.5 * (high - low) * power(std::cos(a)),
                     half * power(std::sin(a)));
      });
}

struct Section {
  double x, low, high, half;
};

// A small car heading along +x, standing on y = 0.
void add_car(Model& model, const Materials& m, const dmat4& frame, uint64_t number) {
  const Lod lod = model.lod(key("car", number));
  if (!lod.wants(0.05)) return;
  MeshBuilder body = model.part(), cabin = model.part(), roof = model.part(), tyres = model.part(),
              chrome = model.part(), lamps = model.part();
  const int around = lod.segments(48, 8), along = lod.segments(48, 6);
  const auto bulge = [](double t, double exponent) {
    return std::pow(std::max(0.0, 1.0 - std::pow(std::abs(t), exponent)), 1.0 / exponent);
  };
  loft(body, around, along, 3.6, [&](double t) {
    const double b = bulge(t, 3.0);
    return Section{1.75 * t, 0.47 - 0.23 * b,
                   0.47 + b * (0.40 - 0.07 * t * t + (t > 0.2 ? -0.06 * (t - 0.2) : 0.0)), 0.74 * b};
  });
  loft(cabin, around, along, 3.0, [&](double t) {
    const double b = bulge(t, 2.6);
    return Section{-0.22 + 1.12 * t, 0.6, 0.6 + 0.78 * b, (0.66 - 0.03 * t * t) * b};
  });
  loft(roof, around, along, 3.0, [&](double t) {
    const double b = bulge(t, 2.6);
    return Section{-0.27 + 0.8 * t, 1.2, 1.2 + 0.2 * b, 0.6 * b};
  });
  for (const double x : {-1.12, 1.12})
    for (const double side : {-1.0, 1.0}) {
      const dmat4 wheel = moved({x, 0.3, side * 0.62}) * turned(side * 0.5 * kPi, dvec3(1, 0, 0));
      tyres.set_frame(wheel);
      lathe(tyres,
            smooth(Curve2{{0.0, -0.08},
                          {0.25, -0.09},
                          {0.3, -0.06},
                          {0.305, 0.02},
                          {0.29, 0.1},
                          {0.24, 0.12},
                          {0.19, 0.1}},
                   lod.segments(16, 5)),
            lod.segments(36, 8));
      chrome.set_frame(wheel);
      lathe(chrome,
            smooth(Curve2{{0.2, 0.09}, {0.18, 0.11}, {0.12, 0.09}, {0.08, 0.13}, {0.0, 0.145}},
                   lod.segments(12, 3)),
            lod.segments(28, 6));
      body.set_frame(moved({x, 0.36, side * 0.62}));  // the wing over the wheel
      body.surface(lod.segments(28, 6), lod.segments(20, 4),
                   {.closed_u = true, .pole_begin = true, .pole_end = true}, [&](double u, double v) {
                     const double a = 2.0 * kPi * u, r = std::sin(kPi * v);
                     return dvec3(-0.5 * std::cos(kPi * v),
                                  0.02 + (std::cos(a) > 0 ? 0.33 : 0.05) * r * std::cos(a),
                                  0.2 * r * std::sin(a));
                   });
      body.set_frame(dmat4(1.0));
    }
  chrome.set_frame(dmat4(1.0));
  const int s = lod.segments(8, 4);
  for (const double end : {-1.0, 1.0}) {
    tube(chrome,
         smooth(Curve3{{end * 1.35, 0.42, -0.76},
                       {end * 1.78, 0.42, -0.5},
                       {end * 1.84, 0.42, 0},
                       {end * 1.78, 0.42, 0.5},
                       {end * 1.35, 0.42, 0.76}},
                lod.segments(24, 6)),
         0.04, s);
    for (const double side : {-1.0, 1.0}) {
      ball(lamps, {end * 1.6, 0.64, side * 0.48}, end > 0 ? 0.11 : 0.07, lod.segments(20, 6),
           lod.segments(12, 4));
      if (end > 0)
        ring(chrome, {1.625, 0.64, side * 0.48}, {0, 0, 1}, {0, 1, 0}, 0.108, 0.016, lod.segments(24, 8), s);
    }
  }
  for (const double side : {-1.0, 1.0})
    tube(chrome, {{-1.2, 0.6, side * 0.745}, {1.1, 0.62, side * 0.745}}, 0.012, s);
  model.add(std::move(body), m.paint[number % 4], "car_body", frame);
  model.add(std::move(cabin), m.pane, "car_cabin", frame);
  model.add(std::move(roof), m.paint[number % 4], "car_roof", frame);
  model.add(std::move(tyres), m.rubber, "car_tyre", frame);
  model.add(std::move(chrome), m.chrome, "car_chrome", frame);
  model.add(std::move(lamps), m.glass, "car_lamp", frame);
}

}  // namespace

void add_vehicles(Model& model, const Materials& m) {
  uint64_t number = 0;
  const dmat4 lean = turned(0.1, dvec3(1, 0, 0));
  for (int i = 0; i < 5; ++i)
    add_bicycle(model, m, moved({-26.5 + 0.75 * i, kPavement, -4.9}) * turned(1.35) * lean, number++);
  for (int i = 0; i < 4; ++i)
    add_bicycle(model, m, moved({8.3, kPavement, -19.2 + 0.8 * i}) * turned(0.25) * lean, number++);
  add_bicycle(model, m, moved({-16.4, kPavement, -6.15}) * turned(kPi) * turned(0.14, dvec3(1, 0, 0)),
              number++);
  add_bicycle(model, m, moved({18.0, kPavement, 8.6}) * turned(2.8) * lean, number++);
  add_car(model, m, moved({-21.0, 0, 2.6}) * turned(kPi), 0);
  add_car(model, m, moved({-30.5, 0, 2.65}) * turned(kPi + 0.03), 1);
  add_car(model, m, moved({13.6, 0, -0.2}) * turned(-0.31), 2);
  add_car(model, m, moved({25.4, 0, 8.9}) * turned(kPi - 0.32), 3);
}

}  // namespace hybray::procedural::street_parts
