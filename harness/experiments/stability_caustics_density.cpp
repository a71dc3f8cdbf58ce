// Densities on a grazed receiver: what a camera straight over it sees, and photon maps at places in it.
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/view.h"
#include "harness/experiments/stability_caustics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hybray::stability_caustics_parts {
namespace {

using namespace caustics;
using procedural::GrazedReceiver;

constexpr int kPixels = 32;       // along each side of the camera's view
constexpr int kPlaces = 8;        // of photon maps, along each side of the middle
constexpr double kMiddle = 0.4;   // half of that, of the lit square's half length
constexpr double kSphere = 0.05;  // radius of an integration sphere, likewise

GrazedReceiver receiver_of(const Point& point) {
  return {.incidence = point.number("incidence") * std::numbers::pi / 180.0};
}

View view_of(const Body& body, double half_length) {
  View::Settings settings;
  settings.width = settings.height = kPixels;
  settings.near = 0.1 * half_length * body.pose.scale;
  return View(body.scene.cameras.at(0), settings, body.scene.bounds);
}

VisibilityPoints places(const Body& body, const GrazedReceiver& receiver) {
  const double half = receiver.half_length();
  VisibilityPoints visible;
  for (int j = 0; j < kPlaces; ++j)
    for (int i = 0; i < kPlaces; ++i) {
      const auto place = [&](int k) { return kMiddle * half * (2.0 * (k + 0.5) / kPlaces - 1.0); };
      const dvec3 p = receiver.center() + place(i) * receiver.along() + dvec3(0, 0, place(j));
      VisibilityPoint v;
      v.position = vec3(body.pose(p));
      v.normal = vec3(body.pose.turn * receiver.normal());
      v.weight = vec3(1.0f);
      v.radius = static_cast<float>(kSphere * half * body.pose.scale);
      v.pixel = static_cast<uint32_t>(kPlaces * j + i);
      v.material = body.scene.triangle_material.at(0);
      visible.points.push_back(v);
    }
  return visible;
}

double mean_irradiance(const Image2D<vec3>& radiance, const Scene& scene) {
  double sum = 0.0;
  for (size_t i = 0; i < radiance.size(); ++i) sum += static_cast<double>(radiance[i].y);
  const double albedo = scene.materials.at(scene.triangle_material.at(0)).base_color.y;
  return std::numbers::pi / albedo * sum / static_cast<double>(radiance.size());
}

}  // namespace

DensityTally::DensityTally(const Point& point, const Body& body, const Tracer& tracer,
                           const CausticScene& scene)
    : body_(body),
      scene_(scene),
      gbuffer_(make_gbuffer(tracer, view_of(body, receiver_of(point).half_length()),
                            kDepth | kDepthDerivatives | kPrimitive)),
      points_(places(body, receiver_of(point))),
      exact_(body.form->regions.at(0).irradiance) {}

void DensityTally::add(const LightPaths& paths) {
  if (paths.list.photons.empty()) {
    splat_.push_back(0.0), photon_map_.push_back(0.0);
    return;
  }
  const DirectResult direct = deposit(scene_, {}, gbuffer_, paths);
  splat_.push_back(mean_irradiance(direct.image.image(), body_.scene) / exact_);
  FixedPointImage image(kPlaces, kPlaces, largest_radiance(3.0 * paths.list.counts.ledger.emitted, points_));
  add_mixed_caustics(PhotonMapKind::backward, body_.scene, scene_.optics, paths.list.photons, points_, image);
  photon_map_.push_back(mean_irradiance(image.image(), body_.scene) / exact_);
}

void DensityTally::report(Row& row) const {
  const auto put = [&](const std::string& name, const std::vector<double>& ratios) {
    const caustics_parts::Estimate e = caustics_parts::estimate_of(ratios);
    row[name + "_error_fraction"] = std::abs(e.mean - 1.0);
    row[name + "_standard_error_fraction"] = e.standard_error;
  };
  put("splat", splat_);
  put("photon_map", photon_map_);
}

}  // namespace hybray::stability_caustics_parts
