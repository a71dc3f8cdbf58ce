// One point of `ssrm`: buffers, rays, march, truth, verdicts, times.
#include "core/metrics/statistics.h"
#include "core/ssrm/hybrid.h"
#include "core/truth/march_level0.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/ssrm.h"
#include "harness/experiments/ssrm_frame.h"
#include "harness/experiments/ssrm_picture.h"
#include "harness/timing/interleaved.h"
#include "harness/timing/trace_mode_choice.h"

#include <cmath>
#include <numeric>

namespace hybray::ssrm_parts {
namespace {

using ssrm::Verdict;

ssrm::MarchOptions march_options(const Point& point) {
  return {.step_budget = static_cast<uint64_t>(point.integer("step_budget")),
          .code = point.text("march_code") == "lanes" ? ssrm::MarchCode::lanes : ssrm::MarchCode::scalar,
          .marcher = point.text("marcher") == "plane" ? ssrm::Marcher::plane : ssrm::Marcher::paper,
          .ascent = point.text("ascent") == "parent" ? ssrm::Ascent::parent : ssrm::Ascent::iteration};
}

SlantedPyramid::Bounds bounds_of(const Point& point) {
  return point.text("bounds") == "flat" ? SlantedPyramid::Bounds::flat : SlantedPyramid::Bounds::slanted;
}

// Marches every `stride`-th ray exhaustively in double precision and compares labels: verdict and pixel.
void add_level0(Row& row, const ssrm::DepthView& depth, const ssrm::ScreenRays& rays,
                const std::vector<uint32_t>& pixels, const ssrm::MarchResults& results, ssrm::Marcher marcher,
                size_t stride) {
  const ssrm::MarchResults exact = truth::march_level0<double>(depth, rays, pixels, stride, marcher);
  uint64_t differ = 0;
  double margin = 0.0;
  for (size_t j = 0; j < exact.size(); ++j) {
    const size_t i = j * stride;
    // A ray stopped by its budget says nothing about where it would have gone.
    if (results.verdict[i] == Verdict::budget) continue;
    if (exact.verdict[j] == results.verdict[i] && exact.pixel[j] == results.pixel[i]) continue;
    ++differ;
    margin = std::max(margin, truth::first_difference_margin(depth, rays, i, pixels[i], marcher));
  }
  row["level0_disagreement_fraction"] = share(differ, exact.size());
  if (differ > 0 && std::isfinite(margin)) row["level0_margin_ulp"] = margin;
}

// All variants, interleaved. `rays` must not be empty.
void add_times(Row& row, const SsrmSetup& setup, const ssrm::MarchOptions& march, const Tracer& tracer,
               SlantedPyramid::Bounds bounds, SsrmFrame& frame, ssrm::HybridBuffers& buffers, int repeats,
               uint64_t seed) {
  const RayStream& rays = frame.rays();
  const ssrm::DepthView depth = frame.depth();
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
    // Marcher `plane` reads the first level alone of the flat pyramid.
    frame.pyramid.build(frame.gbuffer.depth, setup.view.depth_sign(), setup.view.background_depth(),
                        frame.slanted ? 1 : DepthPyramid::kAllLevels);
    if (frame.slanted) frame.add_slanted(bounds);
  };
  const auto hybrid = [&](TraceMode m) {
    build_pyramid();
    ssrm::trace_hybrid(tracer, m, depth, rays, frame.screen_rays, march, buffers);
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
      {"raygen", [&] { make_reflection_rays(frame.gbuffer, setup.scene); }},
      {"projection", [&] { ssrm::project_rays(rays, setup.view, setup.scene.bounds); }},
      {"compaction", [&] { ssrm::compact_unresolved(buffers.results, buffers.unresolved); }},
      {"t_ss", [&] { ssrm::march(depth, frame.screen_rays, rays.pixel, march, buffers.results); }},
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

void add_keys(Row& row, const Point& point) {
  for (const char* name : {"marcher", "march_code"}) row[name] = point.text(name);
  if (point.text("marcher") == "plane")
    for (const char* name : {"bounds", "ascent"}) row[name] = point.text(name);
  row["mirror_depth"] = point.integer("mirror_depth");
  row["step_budget"] = point.integer("step_budget");
  row["footprint_factor"] = point.number("footprint_factor");
}

}  // namespace

Row run(const Point& point, Workspace& workspace) {
  const bool picture = point.boolean("picture");
  const SsrmSetup setup(point, workspace, picture ? kMaterial : 0u);
  SsrmFrame frame(setup);
  const RayStream& rays = frame.rays();
  const ssrm::MarchOptions march = march_options(point);
  if (march.marcher == ssrm::Marcher::plane) frame.add_slanted(bounds_of(point));
  const ssrm::DepthView depth = frame.depth();
  Row row;
  add_view_cells(row, point, setup, frame);
  add_keys(row, point);
  row["buffer_bytes"] = static_cast<int64_t>(frame.memory_bytes());

  ssrm::HybridBuffers buffers(rays.size());
  ssrm::march(depth, frame.screen_rays, rays.pixel, march, buffers.results);
  row["steps_per_ray"] = share(buffers.results.steps, rays.size());
  {
    const truth::RayTruth truth = truth::trace_truth(setup.robust, rays, setup.view);
    std::vector<metrics::HitClass> classes;
    add_verdict_cells(
        row, metrics::judge(buffers.results, depth, frame.screen_rays, rays, truth, frame.gbuffer,
                            setup.scene, {point.number("footprint_factor")}, picture ? &classes : nullptr));
    row["resolved_fraction"] = row["alpha"];  // both marchers send their MISS on
    if (picture)
      write_verdict_picture(point, workspace, frame.gbuffer, setup.scene, rays, buffers.results, classes);
  }
  if (const int64_t stride = point.integer("level0_every"); stride > 0)
    add_level0(row, depth, frame.screen_rays, rays.pixel, buffers.results, march.marcher,
               static_cast<size_t>(stride));
  if (workspace.settings().timing && rays.size() > 0)
    add_times(row, setup, march, workspace.tracer(point.text("scene")), bounds_of(point), frame, buffers,
              static_cast<int>(point.integer("repeats")), workspace.settings().seed);
  return row;
}

}  // namespace hybray::ssrm_parts
