// Cut-outs: parts of a triangle that are not there, as textures with an alpha test make them, but by a
// formula in barycentric coordinates, so that a mask needs no data and means the same at every size.
//
// A triangle carries one half of a leaf: the midrib is the edge from its second to its third vertex, and the
// half-leaf reaches from there toward the first vertex. Two triangles that share their second and third
// vertex make a whole leaf, whichever way round the other one names them. In terms of the weight h of the
// first vertex (the height over the midrib) and of s = v - u in [-1, 1] (the place along it), a triangle is
// 0 <= h <= 1 - |s|, and both shapes lie below the outline kReach (1 - s^2)^2, which lies inside of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace hybray {

enum class CutOut : uint8_t {
  none,  // the whole triangle is there
  leaf,  // an oval half-leaf with a serrated rim
  fern,  // slanted leaflets along a midrib, with gaps between them
};

namespace cut_out {

// Largest k for which k (1 - s^2)^2 <= 1 - |s| is 27/32.
constexpr double kReach = 0.84;
constexpr double kTeeth = 8.0, kToothDepth = 0.25;  // teeth in one unit of s; depth of the outline's height
constexpr double kLeaflets = 9.0, kLeafletSlant = 0.55;      // leaflets in one unit of s; tan of their slant
constexpr double kLeafletWidth = 0.8, kLeafletTaper = 0.65;  // share of the period, at the midrib; its loss
constexpr double kMidrib = 0.025;                            // height of a fern's midrib

}  // namespace cut_out

// Whether the point with the barycentric weights u and v of the second and third vertex is there. In T,
// float or double: the same but within rounding of a rim.
template <class T>
bool is_there(CutOut shape, T u, T v) {
  using namespace cut_out;
  if (shape == CutOut::none) return true;
  const T h = T(1) - u - v, s = v - u;
  const T along = T(1) - s * s, outline = T(kReach) * along * along;
  if (shape == CutOut::leaf) {
    const T tooth = T(kTeeth) * s;
    return h <= outline * (T(1) - T(kToothDepth) * (tooth - std::floor(tooth)));
  }
  if (h >= outline) return false;
  if (h <= T(kMidrib)) return true;
  const T leaflet = T(kLeaflets) * (s - T(kLeafletSlant) * h);
  return leaflet - std::floor(leaflet) <= T(kLeafletWidth) * (T(1) - T(kLeafletTaper) * h / outline);
}

const char* label(CutOut shape);
std::optional<CutOut> cut_out_named(const std::string& name);

}  // namespace hybray
