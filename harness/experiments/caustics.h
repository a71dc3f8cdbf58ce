// Experiment `caustics`: light visibility maps, forward tracing, mixed caustics by photon maps, held against
// converged references and closed forms (caustics paper, Figures 6 to 8 and the costs of lights).
#pragma once

#include "core/caustics/caustic_pass.h"
#include "core/metrics/hdr_flip.h"
#include "core/metrics/image_batches.h"
#include "core/metrics/image_error.h"
#include "harness/experiments/experiment.h"

#include <optional>
#include <vector>

namespace hybray {

const Experiment& caustics_experiment();

namespace caustics_parts {

std::vector<Parameter> parameters();
std::vector<Column> columns();
Row run(const Point& point, Workspace& workspace);
double memory_bytes(const Point& point);
double cost_seconds(const Point& point, const SceneFacts& scene);
std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene);

// Everything that the stages of one point share.
struct Setup {
  const Scene& scene;
  const Tracer& robust;
  const caustics::CausticScene& caustic_scene;  // over the tracer that is timed
  View view;
  unsigned bits;  // of the G-buffer
  GBuffer gbuffer;
  caustics::PassSettings pass;
  uint16_t camera_medium;
  int64_t lights_visible, lights_invisible;  // among pass.lights
  bool filter;
};
Setup make_setup(const Point& point, Workspace& workspace);

// A converged image of the same view and lights, shared by the points of a run that need it.
struct Reference {
  std::vector<Image2D<vec3>> batches;  // illumination + mixed
  metrics::ReferenceImage image;       // their mean; its variance holds the bias of photon mapping as well
  bool lit = false;                    // any pixel: otherwise the two errors are 0
  std::optional<metrics::FlipExposures> exposures;  // at which displays show it; none: it is black
  double relmse = 0.0;                              // the reference's own, bias included
  double bias_relmse = 0.0;                         // the part of it that is that bias
  double landed = 0.0, missed_by_map = 0.0;  // flux on pixels, W; the part that no map would have emitted
  uint64_t rays = 0;
};
const Reference& reference(const Point& point, Workspace& workspace, const Setup& setup);

// One frame of the method: illumination caustics, mixed caustics, filter.
struct Frame {
  Image2D<vec3> image;  // W/(sr m^2)
  caustics::LightPaths paths;
  caustics::SplatCounts splat;
  uint64_t mixed_rays = 0, mixed_pixels = 0, visibility_points = 0, pairs = 0;
  double accumulator_peak = 0.0;
  uint64_t overflows = 0;
};
Frame make_frame(const Setup& setup, const caustics::MapSet& maps, uint32_t sample);
Image2D<vec3> filtered(const Setup& setup, const Image2D<vec3>& image);

// Time columns, all variants interleaved.
void add_times(Row& row, const Setup& setup, const caustics::MapSet& maps, int repeats, uint64_t seed);

// The same of a point without caustics.
void add_main_view_time(Row& row, const Setup& setup, int repeats, uint64_t seed);

// Pictures below the run's folder: without caustics, with them, caustics alone, the reference, and where
// HDR-FLIP sees the caustics differ from it. `caustics` and `flip` may be empty, `reference` null. Points
// that share a view, lights and a reference are shown at the same exposure.
void write_pictures(const Point& point, const Workspace& workspace, const Setup& setup,
                    const Image2D<vec3>& caustics, const Reference* reference, const Image2D<float>& flip);

}  // namespace caustics_parts
}  // namespace hybray
