#include "harness/experiments/stability_view.h"

#include "core/base/error.h"
#include "core/scene/surface_point.h"
#include "core/tracer/seeded_camera.h"
#include "harness/experiments/resolution.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace hybray::stability_parts {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The offset's direction: no axis of the scene, so that all coordinates lose digits.
const dvec3 kAside = glm::normalize(dvec3(1.0, 0.6, -0.8));

Camera camera_of_point(const Point& point, const Tracer& robust) {
  const Camera camera = camera_of(robust, point.text("camera"));
  const double incidence = point.number("incidence");
  return incidence < 0.0 ? camera : at_incidence(robust, camera, incidence);
}

View::Settings settings_of(const Point& point, const Camera& camera, const Scene& scene) {
  const Resolution size = *parse_resolution(point.text("resolution"));
  View::Settings s{.width = size.width,
                   .height = size.height,
                   .near = point.number("near"),
                   .convention = point.text("depth_convention") == "standard" ? DepthConvention::standard
                                                                              : DepthConvention::reversed,
                   .jitter = {point.number("jitter_x"), point.number("jitter_y")}};
  s.far = View(camera, s, scene.bounds).far();
  if (const double ratio = point.number("far_near_ratio"); ratio > 0.0) s.near = s.far / ratio;
  if (point.text("far_plane") == "infinite") s.far = kInfinity;
  return s;
}

}  // namespace

Camera at_incidence(const Tracer& robust, const Camera& camera, double degrees) {
  const dvec3 eye(camera.eye), axis = glm::normalize(dvec3(camera.target) - eye);
  const Hit hit = robust.intersect(camera.eye, vec3(axis));
  if (!hit.valid())
    throw InputError("camera " + camera.name, "its axis meets nothing, so it has no incidence");
  const dvec3 point = eye + static_cast<double>(hit.t) * axis;
  dvec3 normal = geometric_normal(robust.scene(), hit.primitive, point);
  if (glm::dot(normal, axis) > 0.0) normal = -normal;
  dvec3 along = -axis - glm::dot(-axis, normal) * normal;
  // An axis along the normal is turned about the camera's horizontal.
  if (glm::length(along) < 1e-6) {
    along = dvec3(camera.up) - glm::dot(dvec3(camera.up), normal) * normal;
    if (glm::length(along) < 1e-6) along = glm::cross(normal, dvec3(1.0, 0.0, 0.0));
  }
  const double angle = degrees * std::numbers::pi / 180.0;
  const dvec3 toward_eye = std::cos(angle) * normal + std::sin(angle) * glm::normalize(along);
  Camera turned = camera;
  turned.eye = vec3(point + static_cast<double>(hit.t) * toward_eye);
  turned.target = vec3(point);
  // Straight at the surface, the old up may be the axis.
  if (glm::length(glm::cross(toward_eye, dvec3(camera.up))) < 1e-3) turned.up = vec3(-glm::normalize(along));
  return turned;
}

StableView::StableView(const Point& point, const Tracer& robust)
    : camera(camera_of_point(point, robust)),
      settings(settings_of(point, camera, robust.scene())),
      view(camera, settings, robust.scene().bounds) {}

Pose pose_of(const Point& point, const Camera& camera) {
  Pose pose{.scale = point.number("scene_scale"), .offset = point.number("offset") * kAside};
  if (point.text("origin") == "camera") pose.offset = -pose.scale * dvec3(camera.eye);
  return pose;
}

View placed_view(const StableView& stable, const Pose& pose, const Scene& placed) {
  View::Settings settings = stable.settings;
  settings.near *= pose.scale;
  settings.far *= pose.scale;
  return View(posed(stable.camera, pose), settings, placed.bounds);
}

DepthStorage storage_of(const Point& point) {
  const std::string& format = point.text("depth_format");
  return {format == "unorm24"   ? DepthFormat::unorm24
          : format == "unorm16" ? DepthFormat::unorm16
                                : DepthFormat::float32,
          point.text("depth_rounding") == "viewer" ? DepthRounding::viewer : DepthRounding::nearest};
}

}  // namespace hybray::stability_parts
