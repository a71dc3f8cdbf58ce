// Fresnel and Snell for the closed forms alone, in terms of angles, where core/optics works with cosines: the
// two must not share an error. Fresnel's equations as he wrote them, R_s = (sin(i - t) / sin(i + t))^2 and
// R_p = (tan(i - t) / tan(i + t))^2 (Born and Wolf, Principles of Optics, 1.5.2, equations 21).
#pragma once

namespace hybray::truth {

// Angle of refraction, radians; `n` = index beyond / index before. Pi / 2 and more means total reflection:
// NaN.
double refraction_angle(double incidence, double n);

// Reflectance for unpolarised light; 1 at total reflection. The same from both sides of the interface.
double unpolarised_reflectance(double incidence, double n);

}  // namespace hybray::truth
