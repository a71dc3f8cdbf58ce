#include "core/ssrm/path_check.h"

#include "core/base/parallel.h"
#include "core/scene/primitive_hit.h"
#include "core/ssrm/cell_walk.h"
#include "core/ssrm/march_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybray::ssrm {
namespace {

// Pixels, along either axis, up to which a surface may reach from a centre that shows it without showing at
// the next one.
constexpr double kReach = 1.0;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Rounded toward the viewer.
float below(double depth) {
  const float rounded = static_cast<float>(depth);
  return rounded > depth ? std::nextafter(rounded, -std::numeric_limits<float>::infinity()) : rounded;
}

// Pixels of the 3x3 block around (x, y) inside the screen.
template <class Visit>
void for_neighbours(const DepthView& depth, int x, int y, const Visit& visit) {
  for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, depth.height() - 1); ++ny)
    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, depth.width() - 1); ++nx) visit(nx, ny);
}

// The planes next to pixel (x, y) that the ray passes between parameters `enter` and `leave`.
struct CellSearch {
  const SurfaceView& surfaces;
  const RayStream& rays;
  const ScreenRay<double>& ray;
  size_t i;
  bool with_primitives;
  uint32_t own;  // primitive that the ray starts on

  void operator()(int x, int y, double enter, double leave, PathFindings& found) const {
    const DepthView& depth = surfaces.depth;
    for_neighbours(depth, x, y, [&](int nx, int ny) {
      const PlaneGap gap = plane_gap(depth, ray, nx, ny);
      if (!(gap.at(enter) <= 0.0 && gap.at(leave) > 0.0)) return;
      const uint32_t primitive = surfaces.gbuffer.primitive(nx, ny);
      if (primitive == kNoPrimitive || primitive == own) return;
      const View& view = surfaces.gbuffer.view;
      if (with_primitives) {
        const auto t =
            primitive_hit(surfaces.scene, primitive, dvec3(rays.origin(i)), dvec3(rays.direction(i)));
        if (t) {
          if (!found.met || *t < found.met->distance)
            found.met = {*t, static_cast<uint32_t>(ny) * static_cast<uint32_t>(depth.width()) +
                                 static_cast<uint32_t>(nx)};
          return;
        }
      }

      const double l = std::clamp(gap.crossing(), enter, leave);
      const dvec2 off(ray.ox + l * ray.dx - nx - 0.5, ray.oy + l * ray.dy - ny - 0.5);
      if (std::max(std::abs(off.x), std::abs(off.y)) > kReach) return;
      if ((nx != x || ny != y) && continuous_or_behind(depth, {x, y}, {nx, ny})) return;
      const double t = distance_of(rays, i, view, l);
      if (!found.doubtful || t < *found.doubtful) found.doubtful = t;
    });
  }
};

}  // namespace

bool continuous_or_behind(const DepthView& depth, ivec2 a, ivec2 n) {
  const double za = depth.pyramid.at(0, a.x, a.y), zn = depth.pyramid.at(0, n.x, n.y);
  const dvec2 slope_a = double(depth.depth_sign) * dvec2(depth.derivatives(a.x, a.y)),
              slope_n = double(depth.depth_sign) * dvec2(depth.derivatives(n.x, n.y));
  const dvec2 step(n - a);
  // How far the neighbour's plane lies before the pixel's, at the pixel's centre and at its own.
  const double at_a = za - (zn - glm::dot(slope_n, step)), at_n = za + glm::dot(slope_a, step) - zn;
  // Each is a sum of two stored depths and a slope, of 2^-24 each.
  const double rounding = 0x1p-23 * (std::abs(za) + std::abs(zn));
  return std::min(at_a, at_n) <= 0.5 * std::abs(glm::dot(slope_a - slope_n, step)) + rounding;
}

void bound_neighbourhood(const DepthView& depth, SlantedBounds& bounds) {
  const int w = depth.width(), h = depth.height();
  parallel_blocks(static_cast<size_t>(h), 16, [&](size_t begin, size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < w; ++x) {
        const PixelPlane own = pixel_plane(depth, x, y);
        double flat = kInfinity, slanted = kInfinity;
        for_neighbours(depth, x, y, [&](int nx, int ny) {
          const PixelPlane plane = pixel_plane(depth, nx, ny);
          const double center = plane.center + plane.slope_x * (x - nx) + plane.slope_y * (y - ny);
          flat = std::min(flat, center - 0.5 * (std::abs(plane.slope_x) + std::abs(plane.slope_y)));
          slanted = std::min(slanted, center - 0.5 * (std::abs(plane.slope_x - own.slope_x) +
                                                      std::abs(plane.slope_y - own.slope_y)));
        });
        bounds.set(static_cast<size_t>(y) * static_cast<size_t>(w) + static_cast<size_t>(x), below(flat),
                   below(slanted), vec2(dvec2(own.slope_x, own.slope_y)));
      }
  });
  bounds.build();
}

PathFindings search_path(const SurfaceView& surfaces, const SlantedBounds& neighbourhood,
                         const RayStream& rays, const ScreenRays& screen_rays, size_t i, double l_end,
                         const std::optional<PathStop>& stop, bool with_primitives) {
  const int width = surfaces.depth.width();
  const auto place_of = [&](uint32_t pixel) {
    return ivec2(static_cast<int>(pixel) % width, static_cast<int>(pixel) / width);
  };
  const ivec2 from = place_of(rays.pixel[i]);
  const auto ray = screen_rays.get<float>(i);
  const auto exact = screen_rays.get<double>(i);
  const CellSearch search{
      surfaces, rays, exact, i, with_primitives, surfaces.gbuffer.primitive(from.x, from.y)};
  PathFindings found;
  CellWalk<float> walk(ray, width, surfaces.depth.height(), from.x, from.y);
  const SlantedPyramid& bounds = neighbourhood.pyramid;
  const int top = bounds.levels() - 1;
  bool in_own_pixel = true;
  for (int level = 0;;) {
    const auto exit = walk.exit(level);
    const bool ends = l_end <= exit.l();
    const double leave = ends ? l_end : exit.l();
    ++found.steps;
    const bool clear =
        !may_be_behind(bounds, level, walk.px, walk.py, ray, walk.l, static_cast<float>(leave));
    if (!clear && level > 0) {
      walk.descend(level--);
      continue;
    }
    if (!clear) search(walk.px, walk.py, walk.l, leave, found);
    if (found.met || ends || !walk.advance(exit)) return found;
    if (in_own_pixel) {
      if (!stop || stop->l >= l_end) return found;
      const ivec2 there = place_of(stop->pixel);
      walk.px = there.x, walk.py = there.y, walk.l = stop->l;
      in_own_pixel = false;
    } else if (clear) {
      level = std::min(level + 1, top);
    }
  }
}

}  // namespace hybray::ssrm
