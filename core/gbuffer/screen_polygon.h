// Convex polygons on the screen, with march depth at their corners, cut by axis-parallel lines (Sutherland
// and Hodgman 1974). In double.
#pragma once

#include <array>
#include <cstddef>

namespace hybray {

struct ScreenPolygon {
  struct Corner {
    double x, y, z;
  };
  std::array<Corner, 10> corners;  // a triangle, cut by the near plane and the four sides of a pixel, has 8
  size_t count = 0;

  void add(const Corner& c) { corners[count++] = c; }
};

// The part of `in` where axis >= line (sign +1) or <= line (sign -1). Corners made by the cut lie on the line
// exactly; a corner on the line belongs to both sides.
template <double ScreenPolygon::Corner::*kAxis>
void cut(const ScreenPolygon& in, double line, double sign, ScreenPolygon& out) {
  out.count = 0;
  for (size_t i = 0; i < in.count; ++i) {
    const ScreenPolygon::Corner &a = in.corners[i], &b = in.corners[i + 1 == in.count ? 0 : i + 1];
    const double da = sign * (a.*kAxis - line), db = sign * (b.*kAxis - line);
    if (da >= 0.0) out.add(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
      const double s = da / (da - db);
      ScreenPolygon::Corner c{a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), a.z + s * (b.z - a.z)};
      c.*kAxis = line;
      out.add(c);
    }
  }
}

}  // namespace hybray
