#include "core/scene/round_curve.h"

#include "core/base/error.h"
#include "core/base/float_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace hybray {
namespace {

using Controls = std::array<dvec4, 4>;

Controls controls_of(const RoundCurve& curve) {
  Controls p;
  for (size_t i = 0; i < 4; ++i) p[i] = dvec4(curve.control[i]);
  return p;
}

// The curve and its first two derivatives, radius included.
struct Jet {
  dvec4 value, first, second;
  dvec3 point() const { return dvec3(value); }
  dvec3 tangent() const { return dvec3(first); }
};

Jet jet(const Controls& p, double u) {
  const double v = 1.0 - u;
  const dvec4 a = v * p[0] + u * p[1], b = v * p[1] + u * p[2], c = v * p[2] + u * p[3];
  const dvec4 d = v * a + u * b, e = v * b + u * c;
  return {v * d + u * e, 3.0 * (e - d), 6.0 * (c - 2.0 * b + a)};
}

// De Casteljau's halves.
std::array<Controls, 2> halves(const Controls& p) {
  const dvec4 a = 0.5 * (p[0] + p[1]), b = 0.5 * (p[1] + p[2]), c = 0.5 * (p[2] + p[3]);
  const dvec4 d = 0.5 * (a + b), e = 0.5 * (b + c), f = 0.5 * (d + e);
  return {{{p[0], a, d, f}, {f, e, c, p[3]}}};
}

// Balls about the control points hold the swept circle: it lies in the balls about the curve's own points,
// which are convex combinations of them.
Bounds3 hull(const Controls& p) {
  dvec3 lower(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const dvec4& c : p) {
    lower = glm::min(lower, dvec3(c) - c.w);
    upper = glm::max(upper, dvec3(c) + c.w);
  }
  return enclosing_box(lower, upper);
}

dvec3 any_across(const dvec3& d) {
  const dvec3 helper = std::abs(d.x) < 0.6 * glm::length(d) ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  return glm::normalize(glm::cross(d, helper));
}

// The u in [0, 1] whose point is next to x: the best of 16 intervals, then Newton's method, held inside.
double next_to(const Controls& p, const dvec3& x) {
  constexpr int kSamples = 16;
  const auto squared = [&](double u) {
    const dvec3 away = x - jet(p, u).point();
    return glm::dot(away, away);
  };
  int best = 0;
  double least = squared(0.0);
  for (int i = 1; i <= kSamples; ++i)
    if (const double s = squared(static_cast<double>(i) / kSamples); s < least) least = s, best = i;
  double low = std::max(0, best - 1) / double{kSamples},
         high = std::min(kSamples, best + 1) / double{kSamples};
  double u = best / double{kSamples};
  for (int i = 0; i < 60; ++i) {
    const Jet c = jet(p, u);
    const dvec3 away = x - c.point();
    const double f = glm::dot(away, c.tangent());  // > 0: the nearest point lies further on
    (f > 0.0 ? low : high) = u;
    const double slope = glm::dot(away, dvec3(c.second)) - glm::dot(c.tangent(), c.tangent());
    double next = slope < 0.0 ? u - f / slope : 0.5 * (low + high);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - u) <= 1e-15) return next;
    u = next;
  }
  return u;
}

// A line in its own frame: across it in x and y, along it in z, z = 0 at its origin.
struct Frame {
  dvec3 origin, x, y, z;
  dvec4 operator()(const dvec4& p) const {
    const dvec3 v = dvec3(p) - origin;
    return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z), p.w};
  }
};

// Where the z axis meets the surface, nearest first.
class Search {
 public:
  Search(const Controls& whole, double near, double far) : whole_(whole), near_(near), best_(far) {}

  std::optional<double> nearest() {
    visit(whole_, 0.0, 1.0, 0);
    return found_ ? std::optional(best_) : std::nullopt;
  }

 private:
  static constexpr int kDepth = 4;  // 16 pieces: nearly straight cones

  void visit(const Controls& part, double u0, double u1, int depth) {
    dvec3 lower(std::numeric_limits<double>::infinity()), upper = -lower;
    for (const dvec4& c : part) {
      lower = glm::min(lower, dvec3(c) - c.w);
      upper = glm::max(upper, dvec3(c) + c.w);
    }
    if (lower.x > 0.0 || upper.x < 0.0 || lower.y > 0.0 || upper.y < 0.0) return;
    if (upper.z < near_ || lower.z > best_) return;
    const double middle = 0.5 * (u0 + u1);
    if (depth == kDepth) {
      start(part, u0, u1);
      return;
    }
    const auto [a, b] = halves(part);
    visit(a, u0, middle, depth + 1);
    visit(b, middle, u1, depth + 1);
  }

