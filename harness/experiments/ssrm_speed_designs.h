// A frame, and every design of the hybrid on it, for the experiment `ssrm_speed`.
#pragma once

#include "core/ssrm/hybrid.h"
#include "core/ssrm/predictor.h"
#include "core/ssrm/remaining_segment.h"
#include "harness/experiments/ssrm_frame.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace hybray::ssrm_speed_parts {

inline ssrm::MarchOptions in_lanes(const Point& point) {
  return {.code = ssrm::MarchCode::lanes,
          .marcher = point.text("marcher") == "plane" ? ssrm::Marcher::plane : ssrm::Marcher::paper};
}

// What the marcher needs beside the frame.
inline void prepare(SsrmFrame& frame, const ssrm::MarchOptions& march) {
  if (march.marcher == ssrm::Marcher::plane) frame.add_slanted(SlantedPyramid::Bounds::slanted);
}

// How a point predicts.
struct Predictor {
  double least;                                  // chance of a HIT from which on rays are marched
  std::optional<ssrm::ChanceHistory> history{};  // none: by a sample
};

// A frame, and every design of the hybrid on it. The one place that names the marcher.
class Designs {
 public:
  ssrm::MarchOptions lanes, scalar;

  Designs(const SsrmSetup& setup, SsrmFrame& frame, const Tracer& tracer, const ssrm::MarchOptions& march)
      : lanes(march),
        scalar(march),
        setup_(setup),
        frame_(frame),
        tracer_(tracer),
        buffers(frame.rays().size()),
        exact(frame.view(), frame.rays().size()) {
    scalar.code = ssrm::MarchCode::scalar;
    t_near.resize(frame.rays().size());
  }

  void build_pyramid() {
    // Marcher `plane` reads the first level alone of the flat pyramid.
    frame_.pyramid.build(frame_.gbuffer.depth, setup_.view.depth_sign(), setup_.view.background_depth(),
                         frame_.slanted ? 1 : DepthPyramid::kAllLevels);
    prepare(frame_, lanes);
  }
  void march(const ssrm::MarchOptions& options, ssrm::MarchResults& results) {
    ssrm::march(frame_.depth(), frame_.screen_rays, frame_.rays().pixel, options, results);
  }
  void trace(TraceMode mode, std::span<const float> from = {}) {
    tracer_.trace_some(frame_.rays(), buffers.unresolved, buffers.hits, mode, from);
  }
  void compact(const ssrm::MarchResults& results) { ssrm::compact_unresolved(results, buffers.unresolved); }

  void hybrid(TraceMode mode) {
    build_pyramid();
    march(lanes, buffers.results);
    compact(buffers.results);
    trace(mode);
  }
  // By the history, where the predictor has one. Rays that are left are proved up to nowhere.
  void predict(const Predictor& by, ssrm::MarchResults& results) {
    const ssrm::DepthView depth = frame_.depth();
    const ssrm::MarchInput input{depth, frame_.screen_rays, frame_.rays().pixel, lanes};
    if (by.history) {
      after_ = *by.history;  // which this frame changes, and no repeat may see
      ssrm::march_by_history(input, setup_.view, by.least, after_, results, prediction);
    } else {
      ssrm::march_by_sample(input, by.least, results, prediction);
    }
  }
  void predicted(TraceMode mode, const Predictor& by) {
    build_pyramid();
    predict(by, buffers.results);
    compact(buffers.results);
    trace(mode);
  }
  // As a predictor that knows what each run is worth.
  void oracle_of_runs(TraceMode mode, const std::vector<uint8_t>& worth) {
    build_pyramid();
    const ssrm::DepthView depth = frame_.depth();
    ssrm::march_runs({depth, frame_.screen_rays, frame_.rays().pixel, lanes}, worth, buffers.results,
                     prediction);
    compact(buffers.results);
    trace(mode);
  }
  void march_list(std::span<const uint32_t> list) {
    ssrm::march_some(frame_.depth(), frame_.screen_rays, frame_.rays().pixel, list, lanes, buffers.results);
  }
  void trace_list(std::span<const uint32_t> list, TraceMode mode) {
    tracer_.trace_some(frame_.rays(), list, buffers.hits, mode);
  }
  // The lists are known beforehand: nothing is compacted.
  void oracle(TraceMode mode, std::span<const uint32_t> resolved, std::span<const uint32_t> unresolved) {
    build_pyramid();
    march_list(resolved);
    trace_list(unresolved, mode);
  }
  void centre(TraceMode mode, ssrm::MarchResults& results) {
    build_pyramid();
    march(lanes, results);
    trace_from_centres(mode, results);
  }
  void predicted_centre(TraceMode mode, const Predictor& by, ssrm::MarchResults& results) {
    build_pyramid();
    predict(by, results);
    trace_from_centres(mode, results);
  }
  void build_conservative() { ssrm::build_conservative(frame_.gbuffer, setup_.scene, exact); }
  void exact_segments() {
    ssrm::exact_segments(frame_.gbuffer, setup_.scene, frame_.rays(), frame_.screen_rays, buffers.unresolved,
                         ssrm::MarchCode::lanes, exact);
  }
  void exact_hybrid(TraceMode mode, bool certified, bool build) {
    build_pyramid();
    if (build) build_conservative();
    march(lanes, buffers.results);
    compact(buffers.results);
    exact_segments();
    if (certified) std::erase_if(buffers.unresolved, [&](uint32_t i) { return exact.misses[i] != 0; });
    trace(mode, exact.t_near);
  }

 private:
  void trace_from_centres(TraceMode mode, const ssrm::MarchResults& results) {
    compact(results);
    ssrm::centre_segments(frame_.rays(), setup_.view, setup_.scene.bounds, results.proved, buffers.unresolved,
                          t_near);
    trace(mode, t_near);
  }

  const SsrmSetup& setup_;
  SsrmFrame& frame_;
  const Tracer& tracer_;
  ssrm::ChanceHistory after_;

 public:
  ssrm::HybridBuffers buffers;
  ssrm::ExactSegments exact;
  ssrm::Prediction prediction;
  std::vector<float> t_near;
};

// The times of the designs, their ratios, and what the oracle's are made of. `predictors`: against the
// fastest mode, and against single rays. d.buffers.results: of the march of all rays, at least one.
void add_times(Row& row, const Point& point, const SsrmFrame& frame, const Tracer& tracer, Designs& d,
               const std::array<Predictor, 2>& predictors, uint64_t seed);

}  // namespace hybray::ssrm_speed_parts
