#include "core/scene/distance_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hybray {
namespace {

using Shape = DistanceField::Shape;

struct Sample {
  double f;
  dvec3 slope;  // of f
};

// Balls of a blob, in units of its radius.
struct Ball {
  dvec3 center;
  double radius;
};
constexpr double kLarge = 0.46, kSmall = 0.24;
const std::array<Ball, 7> kBalls{{{{0.00, -0.50, 0.00}, kLarge},
                                  {{0.05, 0.12, -0.04}, 0.34},
                                  {{-0.04, 0.66, 0.06}, kSmall},
                                  {{0.52, 0.10, 0.20}, kSmall},
                                  {{-0.50, 0.22, -0.16}, 0.22},
                                  {{0.16, -0.20, 0.62}, kSmall},
                                  {{-0.14, -0.30, -0.64}, 0.26}}};

Sample torus(const DistanceField& field, const dvec3& p) {
  const double height = glm::dot(p, field.axis);
  const dvec3 flat = p - height * field.axis;
  const double rho = glm::length(flat);
  const dvec3 out = rho > 0.0 ? flat / rho : dvec3(0.0), from_circle = p - field.radius * out;
  const double distance = glm::length(from_circle);
  return {distance - field.thickness, from_circle / distance};
}

Sample gyroid(const DistanceField& field, const dvec3& p) {
  const double k = 2.0 * std::numbers::pi / field.period, scale = 1.0 / (std::numbers::sqrt3 * k);
  const double from_center = glm::length(p);
  const double sx = std::sin(k * p.x), cx = std::cos(k * p.x), sy = std::sin(k * p.y), cy = std::cos(k * p.y),
               sz = std::sin(k * p.z), cz = std::cos(k * p.z);
  const double g = sx * cy + sy * cz + sz * cx;
  const double sheet = scale * (std::abs(g) - field.thickness);
  if (from_center - field.radius >= sheet) return {from_center - field.radius, p / from_center};
  const dvec3 slope(cx * cy - sz * sx, cy * cz - sx * sy, cz * cx - sy * sz);
  return {sheet, std::copysign(1.0, g) * scale * k * slope};
}

Sample blob(const DistanceField& field, const dvec3& p) {
  Sample all{};
  for (size_t i = 0; i < kBalls.size(); ++i) {
    const dvec3 away = p - field.radius * kBalls[i].center;
    const double distance = glm::length(away);
    const Sample one{distance - field.radius * kBalls[i].radius, away / distance};
    if (i == 0) {
      all = one;
      continue;
    }
    const double width = field.thickness, h = std::max(width - std::abs(all.f - one.f), 0.0) / width;
    const double share = 0.5 * h;  // of the slope of the greater in the mix
    const bool nearer = one.f < all.f;
    all = {std::min(all.f, one.f) - 0.25 * h * h * width, nearer
                                                              ? one.slope + share * (all.slope - one.slope)
                                                              : all.slope + share * (one.slope - all.slope)};
  }
  return all;
}

Sample sample(const DistanceField& field, const dvec3& p) {
  switch (field.shape) {
    case Shape::torus:
      return torus(field, p);
    case Shape::gyroid:
      return gyroid(field, p);
    case Shape::blob:
      return blob(field, p);
  }
  return {};
}

}  // namespace

const char* label(DistanceField::Shape shape) {
  switch (shape) {
    case Shape::torus:
      return "torus";
    case Shape::gyroid:
      return "gyroid";
    case Shape::blob:
      return "blob";
  }
  return "unknown";
}

double value(const DistanceField& field, const dvec3& p) {
  return sample(field, p).f;
}

dvec3 gradient(const DistanceField& field, const dvec3& p) {
  return glm::normalize(sample(field, p).slope);
}

double reach(const DistanceField& field) {
  switch (field.shape) {
    case Shape::torus:
      return field.radius + field.thickness;
    case Shape::gyroid:
      return field.radius;
    case Shape::blob: {
      // Each of the minima lies at most a quarter of the width below both.
      double most = 0.0;
      for (const Ball& ball : kBalls)
        most = std::max(most, field.radius * (glm::length(ball.center) + ball.radius));
      return most + 0.25 * static_cast<double>(kBalls.size() - 1) * field.thickness;
    }
  }
  return 0.0;
}

std::optional<double> nearest_hit(const DistanceField& field, const dvec3& o, const dvec3& d, double t_near,
                                  double t_far) {
  // Only what lies in the ball that holds the body is walked.
  const double length = glm::length(d), radius = reach(field) * (1.0 + 1e-9);
  const dvec3 unit = d / length;
  const double middle = -glm::dot(o, unit);
  const double aside = glm::length(o + middle * unit);
  if (!(aside < radius)) return std::nullopt;
  const double half = std::sqrt((radius - aside) * (radius + aside));
  const double end = std::min(middle + half, t_far * length), shortest = kFieldAccuracy * radius;
  double t = std::max(middle - half, t_near * length);
  if (t > end) return std::nullopt;

  const bool inside = value(field, o + t * unit) < 0.0;
  const auto beyond = [&](double f) { return (f < 0.0) != inside; };
  double f = value(field, o + t * unit);
  while (t < end) {
    const double next = std::min(end, t + std::max(std::abs(f), shortest));
    f = value(field, o + next * unit);
    if (beyond(f)) {  // within `shortest`, but for the rounding of f
      double low = t, high = next;
      for (int i = 0; i < 30 && high - low > 1e-16 * high; ++i) {
        const double half_way = 0.5 * (low + high);
        (beyond(value(field, o + half_way * unit)) ? high : low) = half_way;
      }
      return high / length;
    }
    t = next;
  }
  return std::nullopt;
}

dvec3 moved_onto(const DistanceField& field, const dvec3& p) {
  dvec3 on = p;
  for (int i = 0; i < 20; ++i) {  // Newton's method along the slope
    const Sample s = sample(field, on);
    const dvec3 step = s.slope * (s.f / glm::dot(s.slope, s.slope));
    on -= step;
    if (glm::dot(step, step) <= 1e-30 * glm::dot(on, on)) break;
  }
  return on;
}

dvec3 beside(const DistanceField& field, const dvec3& o, const dvec3& d) {
  const double length = glm::length(d), radius = reach(field);
  const dvec3 unit = d / length;
  const double middle = -glm::dot(o, unit);
  double nearest = middle, least = std::abs(value(field, o + middle * unit));
  for (double t = middle - radius; t < middle + radius;) {
    const double f = std::abs(value(field, o + t * unit));
    if (f < least) least = f, nearest = t;
    t += std::max(f, 1e-3 * radius);
  }
  return moved_onto(field, o + nearest * unit);
}

}  // namespace hybray
