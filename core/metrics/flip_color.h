// The colour spaces of FLIP (Andersson et al. 2020, Section 4) on linear RGB with the primaries and the
// white, D65, of sRGB.
#pragma once

#include "core/base/vec.h"

#include <cmath>

#include <glm/matrix.hpp>

namespace hybray::metrics::flip_color {

// CIE XYZ of linear RGB from the chromaticities of IEC 61966-2-1, exact, and of its white.
inline const dmat3 kXyzOfRgb =
    glm::transpose(dmat3(10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0,  //
                         2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0,    //
                         1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0));
inline const dvec3 kWhite = kXyzOfRgb * dvec3(1.0);
inline const dmat3 kWhiteScale(1.0 / kWhite.x, 0.0, 0.0, 0.0, 1.0 / kWhite.y, 0.0, 0.0, 0.0, 1.0 / kWhite.z);
inline const mat3 kRelativeOfRgb = mat3(kWhiteScale * kXyzOfRgb);                // XYZ / white
inline const mat3 kRgbOfRelative = mat3(glm::inverse(kWhiteScale * kXyzOfRgb));  // and back

// Opponent space YCxCz, linear in XYZ, in which FLIP filters. The paper's Y is 116 times this one less 16, Cx
// and Cz are 500 and 200 times these: factors that a filter whose weights sum to 1 does not see.
struct Opponent {
  float y, cx, cz;
};
inline Opponent opponent_of(const vec3& rgb) {
  const vec3 relative = kRelativeOfRgb * rgb;
  return {relative.y, relative.x - relative.y, relative.y - relative.z};
}

// CIE L*a*b* with the Hunt effect: chroma counts less where it is dark. Of a filtered colour, clamped to what
// a display can show.
inline vec3 hunt_lab_of(const Opponent& o) {
  const vec3 shown = glm::clamp(kRgbOfRelative * vec3(o.y + o.cx, o.y, o.y - o.cz), 0.0f, 1.0f);
  const vec3 relative = kRelativeOfRgb * shown;
  const auto f = [](float t) {
    constexpr float kDelta = 6.0f / 29.0f;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
  };
  const float x = f(relative.x), y = f(relative.y), z = f(relative.z), lightness = 116.0f * y - 16.0f;
  const float hunt = 0.01f * lightness;
  return {lightness, hunt * 500.0f * (x - y), hunt * 200.0f * (y - z)};
}

// Distance of Abasi, Tehran and Fairchild (2020) for great differences: city block in lightness, Euclidean in
// chroma.
inline float hyab(const vec3& a, const vec3& b) {
  const vec3 d = a - b;
  return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

}  // namespace hybray::metrics::flip_color
