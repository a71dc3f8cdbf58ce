#include "core/gbuffer/conservative_depth.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/gbuffer/screen_polygon.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

namespace hybray {
namespace {

constexpr float kFarthest = std::numeric_limits<float>::infinity();

double largest(const dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

float rounded_down(double z) {
  const float f = static_cast<float>(z);
  // + 0 turns -0 into 0: which of the two came first must not show.
  return (static_cast<double>(f) <= z ? f : std::nextafter(f, -kFarthest)) + 0.0f;
}

void lower(float& place, float z) {
  std::atomic_ref<float> shared(place);
  float now = shared.load(std::memory_order_relaxed);
  while (z < now && !shared.compare_exchange_weak(now, z, std::memory_order_relaxed)) {
  }
}

// The plane of the triangle that a pixel's centre sees, turned to the eye.
struct OwnPlane {
  uint32_t primitive = kNoPrimitive;
  dvec3 point{0.0}, normal{0.0};
  double half_size = 0.0;        // half of its longest extent along an axis
  double triangle_height = 0.0;  // of the highest vertex of the triangle at hand over it
};

class Rasteriser {
 public:
  Rasteriser(const GBuffer& g, const Scene& scene, ConservativeDepth& out)
      : g_(g),
        view_(g.view),
        scene_(scene),
        out_(out),
        sign_(g.view.depth_sign()),
        a_(sign_ * view_.depth_a()),
        b_(-sign_ * view_.depth_b()),
        pad_(0x1p-20 * std::max(largest(dvec3(scene.bounds.lower)), largest(dvec3(scene.bounds.upper)))) {}

  // Returns the pixels that the triangle touches.
  uint64_t triangle(uint32_t id) {
    const uvec3& tri = scene_.triangles[id];
    const std::array<dvec3, 3> corners{dvec3(scene_.positions[tri.x]), dvec3(scene_.positions[tri.y]),
                                       dvec3(scene_.positions[tri.z])};
    corners_ = &corners;
    id_ = id;
    own_ = {};
    return polygon(corners);
  }

  // Everything that the box may hide counts as being at its nearest depth, in every pixel that it touches.
  void box(const Bounds3& box) {
    double nearest = kFarthest, x0 = kFarthest, y0 = kFarthest, x1 = -kFarthest, y1 = -kFarthest;
    for (int corner = 0; corner < 8; ++corner) {
      const dvec3 p(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                    corner & 4 ? box.upper.z : box.lower.z);
      const double w = view_.view_depth(p);
      nearest = std::min(nearest, w);
      if (w <= 0.0) continue;
      const dvec2 s = view_.project(p);
      x0 = std::min(x0, s.x), x1 = std::max(x1, s.x), y0 = std::min(y0, s.y), y1 = std::max(y1, s.y);
    }
    if (x0 > x1) return;  // behind the eye
    const double rim = this->rim(nearest);
    if (nearest <= view_.near())
      x0 = y0 = 0.0, x1 = view_.width(), y1 = view_.height(), nearest = view_.near();
    const double z = padded(a_ - b_ / nearest);
    for (int y = first(y0, rim); y <= last(y1, rim, view_.height()); ++y)
      for (int x = first(x0, rim); x <= last(x1, rim, view_.width()); ++x) {
        const auto [gx, gy] = slopes(x, y);
        put(x, y, z, z - (0.5 + rim) * (std::abs(gx) + std::abs(gy)), rim);
        std::atomic_ref<uint8_t>(out_.origin_clear(x, y)).store(0, std::memory_order_relaxed);
      }
  }

 private:
  double rim(double nearest_w) const {
    return pixel_rim(view_.width(), view_.height()) +
           view_.focal() * pad_ / std::max(nearest_w, view_.near());
  }
  static int first(double low, double rim) {
    return static_cast<int>(std::max(0.0, std::ceil(low - 1.0 - rim)));
  }
  static int last(double high, double rim, int size) {
    return static_cast<int>(std::min(size - 1.0, std::floor(high + rim)));
  }
  std::pair<double, double> slopes(int x, int y) const {
    const vec2 d = g_.depth_derivatives(x, y);
    const double gx = sign_ * static_cast<double>(d.x), gy = sign_ * static_cast<double>(d.y);
    return std::isfinite(gx) && std::isfinite(gy) ? std::pair(gx, gy) : std::pair(0.0, 0.0);
  }
  // Depth of a point that lies nearer by the padding.
  double padded(double z) const {
    const double w = b_ / (a_ - z);
    return a_ - b_ / std::max(w - pad_, 0.5 * w);
  }

  uint64_t polygon(const std::array<dvec3, 3>& corners) {
    std::array<dvec3, 3> seen;  // across, down, view depth
    double nearest = kFarthest;
    for (size_t i = 0; i < 3; ++i) {
      const dvec3 d = corners[i] - view_.eye();
      seen[i] = {glm::dot(d, view_.right()), glm::dot(d, view_.down()), glm::dot(d, view_.forward())};
      nearest = std::min(nearest, seen[i].z);
    }
    ScreenPolygon screen;
    const auto add = [&](const dvec3& p) {
      const double scale = view_.focal() / p.z;
      screen.add({view_.center().x + scale * p.x, view_.center().y + scale * p.y, a_ - b_ / p.z});
    };
    for (size_t i = 0; i < 3; ++i) {
      const dvec3 &a = seen[i], &b = seen[(i + 1) % 3];
      const double da = a.z - view_.near(), db = b.z - view_.near();
      if (da >= 0.0) add(a);
      if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
        dvec3 on = a + (da / (da - db)) * (b - a);
        on.z = view_.near();
        add(on);
      }
    }
    if (screen.count == 0) return 0;
    const double rim = this->rim(nearest);
    double y0 = kFarthest, y1 = -kFarthest, x0 = kFarthest, x1 = -kFarthest;
    for (size_t i = 0; i < screen.count; ++i) {
      y0 = std::min(y0, screen.corners[i].y), y1 = std::max(y1, screen.corners[i].y);
      x0 = std::min(x0, screen.corners[i].x), x1 = std::max(x1, screen.corners[i].x);
    }
    if (x1 < -rim || x0 > view_.width() + rim) return 0;
    plane_ = plane(screen);
    uint64_t touched = 0;
    const int first_row = first(y0, rim), last_row = last(y1, rim, view_.height());
    for (int y = first_row; y <= last_row; ++y) touched += row(screen, y, rim);
    return touched;
  }

  uint64_t row(const ScreenPolygon& screen, int y, double rim) {
    const double top = y - rim, bottom = y + 1.0 + rim;
    ScreenPolygon below_top, slab;
    cut<&ScreenPolygon::Corner::y>(screen, top, 1.0, below_top);
    cut<&ScreenPolygon::Corner::y>(below_top, bottom, -1.0, slab);
    if (slab.count == 0) return 0;
    double low = kFarthest, high = -kFarthest;
    std::array<double, 2> left{kFarthest, kFarthest}, right{-kFarthest, -kFarthest};  // on the slab's lines
    for (size_t i = 0; i < slab.count; ++i) {
      const auto& c = slab.corners[i];
      low = std::min(low, c.x), high = std::max(high, c.x);
      for (const auto& [line, k] : {std::pair(top, 0u), std::pair(bottom, 1u)})
        if (c.y == line) left[k] = std::min(left[k], c.x), right[k] = std::max(right[k], c.x);
    }
    const double inner_left = std::max(left[0], left[1]), inner_right = std::min(right[0], right[1]);
    const int x0 = first(low, rim), x1 = last(high, rim, view_.width());
    for (int x = x0; x <= x1; ++x) {
      const double west = x - rim, east = x + 1.0 + rim;
      if (west <= low && high <= east) {
        pixel(slab, x, y, rim);
        continue;
      }
      ScreenPolygon part, whole;
      if (inner_left <= west && east <= inner_right) {
        // The pixel lies inside: its corners, with the depth of the plane, which is well defined there.
        const auto& [gx, gy, z0] = plane_;
        for (const auto& [cx, cy] : {std::pair(west, top), {east, top}, {east, bottom}, {west, bottom}})
          whole.add({cx, cy, z0 + gx * (cx - screen.corners[0].x) + gy * (cy - screen.corners[0].y)});
      } else {
        cut<&ScreenPolygon::Corner::x>(slab, west, 1.0, part);
        cut<&ScreenPolygon::Corner::x>(part, east, -1.0, whole);
      }
      if (whole.count > 0) pixel(whole, x, y, rim);
    }
    return static_cast<uint64_t>(std::max(0, x1 - x0 + 1));
  }

  // Slopes of depth across the polygon and the depth of its first corner.
  static std::array<double, 3> plane(const ScreenPolygon& p) {
    double best = 0.0;
    std::array<double, 3> result{0.0, 0.0, p.corners[0].z};
    for (size_t i = 1; i + 1 < p.count; ++i) {
      const double ux = p.corners[i].x - p.corners[0].x, uy = p.corners[i].y - p.corners[0].y,
                   uz = p.corners[i].z - p.corners[0].z;
      const double vx = p.corners[i + 1].x - p.corners[0].x, vy = p.corners[i + 1].y - p.corners[0].y,
                   vz = p.corners[i + 1].z - p.corners[0].z;
      const double area = ux * vy - uy * vx;
      if (std::abs(area) <= best) continue;
      best = std::abs(area);
      result[0] = (uz * vy - uy * vz) / area, result[1] = (ux * vz - uz * vx) / area;
    }
    return result;
  }

  void pixel(const ScreenPolygon& part, int x, int y, double rim) {
    const auto [gx, gy] = slopes(x, y);
    double nearest = kFarthest, intercept = kFarthest;
    for (size_t i = 0; i < part.count; ++i) {
      const auto& c = part.corners[i];
      nearest = std::min(nearest, c.z);
      intercept = std::min(intercept, c.z - gx * (c.x - (x + 0.5)) - gy * (c.y - (y + 0.5)));
    }
    const double z = padded(nearest);
    put(x, y, z, intercept - (nearest - z), rim);
    if (!origin_stays_clear(part, x, y))
      std::atomic_ref<uint8_t>(out_.origin_clear(x, y)).store(0, std::memory_order_relaxed);
  }

  void put(int x, int y, double nearest, double intercept, double rim) {
    const auto [gx, gy] = slopes(x, y);
    lower(out_.nearest(x, y), rounded_down(nearest - kDepthMargin));
    lower(out_.intercept(x, y),
          rounded_down(intercept - kDepthMargin - 2.0 * rim * (std::abs(gx) + std::abs(gy))));
  }

  bool origin_stays_clear(const ScreenPolygon& part, int x, int y) {
    const uint32_t primitive = g_.primitive(x, y);
    if (primitive == kNoPrimitive || primitive == id_) return true;
    if (!scene_.is_triangle(primitive)) return false;
    if (primitive != own_.primitive) set_own(primitive);
    if (own_.triangle_height <= 0.0) return true;
    const double w = view_.view_depth_of(g_.depth(x, y));
    const dvec3 p = view_.eye() + w * view_.ray_direction(x + 0.5, y + 0.5);
    const double most = 0x1p-20 * std::max(largest(p), own_.half_size);
    if (own_.triangle_height <= most) return true;
    for (size_t i = 0; i < part.count; ++i) {
      const auto& c = part.corners[i];
      const dvec3 q = view_.eye() + (b_ / (a_ - c.z)) * view_.ray_direction(c.x, c.y);
      if (glm::dot(own_.normal, q - own_.point) > most) return false;
    }
    return true;
  }

  void set_own(uint32_t primitive) {
    const uvec3& tri = scene_.triangles[primitive];
    const dvec3 a(scene_.positions[tri.x]), b(scene_.positions[tri.y]), c(scene_.positions[tri.z]);
    own_.primitive = primitive;
    own_.point = a;
    own_.normal = geometric_normal(scene_, primitive);
    if (glm::dot(own_.normal, view_.eye() - a) < 0.0) own_.normal = -own_.normal;
    own_.half_size = 0.5 * std::max({largest(b - a), largest(c - b), largest(a - c)});
    own_.triangle_height = -kFarthest;
    for (const dvec3& corner : *corners_)
      own_.triangle_height = std::max(own_.triangle_height, glm::dot(own_.normal, corner - a));
  }

  const GBuffer& g_;
  const View& view_;
  const Scene& scene_;
  ConservativeDepth& out_;
  double sign_;
  double a_, b_;  // march depth is a - b / w, b > 0
  double pad_;    // metres by which the general tracer may misplace a surface, and some in reserve
  const std::array<dvec3, 3>* corners_ = nullptr;
  uint32_t id_ = kNoPrimitive;
  OwnPlane own_;
  std::array<double, 3> plane_{};
};

}  // namespace

void make_conservative_depth(const GBuffer& g, const Scene& scene, ConservativeDepth& result) {
  HYBRAY_CHECK(!g.primitive.empty() && !g.depth_derivatives.empty());
  const int w = g.view.width(), h = g.view.height();
  const auto clear = [&](auto& image, auto value) {
    if (image.width() != w || image.height() != h)
      image = {w, h, value};
    else
      std::fill(image.begin(), image.end(), value);
  };
  clear(result.nearest, kFarthest), clear(result.intercept, kFarthest);
  clear(result.origin_clear, uint8_t{1});
  std::atomic<uint64_t> touched{0};
  parallel_blocks(scene.triangles.size(), 1024, [&](size_t begin, size_t end) {
    Rasteriser rasteriser(g, scene, result);
    uint64_t mine = 0;
    for (size_t i = begin; i < end; ++i) mine += rasteriser.triangle(static_cast<uint32_t>(i));
    touched += mine;
  });
  for (const AnalyticSurface& surface : scene.analytic) Rasteriser(g, scene, result).box(bounds(surface));
  parallel_blocks(scene.curves.size(), 256, [&](size_t begin, size_t end) {
    Rasteriser rasteriser(g, scene, result);
    for (size_t i = begin; i < end; ++i)
      for (const Bounds3& piece : piece_bounds(scene.curves[i])) rasteriser.box(piece);
  });
  result.pixels_touched = touched;
  // From march depth to the buffer's convention.
  const float sign = static_cast<float>(g.view.depth_sign()), background = g.view.background_depth();
  parallel_blocks(result.nearest.size(), 65536, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      float& z = result.nearest[i];
      if (z == kFarthest) {
        z = background;
        continue;
      }
      if (sign * z == background) z = std::nextafter(z, -kFarthest);
      z = sign * z;
    }
  });
}

}  // namespace hybray
