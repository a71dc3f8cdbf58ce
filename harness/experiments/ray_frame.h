// What the experiments on kinds of rays share: the rays of a point, bounce by bounce, with verdicts and
// truth, and the parameters and columns that go with them.
#pragma once

#include "core/gbuffer/pixel_rays.h"
#include "core/metrics/verdict_table.h"
#include "core/ssrm/march.h"
#include "core/truth/ray_truth.h"
#include "harness/experiments/experiment.h"
#include "harness/experiments/ssrm_frame.h"
#include "harness/experiments/workspace.h"

#include <optional>
#include <vector>

namespace hybray {

inline constexpr int kMostBounces = 4;

// The rays of one bounce; only mirror rays have more than one.
struct RayBounce {
  RayStream rays;
  std::vector<float> lengths;  // empty: no end
  ssrm::ScreenRays screen_rays;
  ssrm::MarchResults results;
  metrics::VerdictTable table;
  std::vector<metrics::HitClass> classes;  // what each HIT is
  std::vector<uint32_t> unresolved;
  size_t unseen = 0;  // rays that start where the view sees something else
};

struct RayFrame {
  GBuffer gbuffer;
  DepthPyramid pyramid;
  std::optional<SlantedPyramid> slanted;  // for marcher `plane`
  RayKind kind;
  ssrm::MarchOptions march;
  std::vector<RayBounce> bounces;
  metrics::VerdictTable table;  // of all bounces
  size_t about_geometric_normal = 0, rays_skipped = 0, unseen = 0, rays = 0, unresolved = 0;
  uint64_t steps = 0, truly_hit = 0;

  // Makes, marches and judges the rays of a point. Throws InputError for shadow rays in a scene without
  // lights.
  RayFrame(const Point& point, const SsrmSetup& setup, uint64_t seed);
  RayFrame(const RayFrame&) = delete;
  RayFrame& operator=(const RayFrame&) = delete;

  ssrm::DepthView depth() const {
    return {pyramid, gbuffer.depth_derivatives, gbuffer.view.depth_sign(), slanted ? &*slanted : nullptr};
  }
  bool occlusion() const { return asks_for_occlusion(kind); }
  double alpha() const { return 1.0 - static_cast<double>(unresolved) / static_cast<double>(rays); }
};

// The newest frame, shared by neighbouring points that differ in other parameters alone.
const RayFrame& shared_ray_frame(const Point& point, Workspace& workspace, const SsrmSetup& setup);

// Those of the view, ray_kind and what belongs to it, marcher, march_code, footprint_factor.
std::vector<Parameter> ray_parameters();

// Keys, counts, verdicts and what else does not depend on time.
void add_ray_columns(std::vector<Column>& columns);
void add_ray_cells(Row& row, const Point& point, const SsrmSetup& setup, const RayFrame& frame);

double ray_memory_bytes(const Point& point);
// Seconds on two cores to make and judge the rays, and of one round of timing in which the rays are marched
// and traced about `passes` times.
double ray_frame_seconds(const Point& point);
double ray_round_seconds(const Point& point, const SceneFacts& scene, double passes);

}  // namespace hybray
