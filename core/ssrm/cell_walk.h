// Walking a ray through the cells of one pyramid level, pixel borders only. Everything that decides a cell is
// one subtraction and one product of the same operands at every level, so that a coarse walk crosses exactly
// the borders that the level-0 walk crosses, bit for bit; no epsilon is added anywhere, and only the crossed
// axis advances (both, where the ray meets a corner).
#pragma once

#include "core/ssrm/screen_rays.h"

#include <algorithm>

namespace hybray::ssrm {

// One screen axis of a ray. Border b lies between pixels b - 1 and b.
template <class Real>
struct Axis {
  Real origin, inverse;  // 1 / direction
  int size;              // pixels of the screen along this axis

  Axis(Real ray_origin, Real direction, int pixels)
      : origin(ray_origin), inverse(Real(1) / direction), size(pixels) {}

  // Branches on the direction are kept on purpose: they predict well along a ray, while selecting by
  // arithmetic made the walk wait.
  bool forward() const { return inverse > Real(0); }
  Real crossing(int border) const { return (static_cast<Real>(border) - origin) * inverse; }

  // Border through which the ray leaves the level's cell that holds `pixel`; never beyond the screen's edge.
  int exit_border(int pixel, int level) const {
    return forward() ? std::min(((pixel >> level) + 1) << level, size) : (pixel >> level) << level;
  }
  int entry_border(int pixel) const { return forward() ? pixel : pixel + 1; }
  int pixel_after(int border) const { return forward() ? border : border - 1; }

  // Whether a ray that runs back along this axis is still beyond the screen's far edge at l: its origin is
  // beside the screen, away from its own pixel. (One that runs forward there never comes in.)
  bool beyond(Real l) const { return !forward() && crossing(size) > l; }

  // The ray, in the level's cell that holds `pixel` at parameter l, in terms of the level below: a pixel of
  // the half that it is in. Decided by the same comparison that a pixel-by-pixel walk makes.
  int descend(int pixel, int level, Real l) const {
    const int middle = ((pixel >> level) << level) + (1 << (level - 1));
    return crossing(middle) <= l ? std::min(pixel_after(middle), size - 1) : pixel;
  }
};

// A ray inside the screen, from parameter `l` on. On an axis whose border it has not crossed, a coarse walk
// leaves the pixel where it was: still in the same cell, which is all that this level asks. `descend` is due
// before a finer level; at level 0 the pixel is exact.
template <class Real>
struct CellWalk {
  Axis<Real> x, y;
  int px, py;
  Real l;

  CellWalk(const ScreenRay<Real>& ray, int width, int height, int start_x, int start_y)
      : x{ray.ox, ray.dx, width}, y{ray.oy, ray.dy, height}, px(start_x), py(start_y), l(0) {}

  struct Exit {
    int border_x, border_y;
    Real lx, ly;
    Real l() const { return std::min(lx, ly); }
  };
  Exit exit(int level) const {
    const int bx = x.exit_border(px, level), by = y.exit_border(py, level);
    return {bx, by, x.crossing(bx), y.crossing(by)};
  }

  // Steps through the borders of `e` that come first; false when that leaves the screen.
  bool advance(const Exit& e) {
    l = e.l();
    bool inside = true;
    if (e.lx <= l) {
      px = x.pixel_after(e.border_x);
      inside = px >= 0 && px < x.size;
    }
    if (e.ly <= l) {
      py = y.pixel_after(e.border_y);
      inside = inside && py >= 0 && py < y.size;
    }
    return inside;
  }

  bool beyond_screen() const { return x.beyond(l) || y.beyond(l); }

  // From `level` >= 1 to the one below.
  void descend(int level) {
    px = x.descend(px, level, l);
    py = y.descend(py, level, l);
  }

  // The pixel that the ray was in just before parameter l, where it entered (px, py).
  ivec2 previous() const {
    const bool through_x = x.crossing(x.entry_border(px)) >= l,
               through_y = y.crossing(y.entry_border(py)) >= l;
    return {through_x ? px + (x.forward() ? -1 : 1) : px, through_y ? py + (y.forward() ? -1 : 1) : py};
  }
};

}  // namespace hybray::ssrm
