#include "core/optics/surface_optics.h"

#include "core/base/error.h"
#include "core/optics/fresnel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace hybray::optics {
namespace {

void require(bool condition, const Material& m, const char* property, double value, const char* range) {
  if (!condition)
    throw InputError(fmt::format("material '{}'", m.name),
                     fmt::format("{} is {}; it must be {}", property, value, range));
}

void check(const Material& m) {
  const auto unit = [&](const char* name, float v) {
    require(v >= 0.0f && v <= 1.0f, m, name, v, "between 0 and 1");
  };
  const auto non_negative = [&](const char* name, const vec3& v) {
    for (int c = 0; c < 3; ++c)
      require(v[c] >= 0.0f && std::isfinite(v[c]), m, name, v[c], "finite and not negative");
  };
  for (int c = 0; c < 3; ++c) unit("base_color", m.base_color[c]);
  unit("metallic", m.metallic);
  unit("roughness", m.roughness);
  unit("transmission", m.transmission);
  for (const auto& [name, value] : {std::pair("ior", m.ior), std::pair("outer_ior", m.outer_ior)})
    require(value >= 1.0f && std::isfinite(value), m, name, value, "at least 1");
  non_negative("absorption", m.absorption);
  non_negative("outer_absorption", m.outer_absorption);
  non_negative("conductor_eta", m.conductor_eta);
  non_negative("conductor_k", m.conductor_k);
}

uint16_t medium(OpticsTable& table, float ior, const vec3& absorption) {
  const Medium wanted{ior, dvec3(absorption)};
  const auto found = std::find(table.media.begin(), table.media.end(), wanted);
  if (found != table.media.end()) return static_cast<uint16_t>(found - table.media.begin());
  table.media.push_back(wanted);
  return static_cast<uint16_t>(table.media.size() - 1);
}

SurfaceOptics describe(const Material& m, OpticsTable& table) {
  check(m);
  SurfaceOptics s;
  s.color = dvec3(m.base_color);
  s.crossing[0] = static_cast<double>(m.ior) / static_cast<double>(m.outer_ior);
  s.crossing[1] = static_cast<double>(m.outer_ior) / static_cast<double>(m.ior);
  if (m.roughness >= kSmoothRoughness) {
    s.base = 1.0 - (1.0 - m.metallic) * m.transmission;  // what a rough surface lets through is not followed
    s.diffuse_scale = s.base * s.color * std::numbers::inv_pi;
  } else {
    s.metal = m.metallic;
    s.clear = (1.0 - m.metallic) * m.transmission;
    s.base = (1.0 - m.metallic) * (1.0 - m.transmission);
    s.thin = m.thin_walled;
    s.eta = dvec3(m.conductor_eta) / static_cast<double>(m.outer_ior);
    s.k = dvec3(m.conductor_k) / static_cast<double>(m.outer_ior);
    s.conductor = s.eta != dvec3(0.0) || s.k != dvec3(0.0);
    const double eta = s.crossing[0];
    s.coated = eta != 1.0;
    const double back = s.coated && s.base > 0.0 ? hemispherical_reflectance(1.0 / eta) : 0.0;
    s.diffuse_scale = s.base * s.color * std::numbers::inv_pi / (eta * eta * (1.0 - back * s.color));
    s.specular = s.metal > 0.0 || s.clear > 0.0 || (s.base > 0.0 && s.coated);
    s.interface = s.clear > 0.0 && !s.thin;
    if (s.interface) {
      s.inner_medium = medium(table, m.ior, m.absorption);
      s.outer_medium = medium(table, m.outer_ior, m.outer_absorption);
    }
  }
  s.diffuse = s.base > 0.0 && s.color != dvec3(0.0);
  s.tag = surface_tag::of(s);
  return s;
}

}  // namespace

uint64_t surface_tag::of(const SurfaceOptics& s) {
  return (s.specular ? kSpecular : 0) | (s.diffuse ? kDiffuse : 0) | (s.interface ? kInterface : 0) |
         (s.coated ? kCoated : 0) | (s.thin ? kThin : 0) | (s.conductor ? kConductor : 0) |
         uint64_t{s.inner_medium} << kInnerShift | uint64_t{s.outer_medium} << kOuterShift;
}

OpticsTable make_optics(const Scene& scene) {
  OpticsTable table;
  table.media.emplace_back();
  table.materials.reserve(scene.materials.size());
  for (const Material& m : scene.materials) table.materials.push_back(describe(m, table));
  const auto count_material = [&](uint32_t material) {
    table.any_specular |= table.materials[material].specular;
    table.any_interface |= table.materials[material].interface;
  };
  for (const SceneObject& object : scene.objects)
    if (object.triangle_count > 0) count_material(object.material);
  for (const AnalyticSurface& surface : scene.analytic) count_material(surface.material);
  for (const RoundCurve& curve : scene.curves) count_material(curve.material);
  table.surfaces = SurfaceTable(scene, table.any_specular);
  return table;
}

dvec3 metal_reflectance(const SurfaceOptics& s, double cos_i) {
  if (!s.conductor) return s.color;
  return {fresnel_conductor(cos_i, s.eta.x, s.k.x), fresnel_conductor(cos_i, s.eta.y, s.k.y),
          fresnel_conductor(cos_i, s.eta.z, s.k.z)};
}

dvec3 diffuse_brdf(const SurfaceOptics& s, double cos_in, double cos_out) {
  if (!s.coated) return s.diffuse_scale;
  const double eta = s.crossing[0];
  return (1.0 - fresnel_dielectric(cos_in, eta)) * (1.0 - fresnel_dielectric(cos_out, eta)) * s.diffuse_scale;
}

}  // namespace hybray::optics