  // A short piece, nearly a straight cone.
  void start(const Controls& part, double u0, double u1) {
    const dvec3 a(part[0]), chord = dvec3(part[3]) - a;
    const double length = glm::length(chord);
    if (std::abs(chord.z) >= 0.5 * length)
      along(u0, u1);
    else
      across(part, chord / length, length, u0, u1);
  }

  // Of an axis that runs more or less along the piece: each u has one point of the axis in its plane, and the
  // square of that point's distance from the curve, less r^2, is nearly a parabola in u.
  void along(double u0, double u1) {
    constexpr int kSamples = 4;
    std::array<double, kSamples + 1> u, h;
    for (int i = 0; i <= kSamples; ++i) {
      u[i] = u0 + (u1 - u0) * i / kSamples;
      h[i] = in_plane(u[i]).h;
    }
    for (int i = 0; i < kSamples; ++i) bracket(u[i], h[i], u[i + 1], h[i + 1]);
    for (int i = 1; i < kSamples; ++i) {  // a dip or bump between samples of one sign
      const double bend = h[i - 1] - 2.0 * h[i] + h[i + 1];
      const double top = bend != 0.0 ? 0.5 * (h[i - 1] - h[i + 1]) / bend : 2.0;
      if (!(std::abs(top) <= 1.0)) continue;
      const double at = u[i] + top * (u[i + 1] - u[i]), value = in_plane(at).h;
      if ((value < 0.0) == (h[i] < 0.0)) continue;
      const int other = top < 0.0 ? i - 1 : i + 1;
      if ((value < 0.0) == (h[other] < 0.0)) continue;  // bracketed already
      bracket(std::min(u[i], u[other]), top < 0.0 ? h[other] : h[i], at, value);
      bracket(at, value, std::max(u[i], u[other]), top < 0.0 ? h[i] : h[other]);
    }
  }

  struct InPlane {
    double z, h;
  };
  InPlane in_plane(double u) const {
    const Jet p = jet(whole_, u);
    const double z = glm::dot(p.point(), p.tangent()) / p.first.z;
    const dvec3 away = dvec3(0, 0, z) - p.point();
    return {z, glm::dot(away, away) - p.value.w * p.value.w};
  }

  void bracket(double low, double h_low, double high, double h_high) {
    if ((h_low < 0.0) == (h_high < 0.0)) return;
    for (int i = 0; i < 52; ++i) {
      const double middle = 0.5 * (low + high);
      ((in_plane(middle).h < 0.0) == (h_low < 0.0) ? low : high) = middle;
    }
    keep(in_plane(0.5 * (low + high)).z);
  }

  // Of an axis across the piece: Newton's method from where it meets the cylinder about the piece's chord,
  // or passes that nearest, for it may still graze the surface.
  void across(const Controls& part, const dvec3& d, double length, double u0, double u1) {
    const dvec3 a(part[0]);
    const double radius = 0.5 * (part[0].w + part[3].w), square = 1.0 - d.z * d.z, shift = glm::dot(a, d);
    const double b = shift * d.z - a.z, c = glm::dot(a, a) - shift * shift - radius * radius;
    const double half = std::sqrt(std::max(b * b - square * c, 0.01 * square * radius * radius));
    for (const double z : {(-b - half) / square, (-b + half) / square})
      newton(u0 + (u1 - u0) * std::clamp((z * d.z - shift) / length, 0.0, 1.0), z);
  }

  void newton(double u, double z) {
    for (int i = 0; i < 24; ++i) {
      const Jet p = jet(whole_, u);
      const dvec3 away = dvec3(0, 0, z) - p.point(), t = p.tangent();
      const double r = p.value.w, speed = glm::dot(t, t);
      const double f = glm::dot(away, t), g = 0.5 * (glm::dot(away, away) - r * r);
      const double fu = glm::dot(away, dvec3(p.second)) - speed, fz = t.z;
      const double gu = -f - r * p.first.w, gz = away.z;
      const double determinant = fu * gz - fz * gu;
      const double du = (fz * g - gz * f) / determinant, dz = (gu * f - fu * g) / determinant;
      if (!std::isfinite(du) || !std::isfinite(dz)) return;
      u += std::clamp(du, -0.2, 0.2), z += dz;
      if (u < -0.5 || u > 1.5) return;
      const double scale = std::abs(z) + std::sqrt(speed);
      if (std::abs(du) > 1e-12 || std::abs(dz) > 1e-13 * scale) continue;
      if (u >= 0.0 && u <= 1.0) keep(z);
      return;
    }
  }

