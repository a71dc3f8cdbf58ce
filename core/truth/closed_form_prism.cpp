// Parallel light through a prism, across its edges: all happens in the cross section. Along one sequence of
// faces, every ray has the same angles, so carries the same share, and lands at a place that is linear in
// where it entered; the rays between two neighbours with the same sequence are known exactly from the two.
// Between neighbours with different sequences, an edge of the prism lies; the flux of so narrow a strip is
// given to where its own end lands and counted as error.
#include "core/base/hash.h"
#include "core/scene/procedural/closed_form_scenes.h"
#include "core/truth/closed_form_cases.h"
#include "core/truth/closed_form_optics.h"
#include "core/truth/closed_form_quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hybray::truth {
namespace {

using namespace procedural;
constexpr double kPi = std::numbers::pi;
constexpr int kStrips = 1 << 16;
constexpr int kMostEvents = 200;
constexpr double kNegligible = 1e-14;

struct Section {
  std::vector<dvec2> corners;  // counter-clockwise
  dvec2 light;                 // unit direction of travel
  dvec2 receiver, along;       // a point of the receiver; its coordinate grows along this unit direction
  double half_length;          // of the prism, across the section
};

struct Landing {
  uint64_t faces;  // hash of the sequence of faces
  double place;    // coordinate on the receiver
  double share;    // of the ray's flux
};

dvec2 rotated(const dvec2& v, double angle) {
  return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y};
}
double cross(const dvec2& a, const dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

dvec2 edge_of(const Section& s, int face) {
  return s.corners[(face + 1) % s.corners.size()] - s.corners[face];
}
dvec2 outward(const Section& s, int face) {
  const dvec2 e = edge_of(s, face);
  return glm::normalize(dvec2(e.y, -e.x));
}

// The face that o + t d meets on its way in (`entering`) or out, and where; -1 for none.
int next_face(const Section& s, const dvec2& o, const dvec2& d, bool entering, dvec2& point) {
  for (int face = 0; face < static_cast<int>(s.corners.size()); ++face) {
    const double toward = glm::dot(d, outward(s, face));
    if (entering ? toward >= 0.0 : toward <= 0.0) continue;
    const dvec2 e = edge_of(s, face);
    const double along = cross(s.corners[face] - o, d) / cross(d, e);
    if (!(along >= 0.0 && along < 1.0)) continue;
    point = s.corners[face] + along * e;
    return face;
  }
  return -1;
}

// Where a ray that has left the prism, which is convex, meets the receiver.
void land(const Section& s, const dvec2& o, const dvec2& d, uint64_t faces, double share,
          std::vector<Landing>& landings) {
  const double across = cross(d, s.along);
  if (std::abs(across) < 1e-12 || share <= 0.0) return;
  if (cross(s.receiver - o, s.along) / across <= 0.0) return;
  landings.push_back({faces, cross(o - s.receiver, d) / cross(s.along, d), share});
}

// Follows the ray through `o` with the light's direction. A ray splits at each face; only what stays inside
// goes on, so the paths form a chain.
void follow(const Section& s, dvec2 o, int max_events, std::vector<Landing>& landings) {
  dvec2 point;
  int face = next_face(s, o, s.light, true, point);
  if (face < 0) return;
  // Angles are signed, from the normal that points the way of travel.
  const auto signed_angle = [](const dvec2& d, const dvec2& n) {
    return std::atan2(cross(n, d), glm::dot(n, d));
  };
  dvec2 n = -outward(s, face);
  double i = signed_angle(s.light, n);
  double f = unpolarised_reflectance(std::abs(i), kGlassIor);
  uint64_t faces = mix_bits(static_cast<uint64_t>(face) + 1);
  land(s, point, rotated(-n, -i), mix_bits(faces), f, landings);
  double share = 1.0 - f;
  dvec2 d = rotated(n, std::copysign(refraction_angle(std::abs(i), kGlassIor), i));
  for (int events = 2; events <= max_events && share > kNegligible; ++events) {
    face = next_face(s, point, d, false, point);
    if (face < 0) return;  // through a corner
    faces = mix_bits(4 * faces + static_cast<uint64_t>(face) + 1);
    n = outward(s, face);
    i = signed_angle(d, n);
    f = unpolarised_reflectance(std::abs(i), 1.0 / kGlassIor);
    if (f < 1.0) {
      const dvec2 out = rotated(n, std::copysign(refraction_angle(std::abs(i), 1.0 / kGlassIor), i));
      land(s, point, out, faces, share * (1.0 - f), landings);
    }
    share *= f;
    d = rotated(-n, -i);
  }
}

struct Rectangle {
  const char* name;
  Interval along, z;
};

// Flux that lands in each interval of the receiver, a metre of the prism's length.
std::vector<FluxSum> flux_per_metre(const Section& s, int max_events, const std::vector<Rectangle>& wanted) {
  const dvec2 across(-s.light.y, s.light.x);
  Interval beam{1e30, -1e30};
  for (const dvec2& corner : s.corners) {
    beam.low = std::min(beam.low, glm::dot(corner, across));
    beam.high = std::max(beam.high, glm::dot(corner, across));
  }
  const double step = (beam.high - beam.low) / kStrips, strip = kClosedFormIrradiance * step;
  const auto sample = [&](int i, std::vector<Landing>& landings) {
    landings.clear();
    follow(s, -100.0 * s.light + (beam.low + (i + 0.5) * step) * across, max_events, landings);
  };
  std::vector<FluxSum> sums(wanted.size());
  const auto add_lone = [&](const Landing& l, double part) {
    for (size_t r = 0; r < wanted.size(); ++r)
      if (l.place >= wanted[r].along.low && l.place < wanted[r].along.high) {
        sums[r].flux += part * strip * l.share;
        sums[r].error += part * strip * l.share;
      }
  };
  // Half a strip at both ends of the beam; between two samples, what both have, and half of what one has.
  std::vector<Landing> a, b;
  sample(0, a);
  for (const Landing& l : a) add_lone(l, 0.5);
  for (int i = 1; i < kStrips; ++i) {
    sample(i, b);
    const auto partner = [](const Landing& l, const std::vector<Landing>& others) {
      return std::find_if(others.begin(), others.end(), [&](const Landing& o) { return o.faces == l.faces; });
    };
    for (const Landing& l : a) {
      const auto other = partner(l, b);
      if (other == b.end()) {
        add_lone(l, 0.5);
        continue;
      }
      for (size_t r = 0; r < wanted.size(); ++r)
        sums[r].flux += strip * l.share * share_inside(l.place, other->place, wanted[r].along);
    }
    for (const Landing& l : b)
      if (partner(l, a) == a.end()) add_lone(l, 0.5);
    std::swap(a, b);
  }
  for (const Landing& l : a) add_lone(l, 0.5);
  for (FluxSum& sum : sums) sum.error += 1e-12 * sum.flux;
  return sums;
}

std::vector<Region> regions_of(const Section& section, int max_events,
                               const std::vector<Rectangle>& rectangles) {
  const auto sums = flux_per_metre(section, std::min(max_events, kMostEvents), rectangles);
  std::vector<Region> regions;
  for (size_t r = 0; r < rectangles.size(); ++r) {
    const Rectangle& rectangle = rectangles[r];
    const double length =
        std::min(rectangle.z.high, section.half_length) - std::max(rectangle.z.low, -section.half_length);
    Region region;
    region.name = rectangle.name;
    region.contains = [rectangle, along = section.along](const dvec3& p) {
      const double place = glm::dot(dvec2(p), along);
      return place >= rectangle.along.low && place < rectangle.along.high && p.z >= rectangle.z.low &&
             p.z < rectangle.z.high;
    };
    const double area = (rectangle.along.high - rectangle.along.low) * (rectangle.z.high - rectangle.z.low);
    set_irradiance(region, area, {sums[r].flux * length, sums[r].error * length});
    regions.push_back(region);
  }
  return regions;
}

}  // namespace

