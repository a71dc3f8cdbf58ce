// What the SSRM experiments share: the main view of a point with its buffers and reflection rays, what those
// rays truly hit, and the parameters, keys and verdict columns that go with them.
#pragma once

#include "core/gbuffer/reflection_rays.h"
#include "core/metrics/verdict_table.h"
#include "core/ssrm/correction.h"
#include "core/ssrm/screen_rays.h"
#include "core/truth/ray_truth.h"
#include "harness/experiments/experiment.h"
#include "harness/experiments/workspace.h"

#include <optional>

namespace hybray {

// The pyramid of a view's depth.
DepthPyramid pyramid_of(const GBuffer& gbuffer);

// How the main view of a point is made.
struct SsrmSetup {
  const Scene& scene;
  const Tracer& robust;
  View view;
  unsigned bits;    // GBufferBits
  bool difference;  // depth derivatives by differences

  // Of a point that has ssrm_view_parameters(). `more_bits`: further buffers that the experiment needs.
  SsrmSetup(const Point& point, Workspace& workspace, unsigned more_bits = 0);

  GBuffer make_buffers() const;
};

// The main view and the mirror reflections of its pixels.
struct SsrmFrame {
  GBuffer gbuffer;
  DepthPyramid pyramid;
  ReflectionRays reflection;
  ssrm::ScreenRays screen_rays;
  std::optional<SlantedPyramid> slanted;  // after add_slanted

  explicit SsrmFrame(const SsrmSetup& setup);
  SsrmFrame(const SsrmFrame&) = delete;
  SsrmFrame& operator=(const SsrmFrame&) = delete;

  const View& view() const { return gbuffer.view; }
  const RayStream& rays() const { return reflection.rays; }
  ssrm::DepthView depth() const {
    return {pyramid, gbuffer.depth_derivatives, view().depth_sign(), slanted ? &*slanted : nullptr};
  }
  // Builds, or builds anew, what marcher `plane` marches on.
  void add_slanted(SlantedPyramid::Bounds bounds);
  size_t memory_bytes() const;
};

// A frame and its truth, made once for neighbouring points with the same view: only the newest is kept.
struct JudgedFrame {
  SsrmFrame frame;
  truth::RayTruth truth;

  explicit JudgedFrame(const SsrmSetup& setup);  // with the slanted pyramid
};
const JudgedFrame& shared_frame(const Point& point, Workspace& workspace, unsigned more_bits = 0);

// scene, camera, resolution, near, far, depth_convention, derivatives.
std::vector<Parameter> ssrm_view_parameters();

// Further ones that several experiments have.
Parameter step_budget_parameter(const char* text);
Parameter footprint_factor_parameter();
Parameter verdict_picture_parameter();

// hw_mode and hw_mode_unresolved.
void add_trace_mode_columns(std::vector<Column>& columns);

// Bytes of the largest of the known scenes with both acceleration structures (0.64e9 as measured).
constexpr double kSceneBytes = 0.7e9;
double pixels_of(const Point& point);
double width_of(const Point& point);
// The scene, loaded twice (once for its hash), and both of its acceleration structures: the same for all
// points of a scene.
SharedCost scene_cost(const Point& point, const SceneFacts& scene);

// The keys of those parameters, and triangles, rays, skipped work and threads, which add_view_cells fills.
void add_view_columns(std::vector<Column>& columns);
void add_view_cells(Row& row, const Point& point, const SsrmSetup& setup, const SsrmFrame& frame);

// alpha, miss, the unknowns, precision, recall, false hits: from `alpha` to `through_fraction`, without
// resolved_fraction, which depends on what a marcher sends on.
void add_verdict_columns(std::vector<Column>& columns);
void add_verdict_cells(Row& row, const metrics::VerdictTable& table);

// Rays within rounding of an edge change sides with the general tracer's instruction set: at most 20 in
// 100,000. A share of rays, and what follows from their number, are compared within that.
constexpr double kMovedRays = 2e-4;
Column share_of_rays(const char* name, Better better, const char* text);
// Samples read by, or for, each ray: a moved ray may read ten times the mean.
Column samples_read(const char* name, Better better, const char* text);
Column follows_rays(Column column);

}  // namespace hybray
