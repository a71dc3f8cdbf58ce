#include "core/gbuffer/light_frame.h"

#include "core/base/morton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hybray {
namespace {

constexpr double kWidestFrustum =
    0.7854;  // radians from the axis; beyond it texels at the rim grow too uneven

// Signed solid angle of the corner (0, 0)..(a, b) of a plane at unit distance: the integral of
// 1 / (1 + x^2 + y^2)^(3/2).
double corner_solid_angle(double a, double b) {
  return std::atan2(a * b, std::sqrt(1.0 + a * a + b * b));
}

std::array<dvec3, 8> corners(const Bounds3& box) {
  std::array<dvec3, 8> c;
  for (int i = 0; i < 8; ++i)
    c[static_cast<size_t>(i)] = dvec3(i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                                      i & 4 ? box.upper.z : box.lower.z);
  return c;
}

// Rectangle of the image, in texels.
struct Rectangle {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  bool empty() const { return x0 > x1 || y0 > y1; }
};

// Whether all of `box` lies outside one of the four side planes of a perspective frame.
bool outside_frustum(const LightFrame& frame, const Bounds3& box) {
  int left = 0, right = 0, up = 0, down = 0;
  for (const dvec3& p : corners(box)) {
    const dvec3 d = p - frame.origin;
    const double depth = glm::dot(d, frame.forward);
    const double x = glm::dot(d, frame.right), y = glm::dot(d, frame.down);
    right += x > depth * frame.half_width, left += -x > depth * frame.half_width;
    down += y > depth * frame.half_height, up += -y > depth * frame.half_height;
  }
  return left == 8 || right == 8 || up == 8 || down == 8;
}

// Rectangle that holds the projection of `box`, cut to the image; empty if the frame cannot see it.
Rectangle covered(const LightFrame& frame, const Bounds3& box) {
  Rectangle r;
  if (!frame.orthographic && outside_frustum(frame, box)) return r;
  int behind = 0;
  const double w = frame.width, h = frame.height;
  for (const dvec3& p : corners(box)) {
    const dvec3 d = p - frame.origin;
    const double depth = glm::dot(d, frame.forward);
    if (!frame.orthographic && !(depth > 0.0)) {
      ++behind;
      continue;
    }
    const double scale = frame.orthographic ? 1.0 : 1.0 / depth;
    const double x = (glm::dot(d, frame.right) * scale / frame.half_width + 1.0) * 0.5 * w;
    const double y = (glm::dot(d, frame.down) * scale / frame.half_height + 1.0) * 0.5 * h;
    r.x0 = std::min(r.x0, x), r.x1 = std::max(r.x1, x);
    r.y0 = std::min(r.y0, y), r.y1 = std::max(r.y1, y);
  }
  if (behind == 8) return {};
  if (behind > 0) return {0.0, w, 0.0, h};  // the box reaches around the light
  // One texel of slack for rounding.
  r.x0 = std::max(0.0, r.x0 - 1.0), r.x1 = std::min(w, r.x1 + 1.0);
  r.y0 = std::max(0.0, r.y0 - 1.0), r.y1 = std::min(h, r.y1 + 1.0);
  return r;
}

bool sees_any(const LightFrame& frame, std::span<const Bounds3> targets) {
  return std::any_of(targets.begin(), targets.end(),
                     [&](const Bounds3& box) { return !covered(frame, box).empty(); });
}

LightFrame perspective(const Light& light, const dvec3& forward, double tangent, int resolution) {
  LightFrame f;
  f.origin = dvec3(light.position);
  f.forward = forward;
  basis_around(forward, f.right, f.down);
  f.half_width = f.half_height = tangent;
  f.width = f.height = resolution;
  return f;
}

LightFrame orthographic(const Light& light, std::span<const Bounds3> targets, const Bounds3& scene,
                        int resolution) {
  LightFrame f;
  f.orthographic = true;
  f.forward = glm::normalize(dvec3(light.direction));
  basis_around(f.forward, f.right, f.down);
  f.width = f.height = resolution;
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300, nearest = 1e300;
  for (const Bounds3& box : targets)
    for (const dvec3& p : corners(box)) {
      x0 = std::min(x0, glm::dot(p, f.right)), x1 = std::max(x1, glm::dot(p, f.right));
      y0 = std::min(y0, glm::dot(p, f.down)), y1 = std::max(y1, glm::dot(p, f.down));
    }
  for (const dvec3& p : corners(scene)) nearest = std::min(nearest, glm::dot(p, f.forward));
  // Room for rounding at the border, also for a target that the light sees edge-on.
  const double slack = 1e-4 * static_cast<double>(scene.diagonal()) + 1e-9;
  f.half_width = 0.5 * (x1 - x0) + slack;
  f.half_height = 0.5 * (y1 - y0) + slack;
  f.origin = 0.5 * (x0 + x1) * f.right + 0.5 * (y0 + y1) * f.down +
             (nearest - 0.01 * static_cast<double>(scene.diagonal())) * f.forward;
  return f;
}

}  // namespace

