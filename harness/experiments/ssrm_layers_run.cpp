// One point of `ssrm_layers`: band, layers, march, verdicts, times.
#include "core/gbuffer/guard_band.h"
#include "core/metrics/statistics.h"
#include "core/ssrm/confirm_hits.h"
#include "core/ssrm/hybrid.h"
#include "core/ssrm/march_layers.h"
#include "core/truth/layer_visibility.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/ssrm_frame.h"
#include "harness/experiments/ssrm_layers.h"
#include "harness/experiments/ssrm_picture.h"
#include "harness/timing/interleaved.h"
#include "harness/timing/trace_mode_choice.h"

#include <numeric>

namespace hybray::ssrm_layers_parts {
namespace {

using ssrm::Verdict;

// What marching needs of the main view's buffers.
GBuffer march_buffers(const GBuffer& main) {
  GBuffer g(main.view);
  g.depth = main.depth, g.depth_derivatives = main.depth_derivatives, g.primitive = main.primitive;
  g.covered_pixels = main.covered_pixels;
  return g;
}

GBuffer first_layer(const SsrmSetup& setup, const GBuffer& main, ivec2 margin) {
  GBuffer g = with_guard_band(setup.robust, main, margin);
  if (setup.difference) g.depth_derivatives = difference_derivatives(g.depth);
  return g;
}

ssrm::FreeSpace free_space(const std::string& name) {
  if (name == "any") return ssrm::FreeSpace::any;
  return name == "closed" ? ssrm::FreeSpace::closed : ssrm::FreeSpace::not_solids;
}

struct LayeredFrame {
  ivec2 margin;
  bool min_max;
  ssrm::LayerOptions options;
  bool confirm;
  const Scene& scene;
  const Tracer& layered;
  const RayStream& rays;
  GBuffer first;
  DepthLayers layers;
  DepthPyramid pyramid;
  std::unique_ptr<ssrm::SlotPyramid> slots;
  ssrm::ScreenRays screen_rays;
  std::vector<uint32_t> pixels;  // of the rays, in the larger view

  LayeredFrame(const Point& point, const SsrmSetup& setup, const Tracer& layered_tracer,
               const SsrmFrame& main)
      : margin(guard_band(setup.view.width(), point.number("guard_band")),
               guard_band(setup.view.height(), point.number("guard_band"))),
        min_max(point.boolean("min_max")),
        options{free_space(point.text("free_space")), point.boolean("march_on")},
        confirm(point.boolean("confirm")),
        scene(setup.scene),
        layered(layered_tracer),
        rays(main.rays()),
        first(first_layer(setup, march_buffers(main.gbuffer), margin)),
        layers(make_depth_layers(layered, first, static_cast<int>(point.integer("layers")))),
        pyramid(first.view.width(), first.view.height()),
        screen_rays(ssrm::project_rays(main.rays(), first.view, setup.scene.bounds)),
        pixels(main.rays().pixel) {
    build_pyramid();
    build_slots();
    const auto width = static_cast<uint32_t>(setup.view.width()),
               large = static_cast<uint32_t>(first.view.width());
    for (uint32_t& p : pixels)
      p = (p / width + static_cast<uint32_t>(margin.y)) * large + p % width + static_cast<uint32_t>(margin.x);
  }

