// The GGX (Trowbridge-Reitz) microfacet distribution, isotropic, sampled by the normals that a viewer sees
// (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 2018). Directions are in a frame whose z
// axis is the surface's normal; `alpha` is the distribution's width, the square of glTF's roughness.
#pragma once

#include "core/base/vec.h"

namespace hybray {

// D(h): density of microfacet normals; integrates to 1 against cos(h). alpha > 0.
double ggx_density(const dvec3& h, double alpha);

// G1(v): share of the microfacets facing `v` that it sees (Smith). alpha > 0.
double ggx_visible_share(const dvec3& v, double alpha);

// A normal as seen from unit `v` with v.z > 0, by two numbers in [0, 1); alpha >= 0. At alpha = 0 it is the
// z axis.
dvec3 sample_visible_normal(const dvec3& v, double alpha, double a, double b);

// Its density over solid angle: D(h) G1(v) max(0, v.h) / v.z. alpha > 0.
double visible_normal_pdf(const dvec3& h, const dvec3& v, double alpha);

// A direction of the upper hemisphere with density z / pi (Malley's method), by two numbers in [0, 1).
dvec3 sample_cosine_hemisphere(double a, double b);

}  // namespace hybray
