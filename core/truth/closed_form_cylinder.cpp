// Light inside an upright mirrored cylinder. Seen from above, a ray runs along chords of one length and turns
// by one angle at each reflection; its height falls evenly on the way. One angle picks the chords, the way
// that is left when the ray meets the floor picks the place on them. The flux of a piece of a chord is a
// formula, and the piece of a chord inside a rectangle is exact, so quadrature is over the angle alone.
#include "core/scene/procedural/closed_form_scenes.h"
#include "core/truth/closed_form_cases.h"
#include "core/truth/closed_form_quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hybray::truth {
namespace {

using namespace procedural;
constexpr double kPi = std::numbers::pi;
constexpr int kCells = 1 << 16;
constexpr int kMostEvents = 400;  // 0.9^400 is below rounding

struct Rectangle {
  const char* name;
  Interval x, z;
};

// A family member: rays that meet the wall first at `first`, after a way (in plan) of `before`, and land when
// their way is in `way`. carried(a, b): flux a radian of the angle of those that land at a way in [a, b].
struct ChordFamily {
  dvec2 first, direction;  // the direction after the first reflection, unit
  double chord = 0.0, before = 0.0;
  Interval way;
  std::function<double(double, double)> carried;
};

dvec2 turned(const dvec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

// The part of `piece` (of the parameter s of o + s d) where coordinate o + s d lies in `range`.
Interval clipped(const Interval& piece, double o, double d, const Interval& range) {
  if (d == 0.0) return o >= range.low && o < range.high ? piece : Interval{0.0, 0.0};
  const double a = (range.low - o) / d, b = (range.high - o) / d;
  return {std::max(piece.low, std::min(a, b)), std::min(piece.high, std::max(a, b))};
}

double flux_into(const ChordFamily& family, const Rectangle& rectangle, int max_events) {
  const dvec2 second = family.first + family.chord * family.direction;
  const double turn =
      std::atan2(family.first.x * second.y - family.first.y * second.x, glm::dot(family.first, second));
  // Chords are counted by the reflections before them.
  const int first = std::max(1, static_cast<int>((family.way.low - family.before) / family.chord) + 1);
  double flux = 0.0;
  for (int m = first; m <= max_events; ++m) {
    const double begin = family.before + (m - 1) * family.chord;
    if (begin >= family.way.high) break;
    const dvec2 o = turned(family.first, (m - 1) * turn), d = turned(family.direction, (m - 1) * turn);
    Interval s{std::max(0.0, family.way.low - begin), std::min(family.chord, family.way.high - begin)};
    s = clipped(clipped(s, o.x, d.x, rectangle.x), o.y, d.y, rectangle.z);
    if (s.high > s.low)
      flux += std::pow(kMirrorReflectance, m) * family.carried(begin + s.low, begin + s.high);
  }
  return flux;
}

// Midpoint rule over the angle, from -pi/2 to pi/2. The last region is the whole floor inside the wall.
template <class Family>
std::vector<Region> regions_of(const Family& family_at, std::vector<Rectangle> rectangles, double radius,
                               int max_events) {
  rectangles.push_back({"whole floor of the cylinder", {-radius, radius}, {-radius, radius}});
  const auto sum = [&](const Rectangle& rectangle, int cells) {
    double flux = 0.0;
    for (int i = 0; i < cells; ++i)
      flux +=
          flux_into(family_at(kPi * ((i + 0.5) / cells - 0.5)), rectangle, std::min(max_events, kMostEvents));
    return flux * kPi / cells;
  };
  std::vector<Region> regions;
  std::vector<FluxSum> sums;
  for (const Rectangle& r : rectangles) {
    const double coarse = sum(r, kCells), fine = sum(r, 2 * kCells);
    sums.push_back({fine, std::abs(fine - coarse) + 1e-13 * std::abs(fine)});
    regions.push_back(floor_rectangle(r.name, r.x, r.z, sums.back()));
  }
  // No path of the family lands outside, where light from the outer side of the wall does.
  regions.back() = ring_region({0.0, radius}, sums.back());
  regions.back().name = rectangles.back().name;
  return regions;
}

}  // namespace

// Parallel light along +x meets the wall at polar angle phi. It came in over the opposite wall and met this
// one below its rim, so that the way from here to the floor lies within one chord of (height / slope). Flux
// on the wall: E cos(a) cos(phi) R dphi dy with dy = slope * d(way), which is E sin(a) R cos(phi) dphi
// d(way).
std::vector<Region> cylinder_regions(int max_events) {
  using C = CylinderMirror;
  const auto family = [](double phi) {
    ChordFamily f;
    f.first = C::radius * dvec2(std::cos(phi), std::sin(phi));
    f.direction = -dvec2(std::cos(2.0 * phi), std::sin(2.0 * phi));
    f.chord = 2.0 * C::radius * std::cos(phi);
    const double longest = C::height / C::slope;
    f.way = {std::max(0.0, longest - f.chord), longest};
    const double density = kClosedFormIrradiance * C::slope / std::hypot(1.0, C::slope) * f.first.x;
    f.carried = [density](double a, double b) { return density * (b - a); };
    return f;
  };
  return regions_of(family,
                    {{"cusp of the nephroid", {0.45, 0.55}, {-0.05, 0.05}},
                     {"between cusp and wall", {0.6, 0.8}, {-0.1, 0.1}},
                     {"across an arm", {0.1, 0.3}, {0.5, 0.7}},
                     {"inside the caustic", {-0.2, 0.0}, {-0.1, 0.1}}},
                    C::radius, max_events);
}

// From the lamp at height H over a point of the wall, a ray at plan angle alpha to the diameter whose way to
// the floor is w leaves under tan(e) = H / w: the flux of [a, b] is I times the integral of cos(e) de =
// H (1 / sqrt(H^2 + a^2) - 1 / sqrt(H^2 + b^2)). It meets the far wall below its rim if w <= chord / (1 -
// h/H).
std::vector<Region> cardioid_regions(int max_events) {
  using C = CardioidMirror;
  const auto family = [](double alpha) {
    ChordFamily f;
    f.chord = f.before = 2.0 * C::radius * std::cos(alpha);
    const dvec2 incoming(std::cos(alpha), std::sin(alpha));
    f.first = dvec2(-C::radius, 0.0) + f.chord * incoming;
    const dvec2 n = f.first / C::radius;
    f.direction = incoming - 2.0 * glm::dot(incoming, n) * n;
    f.way = {f.chord, f.chord / (1.0 - C::height / C::light_height)};
    f.carried = [](double a, double b) {
      const auto sine = [](double w) { return C::light_height / std::hypot(C::light_height, w); };
      return kClosedFormIntensity * (sine(a) - sine(b));
    };
    return f;
  };
  return regions_of(family,
                    {{"cusp of the cardioid", {0.28, 0.38}, {-0.05, 0.05}},
                     {"between cusp and wall", {0.5, 0.7}, {-0.1, 0.1}},
                     {"beside the cusp", {0.0, 0.2}, {0.2, 0.4}}},
                    C::radius, max_events);
}

}  // namespace hybray::truth