  void build_pyramid() { pyramid.build(first.depth, first.view.depth_sign(), first.view.background_depth()); }
  bool has_slots() const { return min_max && layers.count() > 1; }
  void build_slots() {
    if (has_slots()) slots = std::make_unique<ssrm::SlotPyramid>(depth(), layers, options.free_space);
  }
  ssrm::DepthView depth() const { return {pyramid, first.depth_derivatives, first.view.depth_sign()}; }
  ssrm::LayeredView view() const { return {depth(), first.primitive, layers, slots.get()}; }
  size_t memory_bytes() const {
    return first.memory_bytes() + layers.memory_bytes() + pyramid.memory_bytes() +
           (slots ? slots->memory_bytes() : 0);
  }
  void march(ssrm::LayerResults& results) const {
    march_layers(view(), screen_rays, pixels, options, results);
    if (confirm) confirm_late_hits(view(), first.view, scene, rays, screen_rays, results);
  }
  metrics::ClaimedSurface surface(const ssrm::LayerResults& results, size_t ray) const {
    const uint32_t pixel = results.march.pixel[ray], width = static_cast<uint32_t>(first.view.width());
    return {
        view().plane(results.layer[ray], static_cast<int>(pixel % width), static_cast<int>(pixel / width)),
        view().primitive_of(results.layer[ray], pixel)};
  }
  bool in_band(uint32_t pixel) const {
    const auto width = static_cast<uint32_t>(first.view.width());
    const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
    return x < margin.x || x >= first.view.width() - margin.x || y < margin.y ||
           y >= first.view.height() - margin.y;
  }
};

// Right HITs among those of one kind.
struct PartHits {
  uint64_t hits = 0, right = 0;
  void add(metrics::HitClass c) { ++hits, right += c == metrics::HitClass::right; }
};

void add_part_cells(Row& row, const LayeredFrame& frame, const ssrm::LayerResults& results,
                    const std::vector<metrics::HitClass>& classes, uint64_t hits) {
  PartHits further, band;
  for (size_t i = 0; i < classes.size(); ++i) {
    if (results.march.verdict[i] != Verdict::hit) continue;
    if (results.layer[i] > 0) further.add(classes[i]);
    if (frame.in_band(results.march.pixel[i])) band.add(classes[i]);
  }
  row["further_hit_fraction"] = share(further.hits, hits);
  row["further_precision"] = share(further.right, further.hits);
  row["band_hit_fraction"] = share(band.hits, hits);
  row["band_precision"] = share(band.right, band.hits);
}

void add_single_cells(Row& row, const SsrmSetup& setup, const JudgedFrame& main,
                      const ssrm::MarchResults& results, uint64_t hits) {
  const SsrmFrame& frame = main.frame;
  const metrics::VerdictTable single = metrics::judge(results, frame.depth(), frame.screen_rays, frame.rays(),
                                                      main.truth, frame.gbuffer, setup.scene, {});
  row["single_alpha"] = share(single.hits(), single.rays);
  row["single_precision"] = share(single.right, single.hits());
  row["single_alpha_max"] = share(single.visible_true_hits, single.rays);
  row["alpha_gain"] = share(hits, single.hits());
  row["single_steps_per_ray"] = share(results.steps, single.rays);
}

// `main.frame` has at least one ray.
void add_times(Row& row, const SsrmSetup& setup, const SsrmFrame& main, LayeredFrame& frame,
               ssrm::LayerResults& results, ssrm::HybridBuffers& single, const Tracer& tracer, int repeats,
               uint64_t seed) {
  const RayStream& rays = main.rays();
  const GBuffer inner = march_buffers(main.gbuffer);
  std::vector<uint32_t> all(rays.size()), unresolved;
  std::iota(all.begin(), all.end(), 0u);
  HitStream hits;
  hits.resize(rays.size());
  const auto fastest = [&](const std::vector<uint32_t>& which) {
    return fastest_trace_mode(tracer, rays, which, hits, seed);
  };
  const TraceMode mode = fastest(all);
  ssrm::compact_unresolved(results.march, unresolved);
  const TraceMode mode_layers = fastest(unresolved);
  ssrm::compact_unresolved(single.results, unresolved);
  const TraceMode mode_single = fastest(unresolved);
  row["hw_mode"] = std::string(label(mode));
  std::vector<uint32_t>().swap(all);

  const bool banded = frame.margin != ivec2(0);
  const auto band = [&] {
    if (banded) frame.first = first_layer(setup, inner, frame.margin);
  };
  const auto layers = [&] {
    frame.layers = make_depth_layers(frame.layered, frame.first, frame.layers.count());
  };
  const auto hybrid = [&] {
    frame.build_pyramid();
    frame.march(results);
    ssrm::compact_unresolved(results.march, unresolved);
    tracer.trace_some(rays, unresolved, hits, mode_layers);
  };
  DepthPyramid single_pyramid(setup.view.width(), setup.view.height());
  const auto single_hybrid = [&] {
    single_pyramid.build(main.gbuffer.depth, setup.view.depth_sign(), setup.view.background_depth());
    ssrm::trace_hybrid(tracer, mode_single,
                       {single_pyramid, main.gbuffer.depth_derivatives, setup.view.depth_sign()}, rays,
                       main.screen_rays, {}, single);
  };
  enum {
    kGBuffer,
    kBand,
    kLayers,
    kPyramid,
    kSlots,
    kMarch,
    kSingleMarch,
    kHw,
    kHybrid,
    kStatic,
    kSingleHybrid
  };
  const Variant variants[] = {
      {"gbuffer", [&] { setup.make_buffers(); }},
      {"band", band},
      {"layers", layers},
      {"pyramid", [&] { frame.build_pyramid(); }},
      {"slots", [&] { frame.build_slots(); }},
      {"march", [&] { frame.march(results); }},
      {"single_march", [&] { ssrm::march(main.depth(), main.screen_rays, rays.pixel, {}, single.results); }},
      {"t_hw", [&] { tracer.trace(rays, hits, mode); }},
      {"t_hybrid",
       [&] {
         band();
         layers();
         frame.build_slots();
         hybrid();
       }},
      {"t_hybrid_static", hybrid},
      {"t_hybrid_single_layer", single_hybrid},
  };
  const InterleavedTimes times = time_interleaved(variants, repeats, seed);
  for (size_t v = 0; v < std::size(variants); ++v) put_time(row, variants[v].name, times.of(v));
  put_ratio(row, "speedup_over_single_layer", times.of(kSingleHybrid), times.of(kHybrid), seed);
  put_ratio(row, "speedup_measured", times.of(kHw), times.of(kHybrid), seed);
  put_ratio(row, "speedup_static", times.of(kHw), times.of(kStatic), seed);
  put_ratio(row, "speedup_single_layer", times.of(kHw), times.of(kSingleHybrid), seed);
  row["repeats"] = int64_t{repeats};
}

// What the layers see inside the band, in place of what the main view sees.
truth::RayTruth layered_truth(const JudgedFrame& main, const LayeredFrame& frame) {
  truth::RayTruth truth = main.truth;
  const std::vector<uint8_t> layer = truth::layers_of_hits(frame.layered, main.frame.rays(), truth.hits,
                                                           frame.first.view, frame.layers.count());
  for (size_t i = 0; i < layer.size(); ++i) truth.visible[i] = layer[i] != truth::kNotSeen;
  return truth;
}

}  // namespace

Row run(const Point& point, Workspace& workspace) {
  const SsrmSetup setup(point, workspace);
  const JudgedFrame& main = shared_frame(point, workspace);
  const RayStream& rays = main.frame.rays();
  LayeredFrame frame(point, setup, workspace.layered_tracer(point.text("scene")), main.frame);
  Row row;
  add_view_cells(row, point, setup, main.frame);
  row["layers"] = point.integer("layers");
  row["guard_band"] = point.number("guard_band");
  row["free_space"] = point.text("free_space");
  for (const char* name : {"march_on", "confirm", "min_max"}) row[name] = point.boolean(name);
  row["band_width_px"] = int64_t{frame.margin.x};
  row["band_height_px"] = int64_t{frame.margin.y};
  row["buffer_bytes"] = static_cast<int64_t>(frame.memory_bytes());
  row["single_buffer_bytes"] = static_cast<int64_t>(march_buffers(main.frame.gbuffer).memory_bytes() +
                                                    main.frame.pyramid.memory_bytes());

  ssrm::LayerResults results;
  results.resize(rays.size());
  frame.march(results);
  row["steps_per_ray"] = share(results.march.steps, rays.size());
  std::vector<metrics::HitClass> classes;
  const metrics::VerdictTable table = metrics::judge(
      results.march, [&](size_t i) { return frame.surface(results, i); }, frame.depth(), frame.screen_rays,
      rays, layered_truth(main, frame), frame.first.view, setup.scene, {}, &classes);
  add_verdict_cells(row, table);
  add_part_cells(row, frame, results, classes, table.hits());
  if (point.boolean("picture"))
    write_verdict_picture(point, workspace, main.frame.gbuffer, setup.scene, rays, results.march, classes,
                          frame.first.view, [&](size_t i) { return frame.surface(results, i).primitive; });

  ssrm::HybridBuffers single(rays.size());
  ssrm::march(main.frame.depth(), main.frame.screen_rays, rays.pixel, {}, single.results);
  add_single_cells(row, setup, main, single.results, table.hits());
  if (workspace.settings().timing && rays.size() > 0)
    add_times(row, setup, main.frame, frame, results, single, workspace.tracer(point.text("scene")),
              static_cast<int>(point.integer("repeats")), workspace.settings().seed);
  return row;
}

}  // namespace hybray::ssrm_layers_parts
