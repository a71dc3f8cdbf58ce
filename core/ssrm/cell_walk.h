// Walking a ray through the cells of one pyramid level, pixel borders only. Everything that decides a cell is
// one subtraction and one true division of the same operands at every level, so that a coarse walk crosses
// exactly the borders that the level-0 walk crosses, bit for bit; no epsilon is added anywhere, and only the
// crossed axis advances (both, where the ray meets a corner).
#pragma once

#include "core/ssrm/screen_rays.h"

#include <algorithm>

namespace hybray::ssrm {

// One screen axis of a ray. Border b lies between pixels b - 1 and b.
template <class Real>
struct Axis {
  Real origin, direction;
  int size;  // pixels of the screen along this axis

  // Branches on the direction are kept on purpose: they predict well along a ray, while selecting by
  // arithmetic made the walk wait for each division.
  bool forward() const { return direction > Real(0); }
  Real crossing(int border) const { return (static_cast<Real>(border) - origin) / direction; }

  // Border through which the ray leaves the level's cell that holds `pixel`; never beyond the screen's edge.
  int exit_border(int pixel, int level) const {
    return forward() ? std::min(((pixel >> level) + 1) << level, size) : (pixel >> level) << level;
  }
  int entry_border(int pixel) const { return forward() ? pixel : pixel + 1; }
  int pixel_after(int border) const { return forward() ? border : border - 1; }

  // The pixel at parameter l, given that the ray is in `from` at some earlier parameter and does not leave
  // the screen before l: every border crossed at or before l has been passed. Starts from a rounded guess and
  // settles it by the same comparisons that a pixel-by-pixel walk makes.
  int pixel_at(int from, Real l) const {
    const Real guess = origin + l * direction;
    if (forward()) {
      int i =
          static_cast<int>(std::min(std::max(static_cast<Real>(from), guess), static_cast<Real>(size - 1)));
      while (i < size - 1 && crossing(i + 1) <= l) ++i;
      while (i > from && crossing(i) > l) --i;
      return i;
    }
    int i = static_cast<int>(std::min(std::max(Real(0), guess), static_cast<Real>(from)));
    while (i > 0 && crossing(i) <= l) --i;
    while (i < from && crossing(i + 1) > l) ++i;
    return i;
  }
};

// A ray inside the screen, from parameter `l` on. On an axis whose border it has not crossed, a coarse walk
// leaves the pixel where it was: still in the same cell, which is all that this level asks. `settle` finds
// the exact pixel; it is due before a finer level, and level 0 never needs it.
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

  void settle() {
    px = x.pixel_at(px, l);
    py = y.pixel_at(py, l);
  }

  // The pixel that the ray was in just before parameter l, where it entered (px, py).
  ivec2 previous() const {
    const bool through_x = x.crossing(x.entry_border(px)) >= l,
               through_y = y.crossing(y.entry_border(py)) >= l;
    return {through_x ? px + (x.forward() ? -1 : 1) : px, through_y ? py + (y.forward() ? -1 : 1) : py};
  }
};

}  // namespace hybray::ssrm
