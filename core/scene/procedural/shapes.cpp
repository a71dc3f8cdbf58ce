#include "core/scene/procedural/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybray::procedural {
namespace {

template <class Point>
std::vector<Point> catmull_rom(const std::vector<Point>& points, int segments) {
  const int spans = static_cast<int>(points.size()) - 1;
  const auto at = [&](int i) {
    if (i < 0) return 2.0 * points.front() - points[1];
    if (i > spans) return 2.0 * points.back() - points[points.size() - 2];
    return points[static_cast<size_t>(i)];
  };
  std::vector<Point> curve;
  for (int k = 0; k <= segments; ++k) {
    const double s = static_cast<double>(k) * spans / segments;
    const int i = std::min(static_cast<int>(s), spans - 1);
    const double t = s - i;
    const Point a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    curve.push_back(0.5 * (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                           t * t * t * (3.0 * b - 3.0 * c + d - a)));
  }
  return curve;
}

}  // namespace

Curve2 smooth(const Curve2& points, int segments) {
  return catmull_rom(points, segments);
}
Curve3 smooth(const Curve3& points, int segments) {
  return catmull_rom(points, segments);
}

void lathe(MeshBuilder& part, const Curve2& profile, int sides) {
  constexpr double kPole = 1e-9;
  const int nv = static_cast<int>(profile.size()) - 1;
  const GridShape shape{
      .closed_u = true, .pole_begin = profile.front().x < kPole, .pole_end = profile.back().x < kPole};
  part.surface(sides, nv, shape, [&](double u, double v) {
    const dvec2 p = profile[static_cast<size_t>(std::lround(v * nv))];
    const double a = 2.0 * kPi * u;
    return dvec3(p.x * std::cos(a), p.y, -p.x * std::sin(a));
  });
}

void lathe_pieces(MeshBuilder& part, const std::vector<Curve2>& pieces, int sides) {
  for (const Curve2& piece : pieces) lathe(part, piece, sides);
}

void ball(MeshBuilder& part, const dvec3& center, double radius, int sides, int rings) {
  const GridShape shape{.closed_u = true, .pole_begin = true, .pole_end = true};
  part.surface(sides, rings, shape, [&](double u, double v) {
    const double a = 2.0 * kPi * u, b = kPi * v;
    return center + radius * dvec3(std::sin(b) * std::cos(a), -std::cos(b), -std::sin(b) * std::sin(a));
  });
}

void tube(MeshBuilder& part, const Curve3& path, double radius, double end_radius, int sides, bool closed) {
  const int points = static_cast<int>(path.size()), nv = closed ? points : points - 1;
  std::vector<dvec3> across;  // first axis of each ring, carried along the path without twist
  std::vector<dvec3> tangents;
  if (!part.counting()) {
    for (int i = 0; i < points; ++i) {
      const int before = closed ? (i + points - 1) % points : std::max(i - 1, 0);
      const int after = closed ? (i + 1) % points : std::min(i + 1, points - 1);
      const dvec3 tangent =
          glm::normalize(path[static_cast<size_t>(after)] - path[static_cast<size_t>(before)]);
      dvec3 a = i > 0 ? across.back() : (std::abs(tangent.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0));
      a = glm::normalize(a - glm::dot(a, tangent) * tangent);
      across.push_back(a);
      tangents.push_back(tangent);
    }
  }
  const auto point = [&](int i, double u) {
    const auto at = static_cast<size_t>(i % points);
    const double r = radius + (end_radius - radius) * i / nv, angle = 2.0 * kPi * u;
    const dvec3 b = glm::cross(tangents[at], across[at]);
    return path[at] + r * (std::cos(angle) * across[at] + std::sin(angle) * b);
  };
  part.surface(sides, nv, {.closed_u = true, .closed_v = closed},
               [&](double u, double v) { return point(static_cast<int>(std::lround(v * nv)), u); });
  if (closed) return;
  Curve3 begin(static_cast<size_t>(sides), dvec3(0.0)), end = begin;
  for (int i = 0; i < sides && !part.counting(); ++i) {
    begin[static_cast<size_t>(sides - 1 - i)] = point(0, static_cast<double>(i) / sides);
    end[static_cast<size_t>(i)] = point(nv, static_cast<double>(i) / sides);
  }
  part.face(begin);
  part.face(end);
}

Curve3 arc(const dvec3& center, const dvec3& a, const dvec3& b, double radius, double from, double to,
           int segments) {
  Curve3 points;
  for (int i = 0; i <= segments; ++i) {
    const double angle = from + (to - from) * i / segments;
    points.push_back(center + radius * (std::cos(angle) * a + std::sin(angle) * b));
  }
  return points;
}

void ring(MeshBuilder& part, const dvec3& center, const dvec3& a, const dvec3& b, double radius,
          double thickness, int segments, int sides) {
  Curve3 path = arc(center, a, b, radius, 0.0, 2.0 * kPi, segments);
  path.pop_back();
  tube(part, path, thickness, thickness, sides, true);
}

void moulding(MeshBuilder& part, const Curve2& profile, double x0, double x1, bool rounded) {
  const auto at = [&](size_t i, double x) { return dvec3(x, profile[i].y, profile[i].x); };
  const int nv = static_cast<int>(profile.size()) - 1;
  if (rounded)
    part.surface(1, nv, {}, [&](double u, double v) {
      return at(static_cast<size_t>(std::lround(v * nv)), x0 + u * (x1 - x0));
    });
  else
    for (size_t i = 0; i + 1 < profile.size(); ++i)
      part.quad(at(i, x0), at(i, x1), at(i + 1, x1), at(i + 1, x0));
  Curve3 left{at(profile.size() - 1, x0)}, right;  // fans about the profile's last point
  for (size_t i = 0; i < profile.size(); ++i) {
    if (i + 1 < profile.size()) left.push_back(at(i, x0));
    right.push_back(at(profile.size() - 1 - i, x1));
  }
  part.face(left);
  part.face(right);
}

