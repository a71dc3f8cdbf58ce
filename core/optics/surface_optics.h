// What a material does to light, as a mixture of a specular and a diffuse part, precomputed once for a scene.
// One description for light paths and camera paths.
//
// The model. A surface rougher than kSmoothRoughness is Lambertian with its base colour. A smooth one is the
// mixture, by weight, of
//   metallic                          a mirror: conductor Fresnel, or base_color at every angle;
//   (1 - metallic) * transmission     a clear interface: Fresnel reflection, and refraction tinted by
//                                     base_color (thin_walled: both faces of a sheet, straight on);
//   (1 - metallic)(1 - transmission)  a Lambertian base under a smooth interface: Fresnel reflection, and
//                                     diffuse f = (1 - F_i)(1 - F_o) rho / (pi eta^2 (1 - rho F_dr)).
// The last is reciprocal and keeps energy: F_dr, the hemispherical reflectance from inside, sums the bounces
// between base and interface. A smooth material without a specular part does not exist; ior = 1 makes one.
#pragma once

#include "core/optics/fresnel.h"
#include "core/scene/surface_table.h"

#include <cstdint>
#include <vector>

namespace hybray::optics {

// Roughness below which a surface counts as perfectly smooth. Its square is the width of a microfacet lobe:
// 0.01 is about half a degree.
constexpr float kSmoothRoughness = 0.1f;

// A homogeneous medium between surfaces.
struct Medium {
  double ior = 1.0;
  dvec3 absorption{0.0};  // 1/m
  bool operator==(const Medium&) const = default;
};

struct SurfaceOptics {
  bool specular = false;                        // has any specular part
  bool diffuse = false;                         // has any diffuse part
  bool interface = false;                       // a closed border between two media
  double metal = 0.0, clear = 0.0, base = 0.0;  // weights of the three parts; a rough surface has base = 1
  bool coated = false;                          // the base lies under a smooth interface
  bool thin = false;
  bool conductor = false;           // metal by complex index, else by base_color
  dvec3 color{0.0};                 // base_color
  dvec3 eta{0.0}, k{0.0};           // of the metal
  double crossing[2] = {1.0, 1.0};  // index beyond / index before, for light from outside and from inside:
                                    // each the inverse of the other
  dvec3 diffuse_scale{0.0};         // rho / (pi eta^2 (1 - rho F_dr)), or rho / pi without interface, times
                                    // the weight of the base
  uint16_t inner_medium = 0, outer_medium = 0;  // into OpticsTable::media; of interfaces
  uint64_t tag = 0;                             // flags and media once more (surface_tag)
};

// Flags and media of a surface in one word, for code that works on many surfaces at once.
namespace surface_tag {
inline constexpr uint64_t kSpecular = 1, kDiffuse = 2, kInterface = 4, kCoated = 8, kThin = 16,
                          kConductor = 32;
inline constexpr int kInnerShift = 16, kOuterShift = 32;
uint64_t of(const SurfaceOptics& surface);
}  // namespace surface_tag

struct OpticsTable {
  std::vector<SurfaceOptics> materials;  // one a material of the scene
  std::vector<Medium> media;             // [0] is vacuum
  bool any_specular = false;             // on a surface that the scene really has
  bool any_interface = false;
  SurfaceTable surfaces;  // without entries where nothing is specular
};

// Throws InputError, naming the material, for an index of refraction below 1 or not finite, negative
// absorption, and factors outside their range.
OpticsTable make_optics(const Scene& scene);

// The specular part of a surface for light that arrives along `direction`.
struct SpecularSplit {
  dvec3 reflectance{0.0};    // share of the flux that is mirrored, by channel
  dvec3 transmittance{0.0};  // share that goes through, tint included
  double base_entry = 0.0;   // share that enters the diffuse part, (1 - F) weight
  double eta_cos = 0.0;      // of refraction_at; 0 where nothing is refracted
};

// Reflectance of the metal by channel, in [0, 1].
dvec3 metal_reflectance(const SurfaceOptics& surface, double cos_incident);

// `cos_incident` in [0, 1]; `from_inner`: the light comes from the side that the geometric normal turns away
// from. reflectance + transmittance + base_entry <= 1, the rest is absorbed.
inline SpecularSplit split(const SurfaceOptics& s, double cos_incident, bool from_inner) {
  SpecularSplit r;
  if (!s.specular) {
    r.base_entry = s.base;
    return r;
  }
  if (s.metal > 0.0) r.reflectance += s.metal * metal_reflectance(s, cos_incident);
  if (s.clear > 0.0) {
    Refraction at;
    if (s.thin)
      at.reflectance = thin_sheet_reflectance(cos_incident, s.crossing[0]);
    else
      at = refraction_at(cos_incident, s.crossing[from_inner]);
    r.eta_cos = at.eta_cos;
    r.reflectance += s.clear * at.reflectance;
    r.transmittance = (s.clear * (1.0 - at.reflectance)) * s.color;
  }
  if (s.base > 0.0) {
    // Both sides of an opaque surface are its outside.
    const double f = s.coated ? fresnel_dielectric(cos_incident, s.crossing[0]) : 0.0;
    r.reflectance += s.base * f;
    r.base_entry = s.base * (1.0 - f);
  }
  return r;
}

// Diffuse BRDF of the mixture, 1/sr, by channel. Cosines in [0, 1]; reciprocal.
dvec3 diffuse_brdf(const SurfaceOptics& surface, double cos_in, double cos_out);

}  // namespace hybray::optics
