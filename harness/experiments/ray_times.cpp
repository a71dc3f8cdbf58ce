#include "harness/experiments/ray_times.h"

#include "core/ssrm/hybrid.h"
#include "harness/timing/interleaved.h"
#include "harness/timing/trace_mode_choice.h"

#include <numeric>

namespace hybray {
namespace {

// What timing writes to: of every bounce the same as the frame holds.
struct Work {
  DepthPyramid pyramid;
  std::optional<SlantedPyramid> slanted;
  std::vector<ssrm::MarchResults> results;
  std::vector<std::vector<uint32_t>> unresolved;
  std::vector<HitStream> hits;
  std::vector<std::vector<uint8_t>> occluded;

  explicit Work(const RayFrame& frame) : pyramid(frame.pyramid), slanted(frame.slanted) {
    for (const RayBounce& b : frame.bounces) {
      results.push_back(b.results);
      unresolved.push_back(b.unresolved);
      hits.emplace_back();
      occluded.emplace_back();
      if (frame.occlusion())
        occluded.back().resize(b.rays.size());
      else
        hits.back().resize(b.rays.size());
    }
  }
};

class RayTiming {
 public:
  RayTiming(const Tracer& tracer, const RayFrame& frame) : tracer_(tracer), frame_(frame), work_(frame) {}

  RayTimes run(std::optional<TraceMode> mode, int repeats, uint64_t seed) {
    choose_modes(mode, seed);
    std::vector<Variant> variants = {
        {"pyramid", [&] { build_pyramid(); }},
        {"ss", [&] { each([&](size_t b) { march(b); }); }},
        {"hw", [&] { each([&](size_t b) { trace_all(b, modes_[b]); }); }},
        {"unresolved",
         [&] { each([&](size_t b) { trace_list(b, frame_.bounces[b].unresolved, modes_left_[b]); }); }},
        {"hybrid", [&] { hybrid(modes_left_); }},
    };
    const std::vector<TraceMode> single(frame_.bounces.size(), TraceMode::single);
    if (!mode) {
      variants.push_back({"hw_single", [&] { each([&](size_t b) { trace_all(b, TraceMode::single); }); }});
      variants.push_back({"hybrid_single", [&] { hybrid(single); }});
    }
    InterleavedTimes times = time_interleaved(variants, repeats, seed);
    times.ms.resize(7);
    return {times.ms[0], times.ms[1], times.ms[2],   times.ms[3],       times.ms[4],
            times.ms[5], times.ms[6], names(modes_), names(modes_left_)};
  }

 private:
  template <class Body>
  void each(const Body& body) {
    for (size_t b = 0; b < frame_.bounces.size(); ++b) body(b);
  }

  void build_pyramid() {
    const View& view = frame_.gbuffer.view;
    // Marcher `plane` reads the first level alone of the flat pyramid.
    work_.pyramid.build(frame_.gbuffer.depth, view.depth_sign(), view.background_depth(),
                        work_.slanted ? 1 : DepthPyramid::kAllLevels);
    if (work_.slanted)
      work_.slanted->build(frame_.gbuffer.depth, frame_.gbuffer.depth_derivatives, view.depth_sign(),
                           view.background_depth());
  }
  void march(size_t b) {
    const RayBounce& bounce = frame_.bounces[b];
    const ssrm::DepthView depth{work_.pyramid, frame_.gbuffer.depth_derivatives,
                                frame_.gbuffer.view.depth_sign(), work_.slanted ? &*work_.slanted : nullptr};
    ssrm::march(depth, bounce.screen_rays, bounce.rays.pixel, frame_.march, work_.results[b]);
  }
  void trace_all(size_t b, TraceMode mode) {
    const RayBounce& bounce = frame_.bounces[b];
    if (frame_.occlusion())
      tracer_.occlude(bounce.rays, bounce.lengths, work_.occluded[b], mode);
    else
      tracer_.trace(bounce.rays, work_.hits[b], mode);
  }
  void trace_list(size_t b, std::span<const uint32_t> which, TraceMode mode) {
    const RayBounce& bounce = frame_.bounces[b];
    if (which.empty()) return;
    if (frame_.occlusion())
      tracer_.occlude_some(bounce.rays, bounce.lengths, which, work_.occluded[b], mode);
    else
      tracer_.trace_some(bounce.rays, which, work_.hits[b], mode);
  }
  void hybrid(const std::vector<TraceMode>& modes) {
    build_pyramid();
    each([&](size_t b) {
      march(b);
      ssrm::compact_unresolved(work_.results[b], work_.unresolved[b]);
      trace_list(b, work_.unresolved[b], modes[b]);
    });
  }

  void choose_modes(std::optional<TraceMode> mode, uint64_t seed) {
    each([&](size_t b) {
      if (mode) {
        modes_.push_back(*mode), modes_left_.push_back(*mode);
        return;
      }
      const ListTrace trace = [&](std::span<const uint32_t> list, TraceMode m) { trace_list(b, list, m); };
      std::vector<uint32_t> all(frame_.bounces[b].rays.size());
      std::iota(all.begin(), all.end(), 0u);
      modes_.push_back(fastest_trace_mode(all, trace, seed));
      modes_left_.push_back(fastest_trace_mode(frame_.bounces[b].unresolved, trace, seed));
    });
  }

  static std::string names(const std::vector<TraceMode>& modes) {
    std::string text = label(modes.front());
    for (size_t b = 1; b < modes.size(); ++b) text += std::string(" ") + label(modes[b]);
    return text;
  }

  const Tracer& tracer_;
  const RayFrame& frame_;
  Work work_;
  std::vector<TraceMode> modes_, modes_left_;  // by bounce: of all rays, and of the unresolved
};

}  // namespace

RayTimes time_rays(const Tracer& tracer, const RayFrame& frame, std::optional<TraceMode> mode, int repeats,
                   uint64_t seed) {
  return RayTiming(tracer, frame).run(mode, repeats, seed);
}

RayEstimates estimate(const RayFrame& frame, const RayTimes& times) {
  RayEstimates e;
  for (size_t r = 0; r < times.hw.size(); ++r) {
    const ssrm::HybridEstimate formula = ssrm::estimate_hybrid(frame.alpha(), times.ss[r], times.hw[r]);
    e.sequential.push_back(formula.sequential);
    e.partitioned.push_back(formula.partitioned);
    e.conditional.push_back(times.ss[r] + times.unresolved[r]);
    e.cost_per_ray.push_back(times.hw[r] / static_cast<double>(frame.rays));
    if (frame.unresolved > 0)
      e.cost_per_unresolved.push_back(times.unresolved[r] / static_cast<double>(frame.unresolved));
  }
  return e;
}

}  // namespace hybray