void wall_with_openings(MeshBuilder& part, double x0, double x1, double y0, double y1,
                        const std::vector<Opening>& openings) {
  std::vector<double> xs{x0, x1}, ys{y0, y1};
  for (const Opening& o : openings) {
    xs.insert(xs.end(), {o.x0, o.x1});
    ys.insert(ys.end(), {o.y0, o.y1});
  }
  for (auto* cuts : {&xs, &ys}) {
    std::sort(cuts->begin(), cuts->end());
    cuts->erase(std::unique(cuts->begin(), cuts->end(), [](double a, double b) { return b - a < 1e-6; }),
                cuts->end());
  }
  for (size_t j = 0; j + 1 < ys.size(); ++j)
    for (size_t i = 0; i + 1 < xs.size(); ++i) {
      const double x = 0.5 * (xs[i] + xs[i + 1]), y = 0.5 * (ys[j] + ys[j + 1]);
      const bool open = std::any_of(openings.begin(), openings.end(), [&](const Opening& o) {
        return x > o.x0 && x < o.x1 && y > o.y0 && y < o.y1;
      });
      if (!open)
        part.quad({xs[i], ys[j], 0}, {xs[i + 1], ys[j], 0}, {xs[i + 1], ys[j + 1], 0}, {xs[i], ys[j + 1], 0});
    }
}

void arch_bay(MeshBuilder& part, const ArchBay& bay, int segments) {
  const double half = 0.5 * bay.width, z = 0.5 * bay.thickness;
  const auto on_arch = [&](int i, double at_z) {
    const double a = kPi * i / segments;
    return dvec3(-bay.radius * std::cos(a), bay.y0 + bay.radius * std::sin(a), at_z);
  };
  part.surface(1, segments, {}, [&](double u, double v) {  // the soffit, facing the opening
    return on_arch(static_cast<int>(std::lround(v * segments)), (1.0 - 2.0 * u) * z);
  });
  // Each half of a face is a fan about its upper outer corner, from where the whole arch is in sight.
  for (double side : {-1.0, 1.0}) {
    Curve3 front{{side * half, bay.y1, z}, {side * half, bay.y0, z}};
    const int spring = side < 0.0 ? 0 : segments, step = side < 0.0 ? 1 : -1;
    for (int i = 0; i <= segments / 2; ++i) front.push_back(on_arch(spring + i * step, z));
    front.push_back({0.0, bay.y1, z});
    Curve3 back = front;
    for (dvec3& p : back) p.z = -z;
    std::reverse((side < 0.0 ? back : front).begin() + 1, (side < 0.0 ? back : front).end());
    part.face(front);
    part.face(back);
  }
}

void cloth(MeshBuilder& part, int nu, int nv, double thickness,
           const std::function<dvec3(double, double)>& middle) {
  constexpr double kStep = 1e-4;
  // Half the thickness to the front (side 1) or the back (-1) of the middle surface.
  const auto offset = [&](double u, double v, double side) {
    const double u0 = std::max(u - kStep, 0.0), u1 = std::min(u + kStep, 1.0);
    const double v0 = std::max(v - kStep, 0.0), v1 = std::min(v + kStep, 1.0);
    const dvec3 n = glm::normalize(glm::cross(middle(u1, v) - middle(u0, v), middle(u, v1) - middle(u, v0)));
    return middle(u, v) + 0.5 * side * thickness * n;
  };
  part.surface(nu, nv, {}, [&](double u, double v) { return offset(u, v, 1.0); });
  part.surface(nu, nv, {}, [&](double u, double v) { return offset(1.0 - u, v, -1.0); });
  part.surface(nu, 1, {}, [&](double u, double v) { return offset(u, 0.0, 2.0 * v - 1.0); });
  part.surface(nu, 1, {}, [&](double u, double v) { return offset(u, 1.0, 1.0 - 2.0 * v); });
  part.surface(1, nv, {}, [&](double u, double v) { return offset(0.0, v, 2.0 * u - 1.0); });
  part.surface(1, nv, {}, [&](double u, double v) { return offset(1.0, v, 1.0 - 2.0 * u); });
}

void leaf(MeshBuilder& part, double length, double width, double droop, int nv) {
  const GridShape shape{.pole_begin = true, .pole_end = true};
  for (double side : {1.0, -1.0})
    part.surface(2, nv, shape, [&](double u, double v) {
      const double w = width * std::sin(kPi * v) * (1.2 - 0.4 * v), edge = side * (1.0 - 2.0 * u);
      const double ridge = (1.0 - std::abs(edge)) * 0.12 * w * side;  // upper and lower side bulge apart
      return dvec3(0.5 * w * edge, 0.15 * w * std::abs(edge) + ridge - droop * v * v, length * v);
    });
}

void relief(MeshBuilder& part, double radius, int sides, int rings,
            const std::function<double(double, double)>& height) {
  part.surface(sides, rings, {.closed_u = true, .pole_begin = true}, [&](double u, double v) {
    const double a = -2.0 * kPi * u, x = v * std::cos(a), y = v * std::sin(a);
    return radius * dvec3(x, y, height(x, y));
  });
}

}  // namespace hybray::procedural