void basis_around(const dvec3& forward, dvec3& right, dvec3& down) {
  const dvec3 helper = std::abs(forward.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0);
  right = glm::normalize(glm::cross(helper, forward));
  down = glm::cross(forward, right);
}

dvec3 LightFrame::ray_origin(double x, double y) const {
  if (!orthographic) return origin;
  return origin + (2.0 * x / width - 1.0) * half_width * right +
         (2.0 * y / height - 1.0) * half_height * down;
}

dvec3 LightFrame::ray_direction(double x, double y) const {
  if (orthographic) return forward;
  return glm::normalize(forward + (2.0 * x / width - 1.0) * half_width * right +
                        (2.0 * y / height - 1.0) * half_height * down);
}

FrameRays::FrameRays(const LightFrame& f)
    : origin(f.origin),
      forward(f.forward),
      corner((f.orthographic ? f.origin : f.forward) - f.half_width * f.right - f.half_height * f.down),
      step_x(2.0 * f.half_width / f.width * f.right),
      step_y(2.0 * f.half_height / f.height * f.down),
      area(4.0 * f.half_width * f.half_height / (static_cast<double>(f.width) * f.height)),
      orthographic(f.orthographic) {}

double LightFrame::measure_density(double x, double y) const {
  const double area = 4.0 * half_width * half_height / (static_cast<double>(width) * height);
  if (orthographic) return area;
  const double a = (2.0 * x / width - 1.0) * half_width, b = (2.0 * y / height - 1.0) * half_height;
  const double r2 = 1.0 + a * a + b * b;
  return area / (r2 * std::sqrt(r2));
}

double LightFrame::texel_measure(int x, int y) const {
  if (orthographic) return measure_density(x, y);
  const double a0 = (2.0 * x / width - 1.0) * half_width, a1 = (2.0 * (x + 1) / width - 1.0) * half_width;
  const double b0 = (2.0 * y / height - 1.0) * half_height, b1 = (2.0 * (y + 1) / height - 1.0) * half_height;
  return corner_solid_angle(a1, b1) - corner_solid_angle(a0, b1) - corner_solid_angle(a1, b0) +
         corner_solid_angle(a0, b0);
}

bool LightFrame::project(const dvec3& world, dvec2& image) const {
  const dvec3 d = world - origin;
  const double depth = glm::dot(d, forward);
  if (!(depth > 0.0)) return false;
  const double scale = orthographic ? 1.0 : 1.0 / depth;
  image.x = (glm::dot(d, right) * scale / half_width + 1.0) * 0.5 * width;
  image.y = (glm::dot(d, down) * scale / half_height + 1.0) * 0.5 * height;
  return image.x >= 0.0 && image.x < width && image.y >= 0.0 && image.y < height;
}

std::vector<LightFrame> light_frames(const Light& light, std::span<const Bounds3> targets,
                                     const Bounds3& scene, int resolution) {
  std::vector<LightFrame> frames;
  if (targets.empty()) return frames;
  if (light.kind == LightKind::directional) {
    frames.push_back(orthographic(light, targets, scene, resolution));
    return frames;
  }
  const dvec3 axis = glm::normalize(dvec3(light.direction));
  if (light.kind == LightKind::spot && light.outer_cone_angle <= kWidestFrustum) {
    frames.push_back(
        perspective(light, axis, std::tan(static_cast<double>(light.outer_cone_angle)), resolution));
  } else {
    for (int face = 0; face < 6; ++face) {
      dvec3 forward(0.0);
      forward[face / 2] = face % 2 ? -1.0 : 1.0;
      // A face reaches acos(1 / sqrt 3) from its axis.
      if (light.kind == LightKind::spot && std::acos(std::clamp(glm::dot(forward, axis), -1.0, 1.0)) >
                                               static_cast<double>(light.outer_cone_angle) + 0.9554)
        continue;
      frames.push_back(perspective(light, forward, 1.0, resolution));
    }
  }
  std::erase_if(frames, [&](const LightFrame& f) { return !sees_any(f, targets); });
  return frames;
}

std::vector<uint8_t> tiles_that_may_see(const LightFrame& frame, std::span<const Bounds3> targets) {
  const int tiles_x = (frame.width + kMortonTile - 1) / kMortonTile;
  const int tiles_y = (frame.height + kMortonTile - 1) / kMortonTile;
  std::vector<uint8_t> tiles(static_cast<size_t>(tiles_x) * static_cast<size_t>(tiles_y), 0);
  for (const Bounds3& box : targets) {
    const Rectangle r = covered(frame, box);
    if (r.empty()) continue;
    const int x1 = std::min(tiles_x - 1, static_cast<int>(r.x1) / kMortonTile);
    const int y1 = std::min(tiles_y - 1, static_cast<int>(r.y1) / kMortonTile);
    for (int y = static_cast<int>(r.y0) / kMortonTile; y <= y1; ++y)
      for (int x = static_cast<int>(r.x0) / kMortonTile; x <= x1; ++x)
        tiles[static_cast<size_t>(y) * static_cast<size_t>(tiles_x) + static_cast<size_t>(x)] = 1;
  }
  return tiles;
}

}  // namespace hybray
