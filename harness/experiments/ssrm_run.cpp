// One point of `ssrm`: buffers, rays, march, truth, verdicts, times.
#include "core/base/parallel.h"
#include "core/gbuffer/reflection_rays.h"
#include "core/metrics/statistics.h"
#include "core/metrics/verdict_table.h"
#include "core/ssrm/hybrid.h"
#include "core/truth/march_level0.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/resolution.h"
#include "harness/experiments/ssrm.h"
#include "harness/experiments/ssrm_picture.h"
#include "harness/experiments/workspace.h"
#include "harness/timing/interleaved.h"
#include "harness/timing/trace_mode_choice.h"

#include <bit>
#include <cmath>
#include <memory>
#include <numeric>

namespace hybray::ssrm_parts {
namespace {

using ssrm::Verdict;

// Everything that the stages of one point share.
struct Setup {
  const Scene& scene;
  const Tracer& robust;
  View view;
  unsigned bits;
  bool difference;
  ssrm::MarchOptions march;

  GBuffer make_buffers() const {
    GBuffer g = make_gbuffer(robust, view, bits);
    if (difference) g.depth_derivatives = difference_derivatives(g.depth);
    return g;
  }
};

Setup make_setup(const Point& point, Workspace& workspace) {
  const std::string& name = point.text("scene");
  const Scene& scene = workspace.scene(name);
  const Resolution size = *parse_resolution(point.text("resolution"));
  const bool difference = point.text("derivatives") == "difference";
  View::Settings view{.width = size.width,
                      .height = size.height,
                      .near = point.number("near"),
                      .far = point.number("far"),
                      .convention = point.text("depth_convention") == "standard" ? DepthConvention::standard
                                                                                 : DepthConvention::reversed};
  unsigned bits = kDepth | kShadingNormal | kPrimitive;
  if (!difference) bits |= kDepthDerivatives;
  if (point.boolean("picture")) bits |= kMaterial;
  return {scene,
          workspace.robust_tracer(name),
          View(find_camera(scene, point.text("camera")), view, scene.bounds),
          bits,
          difference,
          {static_cast<uint64_t>(point.integer("step_budget")),
           point.text("march_code") == "lanes" ? ssrm::MarchCode::lanes : ssrm::MarchCode::scalar}};
}

void add_verdicts(Row& row, const metrics::VerdictTable& t) {
  const auto of_rays = [&](Verdict v) { return share(t.count(v), t.rays); };
  row["rays"] = static_cast<int64_t>(t.rays);
  row["alpha"] = of_rays(Verdict::hit);
  row["miss_fraction"] = of_rays(Verdict::miss);
  row["false_miss_fraction"] = share(t.false_misses, t.count(Verdict::miss));
  row["resolved_fraction"] = of_rays(Verdict::hit);  // marcher `paper` sends its MISS on
  row["unknown_offscreen_fraction"] = of_rays(Verdict::offscreen);
  row["unknown_behind_fraction"] = of_rays(Verdict::behind);
  row["unknown_viewer_fraction"] = of_rays(Verdict::viewer);
  row["unknown_correction_fraction"] = of_rays(Verdict::correction);
  row["unknown_budget_fraction"] = of_rays(Verdict::budget);
  row["precision"] = share(t.right, t.hits());
  row["precision_loose"] = share(t.right_loose, t.hits());
  row["recall"] = share(t.right, t.visible_true_hits);
  row["alpha_max"] = share(t.visible_true_hits, t.rays);
  row["false_hit_fraction"] = share(t.phantom + t.early + t.through, t.hits());
  row["phantom_fraction"] = share(t.phantom, t.hits());
  row["early_fraction"] = share(t.early, t.hits());
  row["through_fraction"] = share(t.through, t.hits());
}

// Marches every `stride`-th ray exhaustively in double precision and compares labels: verdict and pixel.
void add_level0(Row& row, const ssrm::DepthView& depth, const ssrm::ScreenRays& rays,
                const std::vector<uint32_t>& pixels, const ssrm::MarchResults& results, size_t stride) {
  const ssrm::MarchResults exact = truth::march_level0<double>(depth, rays, pixels, stride);
  uint64_t differ = 0;
  double margin = 0.0;
  for (size_t j = 0; j < exact.size(); ++j) {
    const size_t i = j * stride;
    // A ray stopped by its budget says nothing about where it would have gone.
    if (results.verdict[i] == Verdict::budget) continue;
    if (exact.verdict[j] == results.verdict[i] && exact.pixel[j] == results.pixel[i]) continue;
    ++differ;
    margin = std::max(margin, truth::first_difference_margin(depth, rays, i, pixels[i]));
  }
  row["level0_disagreement_fraction"] = share(differ, exact.size());
  if (differ > 0 && std::isfinite(margin)) row["level0_margin_ulp"] = margin;
}

// All variants, interleaved. `rays` must not be empty.
void add_times(Row& row, const Setup& setup, const Tracer& tracer, const GBuffer& gbuffer,
               DepthPyramid& pyramid, const RayStream& rays, const ssrm::ScreenRays& screen_rays,
               ssrm::HybridBuffers& buffers, int repeats, uint64_t seed) {
  const ssrm::DepthView depth{pyramid, gbuffer.depth_derivatives, setup.view.depth_sign()};
  std::vector<uint32_t> all(rays.size()), unresolved;
  std::iota(all.begin(), all.end(), 0u);
  ssrm::compact_unresolved(buffers.results, unresolved);
  HitStream hits;
  hits.resize(rays.size());
  const TraceMode mode = fastest_trace_mode(tracer, rays, all, hits, seed);
  const TraceMode mode_unresolved = fastest_trace_mode(tracer, rays, unresolved, hits, seed);
  row["hw_mode"] = std::string(label(mode));
  row["hw_mode_unresolved"] = std::string(label(mode_unresolved));
  std::vector<uint32_t>().swap(all);

  const auto build_pyramid = [&] {
    pyramid.build(gbuffer.depth, setup.view.depth_sign(), setup.view.background_depth());
  };
  const auto hybrid = [&](TraceMode m) {
    build_pyramid();
    ssrm::trace_hybrid(tracer, m, depth, rays, screen_rays, setup.march, buffers);
  };
  enum {
    kGBuffer,
    kPyramid,
    kRaygen,
    kProjection,
    kCompaction,
    kSs,
    kHw,
    kHwSingle,
    kUnresolved,
    kHybrid,
    kHybridSingle
  };
  const Variant variants[] = {
      {"gbuffer", [&] { setup.make_buffers(); }},
      {"pyramid", build_pyramid},
      {"raygen", [&] { make_reflection_rays(gbuffer, setup.scene); }},
      {"projection", [&] { ssrm::project_rays(rays, setup.view, setup.scene.bounds); }},
      {"compaction", [&] { ssrm::compact_unresolved(buffers.results, buffers.unresolved); }},
      {"t_ss", [&] { ssrm::march_paper(depth, screen_rays, rays.pixel, setup.march, buffers.results); }},
      {"t_hw", [&] { tracer.trace(rays, hits, mode); }},
      {"t_hw_single", [&] { tracer.trace(rays, hits, TraceMode::single); }},
      {"t_unresolved", [&] { tracer.trace_some(rays, unresolved, hits, mode_unresolved); }},
      {"t_hybrid", [&] { hybrid(mode_unresolved); }},
      {"t_hybrid_single", [&] { hybrid(TraceMode::single); }},
  };
  const InterleavedTimes times = time_interleaved(variants, repeats, seed);
  for (size_t v = 0; v < std::size(variants); ++v) put_time(row, variants[v].name, times.of(v));

  const auto hw = times.of(kHw), ss = times.of(kSs);
  const double n = static_cast<double>(rays.size());
  const double alpha = 1.0 - static_cast<double>(unresolved.size()) / n;
  std::vector<double> sequential, partitioned, per_unresolved, per_ray;
  for (size_t r = 0; r < hw.size(); ++r) {
    const ssrm::HybridEstimate estimate = ssrm::estimate_hybrid(alpha, ss[r], hw[r]);
    sequential.push_back(estimate.sequential);
    partitioned.push_back(estimate.partitioned);
    per_ray.push_back(hw[r] / n);
    if (!unresolved.empty())
      per_unresolved.push_back(times.of(kUnresolved)[r] / static_cast<double>(unresolved.size()));
  }
  row["t_sequential_ms"] = metrics::median(sequential);
  row["t_partitioned_ms"] = metrics::median(partitioned);
  put_ratio(row, "speedup_sequential", hw, sequential, seed);
  put_ratio(row, "speedup_partitioned", hw, partitioned, seed);
  put_ratio(row, "speedup_measured", hw, times.of(kHybrid), seed);
  put_ratio(row, "speedup_measured_vs_single", times.of(kHwSingle), times.of(kHybridSingle), seed);
  if (!unresolved.empty()) put_ratio(row, "unresolved_cost_ratio", per_unresolved, per_ray, seed);
  row["break_even_alpha"] = metrics::median_ratio(ss, hw, seed).value;
  row["repeats"] = int64_t{repeats};
}

void add_keys(Row& row, const Point& point, const Setup& setup, const GBuffer& gbuffer) {
  for (const char* name : {"scene", "camera", "marcher", "march_code", "depth_convention", "derivatives"})
    row[name] = point.text(name);
  row["width"] = int64_t{setup.view.width()};
  row["height"] = int64_t{setup.view.height()};
  row["near_m"] = setup.view.near();
  row["far_m"] = setup.view.far();
  row["mirror_depth"] = point.integer("mirror_depth");
  row["step_budget"] = point.integer("step_budget");
  row["footprint_factor"] = point.number("footprint_factor");
  row["triangles"] = static_cast<int64_t>(setup.scene.triangle_count());
  row["paths_skipped"] = static_cast<int64_t>(gbuffer.depth.size() - gbuffer.covered_pixels);
  row["buffers_skipped"] = int64_t{kGBufferKinds - std::popcount(setup.bits)};
  row["threads"] = int64_t{thread_count()};
}

}  // namespace

Row run(const Point& point, Workspace& workspace) {
  const Setup setup = make_setup(point, workspace);
  Row row;
  const GBuffer gbuffer = setup.make_buffers();
  DepthPyramid pyramid(setup.view.width(), setup.view.height());
  pyramid.build(gbuffer.depth, setup.view.depth_sign(), setup.view.background_depth());
  const ReflectionRays reflection = make_reflection_rays(gbuffer, setup.scene);
  const RayStream& rays = reflection.rays;
  const ssrm::ScreenRays screen_rays = ssrm::project_rays(rays, setup.view, setup.scene.bounds);
  const ssrm::DepthView depth{pyramid, gbuffer.depth_derivatives, setup.view.depth_sign()};
  add_keys(row, point, setup, gbuffer);
  row["geometric_mirror_rays"] = static_cast<int64_t>(reflection.mirrored_about_geometric_normal);
  row["buffer_bytes"] = static_cast<int64_t>(gbuffer.memory_bytes() + pyramid.memory_bytes() +
                                             rays.memory_bytes() + screen_rays.memory_bytes());

  ssrm::HybridBuffers buffers(rays.size());
  ssrm::march_paper(depth, screen_rays, rays.pixel, setup.march, buffers.results);
  row["steps_per_ray"] = share(buffers.results.steps, rays.size());
  {
    const truth::RayTruth truth = truth::trace_truth(setup.robust, rays, setup.view);
    const bool picture = point.boolean("picture");
    std::vector<metrics::HitClass> classes;
    add_verdicts(row, metrics::judge(buffers.results, depth, screen_rays, rays, truth, gbuffer, setup.scene,
                                     {point.number("footprint_factor")}, picture ? &classes : nullptr));
    if (picture)
      write_verdict_picture(point, workspace, gbuffer, setup.scene, rays, buffers.results, classes);
  }
  if (const int64_t stride = point.integer("level0_every"); stride > 0)
    add_level0(row, depth, screen_rays, rays.pixel, buffers.results, static_cast<size_t>(stride));
  if (workspace.settings().timing && rays.size() > 0)
    add_times(row, setup, workspace.tracer(point.text("scene")), gbuffer, pyramid, rays, screen_rays, buffers,
              static_cast<int>(point.integer("repeats")), workspace.settings().seed);
  return row;
}

}  // namespace hybray::ssrm_parts
