// Pyramid, marcher, compaction, and every mode of the general tracer, on the same rays.
#include "bench/bench_view.h"

#include <benchmark/benchmark.h>

namespace hybray::bench {
namespace {

using State = benchmark::State;
using ssrm::MarchCode;
using ssrm::Marcher;

// Wall time of `kernel`, with the time for one of `items` as a counter.
template <class Kernel>
void measure(State& state, size_t items, const Kernel& kernel) {
  for (auto _ : state) kernel();
  state.counters["per_item"] =
      benchmark::Counter(static_cast<double>(items),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void register_kernel(const std::string& name, const std::string& scene, void (*run)(State&, BenchView&)) {
  benchmark::RegisterBenchmark((name + "/" + scene).c_str(),
                               [=](State& state) { run(state, bench_view(scene)); })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

void pyramid(State& state, BenchView& v) {
  measure(state, v.gbuffer.depth.size(),
          [&] { v.pyramid.build(v.gbuffer.depth, v.view.depth_sign(), v.view.background_depth()); });
}
void projection(State& state, BenchView& v) {
  measure(state, v.rays.size(),
          [&] { benchmark::DoNotOptimize(ssrm::project_rays(v.rays, v.view, v.scene.bounds)); });
}
void slanted_pyramid(State& state, BenchView& v) {
  measure(state, v.gbuffer.depth.size(), [&] {
    v.slanted.build(v.gbuffer.depth, v.gbuffer.depth_derivatives, v.view.depth_sign(),
                    v.view.background_depth());
  });
}
template <ssrm::Marcher kMarcher, ssrm::MarchCode kCode>
void march(State& state, BenchView& v) {
  const ssrm::MarchOptions options{.code = kCode, .marcher = kMarcher};
  measure(state, v.rays.size(),
          [&] { ssrm::march(v.depth(), v.screen_rays, v.rays.pixel, options, v.buffers.results); });
  state.counters["steps_per_ray"] =
      static_cast<double>(v.buffers.results.steps) / static_cast<double>(v.rays.size());
}
void compaction(State& state, BenchView& v) {
  measure(state, v.rays.size(), [&] { ssrm::compact_unresolved(v.buffers.results, v.buffers.unresolved); });
}
template <TraceMode kMode>
void trace_all(State& state, BenchView& v) {
  measure(state, v.rays.size(), [&] { v.tracer.trace(v.rays, v.hits, kMode); });
}
template <TraceMode kMode>
void trace_unresolved(State& state, BenchView& v) {
  measure(state, v.buffers.unresolved.size(),
          [&] { v.tracer.trace_some(v.rays, v.buffers.unresolved, v.hits, kMode); });
}

template <TraceMode kMode>
void register_mode(const std::string& scene) {
  register_kernel(std::string("TraceAll/") + label(kMode), scene, trace_all<kMode>);
  register_kernel(std::string("TraceUnresolved/") + label(kMode), scene, trace_unresolved<kMode>);
}

}  // namespace

void register_ssrm() {
  for (const std::string& scene : bench_scenes()) {
    register_kernel("DepthPyramid", scene, pyramid);
    register_kernel("ProjectRays", scene, projection);
    register_kernel("SlantedPyramid", scene, slanted_pyramid);
    register_kernel("MarchPaper", scene, march<Marcher::paper, MarchCode::scalar>);
    register_kernel("MarchPaperLanes", scene, march<Marcher::paper, MarchCode::lanes>);
    register_kernel("MarchPlane", scene, march<Marcher::plane, MarchCode::scalar>);
    register_kernel("MarchPlaneLanes", scene, march<Marcher::plane, MarchCode::lanes>);
    register_kernel("Compaction", scene, compaction);
    register_mode<TraceMode::single>(scene);
    register_mode<TraceMode::packet4>(scene);
    register_mode<TraceMode::packet8>(scene);
    register_mode<TraceMode::packet16>(scene);
    register_mode<TraceMode::packet4_coherent>(scene);
    register_mode<TraceMode::packet8_coherent>(scene);
    register_mode<TraceMode::packet16_coherent>(scene);
  }
}

}  // namespace hybray::bench
