// Optics at one interface, without tracing: directions and normals as floats, which is how rays and triangles
// hold them, against Fresnel and Snell in double for the very angle.
#include "core/base/hash.h"
#include "core/gbuffer/light_frame.h"
#include "core/optics/specular_step.h"
#include "core/truth/closed_form_optics.h"
#include "harness/experiments/stability_caustics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hybray::stability_caustics_parts {
namespace {

constexpr int kAttitudes = 1024;  // of the interface, at random

optics::SurfaceOptics surface_of(double ior) {
  Scene scene;
  scene.materials.push_back({.name = "clear",
                             .base_color = vec3(1.0f),
                             .roughness = 0.0f,
                             .transmission = 1.0f,
                             .ior = static_cast<float>(ior)});
  return optics::make_optics(scene).materials.at(0);
}

// As a ray would hold it, against what it should be.
double angle_between(const dvec3& computed, const dvec3& exact) {
  const dvec3 held(vec3{computed});
  return std::atan2(glm::length(glm::cross(held, exact)), glm::dot(held, exact));
}

}  // namespace

void add_interface(Row& row, const Point& point, uint64_t seed) {
  const double ior = point.number("ior");
  const double incidence = point.number("incidence") * std::numbers::pi / 180.0;
  const double reflectance = truth::unpolarised_reflectance(incidence, ior);
  const double refraction = truth::refraction_angle(incidence, ior);
  const optics::SurfaceOptics surface = surface_of(ior);
  double reflected_share = 0.0, transmitted_share = 0.0, reflected = 0.0, refracted = 0.0;
  int64_t bad = 0;
  for (uint64_t i = 0; i < kAttitudes; ++i) {
    const auto random = [&](uint32_t dimension) { return random_unit(i, dimension, 0, seed); };
    const double y = 2.0 * random(0) - 1.0, phi = 2.0 * std::numbers::pi * random(1);
    const double s = std::sqrt((1.0 - y) * (1.0 + y));
    const dvec3 normal(s * std::cos(phi), y, s * std::sin(phi));
    dvec3 right, down;
    basis_around(normal, right, down);
    const double turn = 2.0 * std::numbers::pi * random(2);
    const dvec3 side = std::cos(turn) * right + std::sin(turn) * down;
    const auto direction_at = [&](double angle, double sign) {
      return std::sin(angle) * side + sign * std::cos(angle) * normal;
    };
    SurfacePoint p;
    p.geometric_normal = p.shading_normal = dvec3(vec3{normal});
    const dvec3 direction(vec3{direction_at(incidence, -1.0)});
    const optics::Facing facing = optics::facing(p, direction);
    const optics::SpecularSplit split = optics::split(surface, facing.cos_incident, facing.from_inner);
    const auto worse = [](double& worst, double value) { worst = std::max(worst, value); };
    worse(reflected_share, std::abs(split.reflectance.y / reflectance - 1.0));
    worse(transmitted_share, std::abs(split.transmittance.y / (1.0 - reflectance) - 1.0));
    worse(reflected, angle_between(optics::reflection(facing, direction), direction_at(incidence, 1.0)));
    dvec3 through(0.0);
    if (optics::refraction(surface, facing, direction, split.eta_cos, through))
      worse(refracted, angle_between(through, direction_at(refraction, -1.0)));
    else
      refracted = 0.5 * std::numbers::pi;  // totally reflected, which does not happen from outside
    bad += !std::isfinite(split.reflectance.y) || split.reflectance.y < 0.0 || split.reflectance.y > 1.0;
  }
  row["reflectance_error_fraction"] = reflected_share;
  row["transmittance_error_fraction"] = transmitted_share;
  row["reflected_direction_error_radians"] = reflected;
  row["refracted_direction_error_radians"] = refracted;
  row["negative_or_nan"] = bad;
}

}  // namespace hybray::stability_caustics_parts