  void keep(double z) {
    if (z >= near_ && z <= best_) best_ = z, found_ = true;
  }

  const Controls& whole_;
  double near_, best_;
  bool found_ = false;
};

dvec3 slope_normal(const Controls& p, const dvec3& x) {
  const Jet c = jet(p, next_to(p, x));
  dvec3 away = x - c.point();
  away -= c.tangent() * (glm::dot(away, c.tangent()) / glm::dot(c.tangent(), c.tangent()));
  const double distance = glm::length(away);
  if (!(distance > 0.0)) return any_across(c.tangent());
  // Gradient of |X - C(u(X))| - r(u(X)), from the derivative of (X - C) . C' = 0.
  return glm::normalize(away / distance - c.tangent() * (c.first.w / (glm::dot(c.tangent(), c.tangent()) -
                                                                      glm::dot(away, dvec3(c.second)))));
}

dvec3 onto(const Controls& p, const dvec3& x) {
  const Jet c = jet(p, next_to(p, x));
  dvec3 away = x - c.point();
  away -= c.tangent() * (glm::dot(away, c.tangent()) / glm::dot(c.tangent(), c.tangent()));
  const double distance = glm::length(away);
  return c.point() + c.value.w * (distance > 0.0 ? away / distance : any_across(c.tangent()));
}

}  // namespace

void check_curve(const RoundCurve& curve, size_t number) {
  const auto require = [&](bool condition, const char* fault) {
    if (!condition) throw InputError(fmt::format("curve {}", number), fault);
  };
  double thickest = 0.0;
  for (const vec4& c : curve.control) {
    require(std::isfinite(c.x + c.y + c.z + c.w), "a control point or radius is not finite");
    require(c.w >= 0.0f, "a radius is negative");
    thickest = std::max(thickest, static_cast<double>(c.w));
  }
  require(thickest > 0.0, "all of its radii are zero");
  const Controls p = controls_of(curve);
  constexpr int kSamples = 32;
  for (int i = 0; i <= kSamples; ++i) {
    const Jet c = jet(p, static_cast<double>(i) / kSamples);
    const double speed = glm::length(c.tangent());
    require(speed > 1e-6 * thickest, "it stands still: two of its control points coincide, or it turns back");
    require(glm::length(glm::cross(c.tangent(), dvec3(c.second))) * c.value.w < speed * speed * speed,
            "it bends more sharply than its radius");
  }
}

Bounds3 bounds(const RoundCurve& curve) {
  return hull(controls_of(curve));
}

std::array<Bounds3, kCurvePieces> piece_bounds(const RoundCurve& curve) {
  static_assert(kCurvePieces == 8);
  std::array<Bounds3, kCurvePieces> boxes;
  size_t next = 0;
  for (const Controls& half : halves(controls_of(curve)))
    for (const Controls& quarter : halves(half))
      for (const Controls& eighth : halves(quarter)) boxes[next++] = hull(eighth);
  return boxes;
}

double extent(const RoundCurve& curve) {
  const Bounds3 box = bounds(curve);
  const dvec3 size = dvec3(box.upper) - dvec3(box.lower);
  return std::max({size.x, size.y, size.z});
}

std::optional<double> nearest_hit(const RoundCurve& curve, const dvec3& o, const dvec3& d, double t_near,
                                  double t_far) {
  const double length = glm::length(d);
  Controls p = controls_of(curve);
  const dvec3 z = d / length, x = any_across(z);
  const Frame frame{o, x, glm::cross(z, x), z};
  for (dvec4& c : p) c = frame(c);
  const std::optional<double> along = Search(p, t_near * length, t_far * length).nearest();
  return along ? std::optional(*along / length) : std::nullopt;
}

dvec3 outward_normal(const RoundCurve& curve, const dvec3& point) {
  return slope_normal(controls_of(curve), point);
}

dvec3 moved_onto(const RoundCurve& curve, const dvec3& point) {
  return onto(controls_of(curve), point);
}

dvec3 beside(const RoundCurve& curve, const dvec3& o, const dvec3& d) {
  const Controls p = controls_of(curve);
  Controls across = p;  // as seen along the line
  const dvec3 z = glm::normalize(d), x = any_across(z);
  const Frame frame{o, x, glm::cross(z, x), z};
  for (dvec4& c : across) c = frame(c), c.z = 0.0;
  const dvec3 nearest = jet(p, next_to(across, dvec3(0.0))).point();
  return onto(p, o + z * glm::dot(nearest - o, z));
}

}  // namespace hybray
