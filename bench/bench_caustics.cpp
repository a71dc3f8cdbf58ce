// Forward tracing of caustic paths beside the bare tracer on the very same rays, in every mode, and the other
// stages of the pass. Compare the faster ForwardTrace with the fastest BareTrace of its scene; run with
// --benchmark_enable_random_interleaving=true.
#include "core/base/parallel.h"
#include "core/caustics/caustic_pass.h"
#include "core/optics/specular_step.h"
#include "core/scene/scene_library.h"

#include <map>
#include <memory>

#include <benchmark/benchmark.h>

namespace hybray::bench {
namespace {

using namespace caustics;
using State = benchmark::State;

constexpr double kRaysPerTexel = 1.0;
constexpr size_t kBlock = PathFront::kSize;

// Rays of one front, as the walk handed them to the tracer.
struct Batch {
  RayBatch<PathFront::kAllocated> rays;
  size_t count;
};

struct CausticBench {
  explicit CausticBench(const std::string& name)
      : scene(load_scene(default_scene_paths(HYBRAY_PROJECT_DIR), name)), tracer(scene, {}), caustic(tracer) {
    for (uint32_t i = 0; i < scene.lights.size(); ++i) settings.lights.push_back(i);
    settings.first_surface = FirstSurface::traced;
    settings.rays_per_texel = kRaysPerTexel;
    settings.walk.max_events = 4;
    maps = make_maps(caustic, settings);
    record();
  }

  // Walks all paths once more, keeping every ray in the order of the walk.
  void record() {
    WalkCounts counts;
    const auto memory = std::make_unique<WalkMemory>();
    for (const VisibilityMap& map : maps.maps) {
      const Emission emission(scene.lights[map.light], map, scene.bounds, settings.emission,
                              expected_paths(map, settings.emission, settings.rays_per_texel), 1);
      for (uint64_t first = 0; first < emission.paths(); first += kBlock) {
        PathWalk walk(tracer, caustic.optics, settings.walk, counts);
        for (uint64_t i = first; i < std::min(first + kBlock, emission.paths()); ++i) {
          const PathStart start = emission.start(i);
          Path path;
          path.weight = start.flux;
          path.initial = optics::mean(start.flux);
          path.number = i;
          path.medium = caustic.light_media[map.light];
          memory->front().push(start.origin, start.direction, path);
        }
        while (const size_t count = memory->front().count) {
          const PathFront& front = memory->front();
          batches.push_back({front.rays, count});
          rays += count;
          walk.advance(*memory);
        }
      }
    }
  }

  Scene scene;
  Tracer tracer;
  CausticScene caustic;
  PassSettings settings;
  MapSet maps;
  std::vector<Batch> batches;
  size_t rays = 0;
};

CausticBench& caustic_bench(const std::string& scene) {
  static std::map<std::string, std::unique_ptr<CausticBench>> all;
  auto& one = all[scene];
  if (!one) one = std::make_unique<CausticBench>(scene);
  return *one;
}

void per_second(State& state, size_t rays) {
  state.counters["rays_per_second"] =
      benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsIterationInvariantRate);
}

template <TraceMode kMode>
void forward_trace(State& state, CausticBench& b) {
  size_t rays = 0;
  PassSettings settings = b.settings;
  settings.walk.mode = kMode;
  LightPaths paths;  // whose memory is kept from frame to frame
  for (auto _ : state) {
    trace_light_paths(b.caustic, settings, b.maps, 0, paths);
    rays = paths.list.counts.rays;
  }
  per_second(state, rays);
}

template <TraceMode kMode>
void bare_trace(State& state, CausticBench& b) {
  for (auto _ : state)
    parallel_blocks(b.batches.size(), 1, [&](size_t begin, size_t) {
      const Batch& batch = b.batches[begin];
      HitBatch<PathFront::kAllocated> hits;
      b.tracer.intersect_batch(batch.rays.lanes(), batch.count, hits.lanes(), kMode);
      benchmark::DoNotOptimize(hits);
    });
  per_second(state, b.rays);
}

void maps(State& state, CausticBench& b) {
  for (auto _ : state) benchmark::DoNotOptimize(make_maps(b.caustic, b.settings));
}

void register_stage(const std::string& name, const std::string& scene, void (*run)(State&, CausticBench&)) {
  benchmark::RegisterBenchmark((name + "/" + scene).c_str(),
                               [=](State& state) { run(state, caustic_bench(scene)); })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

template <TraceMode kMode>
void register_forward(const std::string& scene) {
  register_stage(std::string("ForwardTrace/") + label(kMode), scene, forward_trace<kMode>);
}

template <TraceMode kMode>
void register_bare(const std::string& scene) {
  register_stage(std::string("BareTrace/") + label(kMode), scene, bare_trace<kMode>);
}

}  // namespace

void register_caustics() {
  for (const char* scene : {"atrium_lamps", "glass_ball", "wine_glass", "water_pool"}) {
    register_stage("VisibilityMaps", scene, maps);
    register_forward<TraceMode::packet16>(scene);
    register_forward<TraceMode::packet16_coherent>(scene);
    register_bare<TraceMode::single>(scene);
    register_bare<TraceMode::packet4>(scene);
    register_bare<TraceMode::packet8>(scene);
    register_bare<TraceMode::packet16>(scene);
    register_bare<TraceMode::packet8_coherent>(scene);
    register_bare<TraceMode::packet16_coherent>(scene);
  }
}

}  // namespace hybray::bench
