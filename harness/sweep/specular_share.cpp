#include "harness/sweep/specular_share.h"

#include "core/caustics/light_source.h"
#include "core/gbuffer/light_frame.h"
#include "core/optics/specular_step.h"
#include "core/optics/surface_optics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybray {
namespace {

constexpr int kResolution = 64;
// Mean shadow of a sphere over that of the cube around it: pi / 4 over 3 / 2.
constexpr double kShadowOfBox = 0.52;

struct Facet {
  std::array<dvec3, 3> corners;  // counter-clockwise from outside
  double weight;
};

// The six sides of a box, in two triangles each.
void add_box(std::vector<Facet>& facets, const Bounds3& box) {
  const dvec3 lower(box.lower), upper(box.upper);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool top : {false, true}) {
      dvec3 p = lower, u(0.0), v(0.0);
      if (top) p[axis] = upper[axis];
      u[(axis + 1) % 3] = upper[(axis + 1) % 3] - lower[(axis + 1) % 3];
      v[(axis + 2) % 3] = upper[(axis + 2) % 3] - lower[(axis + 2) % 3];
      if (!top) std::swap(u, v);
      facets.push_back({{p, p + u, p + u + v}, kShadowOfBox});
      facets.push_back({{p, p + u + v, p + v}, kShadowOfBox});
    }
  }
}

// The specular surfaces of a scene as triangles, and boxes around them.
struct Surfaces {
  std::vector<Facet> facets;
  std::vector<Bounds3> boxes;
};

Surfaces specular_surfaces(const Scene& scene) {
  Surfaces surfaces;
  const auto is_specular = [&](uint32_t material) {
    return scene.materials[material].roughness < optics::kSmoothRoughness;
  };
  for (const SceneObject& object : scene.objects) {
    if (!is_specular(object.material) || object.triangle_count == 0) continue;
    Bounds3 box;
    for (uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count; ++t) {
      const uvec3& corners = scene.triangles[t];
      for (const uint32_t v : {corners.x, corners.y, corners.z}) box.extend(scene.positions[v]);
      surfaces.facets.push_back({{dvec3(scene.positions[corners.x]), dvec3(scene.positions[corners.y]),
                                  dvec3(scene.positions[corners.z])},
                                 1.0});
    }
    surfaces.boxes.push_back(box);
  }
  for (const AnalyticSurface& surface : scene.analytic) {
    if (!is_specular(surface.material)) continue;
    surfaces.boxes.push_back(bounds(surface));
    add_box(surfaces.facets, surfaces.boxes.back());
  }
  Bounds3 curves;
  for (const RoundCurve& curve : scene.curves) {
    if (!is_specular(curve.material)) continue;
    const Bounds3 box = bounds(curve);
    curves.extend(box.lower), curves.extend(box.upper);
  }
  if (!curves.empty()) {
    surfaces.boxes.push_back(curves);
    add_box(surfaces.facets, curves);
  }
  return surfaces;
}

// Solid angle of a facet seen from `eye`, negative from behind (van Oosterom and Strackee 1983).
double solid_angle(const Facet& facet, const dvec3& eye) {
  const dvec3 a = facet.corners[0] - eye, b = facet.corners[1] - eye, c = facet.corners[2] - eye;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  return -2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                           la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

// What a texel of the light's maps is measured in: solid angle, or area across directional light.
double measure(const Facet& facet, const Light& light) {
  if (light.kind != LightKind::directional) return solid_angle(facet, dvec3(light.position));
  const dvec3 across = glm::cross(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
  return -0.5 * glm::dot(across, dvec3(light.direction));
}

// Texels of the frame that look at the facet. One that takes up many is split, since it may reach beyond the
// frame.
double texels(const Facet& facet, const Light& light, const LightFrame& frame, int splits = 6) {
  constexpr double kMany = 16.0;
  const double facing = measure(facet, light);
  if (!(facing > 0.0)) return 0.0;
  const auto& [a, b, c] = facet.corners;
  const double middle = frame.measure_density(0.5 * frame.width, 0.5 * frame.height);
  if (facing > kMany * middle && splits > 0) {
    const dvec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    double sum = 0.0;
    for (const Facet& part : {Facet{{a, ab, ca}, facet.weight}, Facet{{ab, b, bc}, facet.weight},
                              Facet{{ca, bc, c}, facet.weight}, Facet{{ab, bc, ca}, facet.weight}})
      sum += texels(part, light, frame, splits - 1);
    return sum;
  }
  const dvec3 centre = (a + b + c) / 3.0;
  const dvec3 direction = light.kind == LightKind::directional
                              ? dvec3(light.direction)
                              : glm::normalize(centre - dvec3(light.position));
  dvec2 image;
  if (optics::mean(caustics::intensity(light, direction)) <= 0.0 || !frame.project(centre, image)) return 0.0;
  return facet.weight * facing / frame.measure_density(image.x, image.y);
}

}  // namespace

double specular_share(const Scene& scene) {
  constexpr double kFrame = static_cast<double>(kResolution) * kResolution;
  const Surfaces surfaces = specular_surfaces(scene);
  double sum = 0.0;
  for (const Light& light : scene.lights) {
    for (const LightFrame& frame : light_frames(light, surfaces.boxes, scene.bounds, kResolution)) {
      double seen = 0.0;
      for (const Facet& facet : surfaces.facets) seen += texels(facet, light, frame);
      sum += std::min(seen, kFrame);
    }
  }
  return sum / (6.0 * kFrame);
}

}  // namespace hybray
