// The main view of a point of `stability`: the scene's camera or one turned to a given incidence, and the
// same view of the scene in another place.
#pragma once

#include "core/gbuffer/depth_storage.h"
#include "core/scene/pose.h"
#include "core/tracer/tracer.h"
#include "harness/experiments/experiment.h"

namespace hybray::stability_parts {

// The camera turned about the point that its axis meets first, at the same distance from it, until its axis
// makes `degrees` with the normal there, in the plane of both. Throws InputError where the axis meets
// nothing.
Camera at_incidence(const Tracer& robust, const Camera& camera, double degrees);

// What of a point says what is seen, before anything is disturbed.
struct StableView {
  Camera camera;
  View::Settings settings;  // near and far resolved
  View view;

  StableView(const Point& point, const Tracer& robust);
};

// How a point moves its scene, and what its coordinates are relative to.
Pose pose_of(const Point& point, const Camera& camera);

// The same view there: near and far planes grow with the scene.
View placed_view(const StableView& stable, const Pose& pose, const Scene& placed);

DepthStorage storage_of(const Point& point);

}  // namespace hybray::stability_parts
