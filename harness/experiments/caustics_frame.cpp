// Frames of the method: one after the other for errors, stage by stage for times.
#include "core/base/check.h"
#include "core/caustics/wavelet_filter.h"
#include "core/metrics/statistics.h"
#include "harness/experiments/caustics.h"
#include "harness/experiments/cells.h"
#include "harness/timing/interleaved.h"

#include <algorithm>

namespace hybray::caustics_parts {
namespace {

using namespace caustics;

void add(Image2D<vec3>& sum, const FixedPointImage& part) {
  if (part.empty()) return;
  const Image2D<vec3> image = part.image();
  for (size_t i = 0; i < sum.size(); ++i) sum[i] += image[i];
}

Image2D<vec3> combined(const Setup& setup, const DirectResult& direct, const MixedResult& mixed) {
  Image2D<vec3> image(setup.view.width(), setup.view.height());
  add(image, direct.image);
  add(image, mixed.image);
  return image;
}

}  // namespace

Image2D<vec3> filtered(const Setup& setup, const Image2D<vec3>& image) {
  Image2D<vec3> albedo(image.width(), image.height());
  for (size_t i = 0; i < albedo.size(); ++i)
    if (setup.gbuffer.primitive[i] != kNoPrimitive)
      albedo[i] = setup.scene.materials[setup.gbuffer.material[i]].base_color;
  return filter_wavelet(image, setup.gbuffer, {}, &albedo);
}

Frame make_frame(const Setup& setup, const MapSet& maps, uint32_t sample) {
  Frame frame;
  frame.paths = trace_light_paths(setup.caustic_scene, setup.pass, maps, sample);
  const DirectResult direct = deposit(setup.caustic_scene, setup.pass, setup.gbuffer, frame.paths);
  const MixedResult mixed =
      add_mixed(setup.caustic_scene, setup.pass, setup.gbuffer, setup.camera_medium, frame.paths, sample);
  frame.image = combined(setup, direct, mixed);
  if (setup.filter && !frame.paths.list.photons.empty()) frame.image = filtered(setup, frame.image);
  frame.splat = direct.counts;
  frame.mixed_rays = mixed.rays;
  frame.mixed_pixels = mixed.pixels;
  frame.visibility_points = mixed.points;
  frame.pairs = mixed.counts.pairs;
  frame.accumulator_peak = std::max(direct.image.peak_fraction(), mixed.image.peak_fraction());
  frame.overflows = direct.image.overflows() + mixed.image.overflows();
  return frame;
}

void add_times(Row& row, const Setup& setup, const MapSet& maps, int repeats, uint64_t seed) {
  const CausticScene& scene = setup.caustic_scene;
  const PassSettings& pass = setup.pass;
  const LightPaths paths = trace_light_paths(scene, pass, maps, 0);
  LightPaths again;  // as from frame to frame, photons keep their memory
  const DirectResult direct = deposit(scene, pass, setup.gbuffer, paths);
  const MixedResult mixed = add_mixed(scene, pass, setup.gbuffer, setup.camera_medium, paths, 0);
  const Image2D<vec3> image = combined(setup, direct, mixed);

  const auto main_view = [&] { return make_gbuffer(setup.robust, setup.view, setup.bits); };
  const auto whole_pass = [&](const GBuffer& gbuffer) {
    if (!scene.optics.any_specular) return;
    const MapSet own = make_maps(scene, pass);
    if (own.maps.empty()) return;
    trace_light_paths(scene, pass, own, 0, again);
    const DirectResult own_direct = deposit(scene, pass, gbuffer, again);
    const MixedResult own_mixed = add_mixed(scene, pass, gbuffer, setup.camera_medium, again, 0);
    Image2D<vec3> result = combined(setup, own_direct, own_mixed);
    if (setup.filter) result = filtered(setup, result);
  };
  enum { kGBuffer, kMap, kTrace, kSplat, kMixed, kFilter, kTotal, kAll };
  const Variant variants[] = {
      {"gbuffer", [&] { main_view(); }},
      {"map", [&] { make_maps(scene, pass); }},
      {"emit_trace", [&] { trace_light_paths(scene, pass, maps, 0, again); }},
      {"splat", [&] { deposit(scene, pass, setup.gbuffer, paths); }},
      {"photonmap", [&] { add_mixed(scene, pass, setup.gbuffer, setup.camera_medium, paths, 0); }},
      {"filter",
       [&] {
         if (setup.filter && !paths.list.photons.empty()) filtered(setup, image);
       }},
      {"total", [&] { whole_pass(setup.gbuffer); }},
      {"all", [&] { whole_pass(main_view()); }},
  };
  const InterleavedTimes times = time_interleaved(variants, repeats, seed);
  for (size_t v = 0; v < kAll; ++v) put_time(row, variants[v].name, times.of(v));
  put_ratio(row, "main_view_ratio", times.of(kAll), times.of(kGBuffer), seed);
  const double trace_ms = metrics::median(times.of(kTrace)), total_ms = metrics::median(times.of(kTotal));
  if (paths.list.counts.rays > 0)
    row["rays_per_second"] = static_cast<double>(paths.list.counts.rays) / (1e-3 * trace_ms);
  if (const auto relmse = row.find("relmse"); relmse != row.end())
    row["efficiency"] = 1.0 / (std::get<double>(relmse->second) * 1e-3 * total_ms);
  row["repeats"] = int64_t{repeats};
}

void add_main_view_time(Row& row, const Setup& setup, int repeats, uint64_t seed) {
  const Variant variants[] = {{"gbuffer", [&] { make_gbuffer(setup.robust, setup.view, setup.bits); }}};
  put_time(row, "gbuffer", time_interleaved(variants, repeats, seed).of(0));
  row["repeats"] = int64_t{repeats};
}

}  // namespace hybray::caustics_parts
