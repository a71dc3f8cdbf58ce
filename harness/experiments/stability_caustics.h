// Experiment `stability_caustics`: where light tracing breaks numerically, one axis at a time, against closed
// forms. Definitions and findings: docs/stability_caustics.md.
#pragma once

#include "core/caustics/caustic_pass.h"
#include "core/scene/pose.h"
#include "core/truth/closed_forms.h"
#include "harness/experiments/experiment.h"
#include "harness/experiments/region_flux.h"

#include <optional>
#include <vector>

namespace hybray {

const Experiment& stability_caustics_experiment();

namespace stability_caustics_parts {

Row run(const Point& point, Workspace& workspace);

// What light is traced through.
struct Body {
  Scene scene;                            // in place
  Pose pose;                              // of the closed form's coordinates in it
  std::optional<truth::ClosedForm> form;  // none: too few events are followed, or nothing may arrive
  double flux_scale = 1.0;                // flux in it / flux of the closed form
  float receiver_ior = 1.0f;              // of the medium in which light reaches the receiver; 0: any
  bool closed = false;                    // nothing may escape
  bool dark = false;                      // nothing may arrive
  size_t collapsed = 0;                   // triangles that rounding left without area
};
Body make_body(const Point& point);

// Flux in the regions of the closed form, against it. `body` must outlive it.
class RegionTally {
 public:
  explicit RegionTally(const Body& body);
  void add(const caustics::PhotonBlocks& photons);  // of one independent frame
  void report(Row& row) const;

 private:
  const Body& body_;
  std::optional<caustics_parts::RegionFlux> flux_;
};

// Irradiance in the middle of a `grazed_receiver` as splatting and photon maps estimate it.
class DensityTally {
 public:
  DensityTally(const Point& point, const Body& body, const Tracer& tracer,
               const caustics::CausticScene& scene);
  void add(const caustics::LightPaths& paths);
  void report(Row& row) const;

 private:
  const Body& body_;
  const caustics::CausticScene& scene_;
  GBuffer gbuffer_;
  caustics::VisibilityPoints points_;
  double exact_;                            // irradiance, W/m^2
  std::vector<double> splat_, photon_map_;  // estimate / exact, by frame
};

// Optics alone: reflectance and directions at an interface, as rays in floats see it.
void add_interface(Row& row, const Point& point, uint64_t seed);

}  // namespace stability_caustics_parts
}  // namespace hybray
