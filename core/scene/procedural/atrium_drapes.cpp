// The atrium's balustrade, the curtains in the lower arcade and the banners that hang over the gallery's
// rail.
#include "core/scene/procedural/atrium.h"

namespace hybray::procedural::atrium_parts {
namespace {

constexpr double kRail = kGallery + 0.98;

void add_bay_of_balustrade(Model& model, const Materials& m, const Place& bay) {
  const Lod lod = model.lod(key("balustrade", bay.number));
  const double half = 0.5 * kBay - 0.27;  // the ends stand in the pedestals of the columns
  MeshBuilder rails = model.part();
  if (lod.wants(0.2)) {
    rails.bevelled_box({-half, kRail - 0.13, -0.13}, {half, kRail, 0.13}, 0.03);
    rails.bevelled_box({-half, kGallery - 0.03, -0.12}, {half, kGallery + 0.12, 0.12}, 0.025);
  } else if (lod.wants(0.05)) {
    rails.box({-half, kGallery - 0.03, -0.1}, {half, kRail, 0.1}, kFront | kBack | kTop);
  }
  model.add(std::move(rails), m.pale_stone, "rail", bay.frame);
  if (!lod.wants(0.2)) return;
  const int count = 9;
  const double foot = kGallery + 0.1, height = kRail - 0.12 - foot;
  const Curve2 profile = smooth(Curve2{{0.075, 0.0},
                                       {0.078, 0.07},
                                       {0.045, 0.1},
                                       {0.05, 0.14},
                                       {0.09, 0.3},
                                       {0.083, 0.42},
                                       {0.042, 0.6},
                                       {0.038, 0.74},
                                       {0.062, 0.8},
                                       {0.04, 0.86},
                                       {0.075, 0.92},
                                       {0.075, 1.0}},
                                lod.segments(20, 6));
  Curve2 scaled;
  for (const dvec2& p : profile) scaled.emplace_back(p.x, foot + height * p.y);
  MeshBuilder balusters = model.part();
  for (int i = 0; i < count; ++i) {
    balusters.set_frame(moved({(i - 0.5 * (count - 1)) * (2.0 * half / count), 0, 0}));
    lathe(balusters, scaled, lod.segments(12, 4));
  }
  model.add(std::move(balusters), m.pale_stone, "baluster", bay.frame);
}

// A curtain on a rod between two columns. `tie` in [0, 1]: how far it is gathered at its middle, toward the
// side `pull` (-1 or 1).
void add_curtain(Model& model, const Materials& m, uint64_t bay_number, uint32_t color, double tie,
                 double pull) {
  const Place& bay = bays()[bay_number];
  const Lod lod = model.lod(key("curtain", bay_number));
  if (!lod.wants(0.06)) return;
  Dice dice = model.dice(key("curtain", bay_number));
  const double phase = dice(0.0, 6.28), waves = std::floor(dice(6.0, 8.0)), drift = dice(0.5, 1.5);
  MeshBuilder part = model.part(), rod = model.part();
  cloth(part, lod.segments(84, 6), lod.segments(60, 2), 0.014, [=](double u, double v) {
    const double bell = std::exp(-std::pow((v - 0.38) / 0.2, 2.0));
    const double width = 2.2 * (1.0 - 0.62 * tie * bell), center = pull * tie * 0.62 * bell;
    const double fold = 2.0 * kPi * waves * u + phase + 0.7 * std::sin(drift * 3.0 * v + phase);
    const double depth = (0.03 + 0.045 * (1.0 - v)) * (1.0 - 0.45 * tie * bell) *
                         (1.0 + 0.4 * std::sin(2.0 * kPi * u * 1.7 + phase));
    return dvec3(center + (u - 0.5) * width + 0.02 * std::cos(fold) * (1.0 - v),
                 0.22 + 3.16 * v + 0.03 * std::sin(fold * 0.5) * (1.0 - v),
                 depth * std::sin(fold) + 0.04 * std::sin(2.0 * v + phase));
  });
  model.add(std::move(part), color, "curtain", bay.frame);
  if (!lod.wants(0.15)) return;
  tube(rod, {{-1.5, 3.42, 0}, {1.5, 3.42, 0}}, 0.025, lod.segments(10, 4));
  const int rings = 12;
  for (int i = 0; i < rings && lod.wants(0.4); ++i)
    ring(rod, {(i - 0.5 * (rings - 1)) * 0.19, 3.4, 0}, {0, 1, 0}, {0, 0, 1}, 0.045, 0.007,
         lod.segments(14, 6), lod.segments(6, 3));
  model.add(std::move(rod), m.brass, "curtain_rod", bay.frame);
}

// A banner over the rail, down into the nave past the cornice.
void add_banner(Model& model, uint64_t bay_number, uint32_t color, double length) {
  const Place& bay = bays()[bay_number];
  const Lod lod = model.lod(key("banner", bay_number));
  if (!lod.wants(0.06)) return;
  Dice dice = model.dice(key("banner", bay_number));
  const double phase = dice(0.0, 6.28), sway = dice(1.0, 2.0);
  const Curve3 path = smooth(Curve3{{0, kRail - 0.5, -0.19},
                                    {0, kRail - 0.06, -0.18},
                                    {0, kRail + 0.035, 0},
                                    {0, kRail - 0.06, 0.18},
                                    {0, kGallery + 0.5, 0.3},
                                    {0, kGallery + 0.06, 0.585},
                                    {0, kGallery - 0.5, 0.64},
                                    {0, kGallery - 0.5 - 0.5 * length, 0.62},
                                    {0, kGallery - 0.5 - length, 0.63}},
                             96);
  MeshBuilder part = model.part();
  cloth(part, lod.segments(44, 4), lod.segments(90, 8), 0.012, [&](double u, double v) {
    const double at = v * 96.0;
    const auto i = static_cast<size_t>(std::min(at, 95.0));
    const dvec3 p = glm::mix(path[i], path[i + 1], at - static_cast<double>(i));
    const double loose = glm::smoothstep(0.45, 1.0, v);
    const double wave = std::sin(2.0 * kPi * 3.0 * u + phase + 2.0 * v) +
                        0.5 * std::sin(2.0 * kPi * 5.0 * u + sway * 4.0 * v);
    const double hem =
        (u - 0.5) * (u - 0.5) * 1.2 * glm::smoothstep(0.8, 1.0, v);  // the lower edge is rounded
    return p + dvec3((0.5 - u) * 1.5, hem, 0.05 * loose * wave + 0.02 * loose);
  });
  model.add(std::move(part), color, "banner", bay.frame);
}

}  // namespace

void add_balustrade(Model& model, const Materials& m) {
  for (const Place& bay : bays()) add_bay_of_balustrade(model, m, bay);
}

void add_drapes(Model& model, const Materials& m) {
  struct Curtain {
    uint64_t bay;
    size_t color;
    double tie, pull;
  };
  for (const Curtain& c : {Curtain{0, 0, 0.0, 0},
                           {1, 0, 1.0, -1},
                           {3, 1, 0.9, 1},
                           {5, 2, 0.0, 0},
                           {6, 2, 1.0, 1},
                           {7, 3, 0.9, -1},
                           {9, 1, 0.0, 0},
                           {11, 0, 0.9, -1},
                           {13, 2, 1.0, 1},
                           {15, 3, 0.9, 1},
                           {18, 1, 0.9, -1}})
    add_curtain(model, m, c.bay, m.cloth[c.color], c.tie, c.pull);
  struct Banner {
    uint64_t bay;
    size_t color;
    double length;
  };
  for (const Banner& b :
       {Banner{2, 2, 1.5}, {4, 3, 1.9}, {8, 0, 1.8}, {10, 2, 1.5}, {12, 1, 1.8}, {15, 0, 1.6}, {18, 2, 1.6}})
    add_banner(model, b.bay, m.cloth[b.color], b.length);
}

}  // namespace hybray::procedural::atrium_parts