std::vector<Region> prism_regions(int max_events) {
  using C = Prism;
  const double height = 0.5 * std::numbers::sqrt3 * C::side, y = C::center_height;
  const double angle = C::light_angle * kPi / 180.0;
  const Section section{
      {{-height * 2 / 3, y}, {height / 3, y - 0.5 * C::side}, {height / 3, y + 0.5 * C::side}},
      {std::cos(angle), std::sin(angle)},
      {0.0, 0.0},
      {1.0, 0.0},
      C::half_length};
  return regions_of(section, max_events,
                    {{"middle of the deviated beam", {0.2, 0.55}, {-0.5, 0.5}},
                     {"edge of the deviated beam", {0.6, 0.8}, {-0.5, 0.5}},
                     {"floor around", {-4.0, 4.0}, {-2.0, 2.0}}});
}

std::vector<Region> tir_prism_regions(int max_events) {
  using C = TirPrism;
  const Section section{{{C::right_angle_x - C::leg, C::right_angle_y},
                         {C::right_angle_x, C::right_angle_y - C::leg},
                         {C::right_angle_x, C::right_angle_y}},
                        {0.0, -1.0},
                        {C::wall_x, 0.0},
                        {0.0, 1.0},
                        C::half_length};
  return regions_of(
      section, max_events,
      {{"middle of the turned beam", {1.25, 1.75}, {-0.5, 0.5}}, {"whole wall", {0.5, 3.5}, {-2.0, 2.0}}});
}

}  // namespace hybray::truth
