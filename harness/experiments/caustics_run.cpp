// One point of `caustics`: frames, errors, the account of the flux, times.
#include "core/base/parallel.h"
#include "core/metrics/error_bootstrap.h"
#include "core/metrics/image_error.h"
#include "harness/experiments/caustics.h"
#include "harness/experiments/caustics_closed_form.h"
#include "harness/experiments/caustics_display_error.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/workspace.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hybray::caustics_parts {
namespace {

using namespace caustics;

void add_keys(Row& row, const Point& point, const Setup& setup) {
  for (const char* name : {"scene", "camera", "emission", "first_surface", "visibility", "mixed", "filter"})
    row[name] = point.text(name);
  for (const char* name : {"map_resolution", "mirror_depth", "camera_paths", "frames"})
    row[name] = point.integer(name);
  for (const char* name : {"rays_per_texel", "gather_radius", "roulette_threshold"})
    row[name] = point.number(name);
  row["caustics"] = point.boolean("caustics");
  row["width"] = int64_t{setup.view.width()};
  row["height"] = int64_t{setup.view.height()};
  row["lights_visible"] = setup.lights_visible;
  row["lights_invisible"] = setup.lights_invisible;
  row["triangles"] = static_cast<int64_t>(setup.scene.triangle_count());
  row["threads"] = int64_t{thread_count()};
}

// What the frames have in common with one another: sums of their accounts.
struct FrameSums {
  FluxLedger ledger;
  SplatCounts splat;
  std::vector<double> emitted;  // by frame
  double peak = 0.0;
  uint64_t overflows = 0, mismatches = 0;

  void add(const Frame& frame) {
    ledger.add(frame.paths.list.counts.ledger);
    splat.add(frame.splat);
    emitted.push_back(frame.paths.list.counts.ledger.emitted);
    peak = std::max(peak, frame.accumulator_peak);
    overflows += frame.overflows;
    mismatches += frame.paths.list.counts.medium_mismatches;
  }
};

void add_ledger(Row& row, const FrameSums& sums, const MapSet& maps, bool uniform) {
  const FluxLedger& l = sums.ledger;
  const double frames = static_cast<double>(sums.emitted.size());
  row["emitted_flux"] = l.emitted / frames;
  if (!(l.emitted > 0.0)) return;
  row["deposited_fraction"] = l.deposited / l.emitted;
  row["direct_fraction"] = l.direct / l.emitted;
  row["absorbed_fraction"] = l.absorbed / l.emitted;
  row["escaped_fraction"] = l.escaped / l.emitted;
  row["truncated_fraction"] = l.truncated / l.emitted;
  row["roulette_fraction"] = l.balance / l.emitted;
  row["ledger_residual_fraction"] = std::abs(l.emitted - l.total()) / l.emitted;
  if (l.deposited > 0.0) {
    row["offscreen_fraction"] = sums.splat.offscreen / l.deposited;
    row["depth_rejected_fraction"] = sums.splat.rejected / l.deposited;
  }
  if (uniform) {
    if (sums.splat.landed > 0.0) row["missed_by_map_fraction"] = sums.splat.missed_by_map / sums.splat.landed;
    return;
  }
  double covered = 0.0;
  for (const VisibilityMap& map : maps.maps) covered += map.covered_flux;
  row["covered_flux"] = covered;
  double square = 0.0;
  const double mean = l.emitted / frames;
  for (const double e : sums.emitted) square += (e - mean) * (e - mean);
  const double error = std::sqrt(square / (frames * (frames - 1.0)));
  // At whole rays per texel the flux differs between frames by rounding alone; a deviation is then one of
  // rounding or of the map itself, whose texels are held against the flux that passes them.
  const double floor = 1e-6 * covered;
  row["emitted_flux_z"] = (mean - covered) / std::max(error, floor);
}

void add_work(Row& row, const Frame& frame, const Setup& setup, const MapSet& maps) {
  const PhotonList& list = frame.paths.list;
  row["paths"] = static_cast<int64_t>(list.paths);
  row["rays_traced"] = static_cast<int64_t>(list.counts.rays + frame.mixed_rays);
  row["photons"] = static_cast<int64_t>(list.photons.size());
  row["visibility_points"] = static_cast<int64_t>(frame.visibility_points);
  row["photon_pairs"] = static_cast<int64_t>(frame.pairs);
  row["texels_used_fraction"] = share(maps.texels_used, maps.texels_total);
  row["texels_traced_fraction"] = share(maps.texels_traced, maps.texels_total);
  row["lights_skipped"] = int64_t{maps.lights_skipped};
  if (setup.pass.mixed)
    row["mixed_pixels_skipped"] = static_cast<int64_t>(setup.gbuffer.depth.size() - frame.mixed_pixels);
}

}  // namespace

Row run(const Point& point, Workspace& workspace) {
  const Setup setup = make_setup(point, workspace);
  const bool timing = workspace.settings().timing;
  const int repeats = static_cast<int>(point.integer("repeats"));
  Row row;
  add_keys(row, point, setup);
  const bool picture = point.boolean("picture");
  if (!point.boolean("caustics")) {
    if (picture) write_pictures(point, workspace, setup, {}, nullptr, {});
    if (timing) add_main_view_time(row, setup, repeats, workspace.settings().seed);
    return row;
  }

  const MapSet maps = make_maps(setup.caustic_scene, setup.pass);
  // The first frame comes before the reference, which takes long: what no frame can be made of shows at once.
  std::optional<Frame> frame = make_frame(setup, maps, 0);
  add_work(row, *frame, setup, maps);
  const Reference* truth = nullptr;
  if (point.number("reference_paths") > 0.0) {
    truth = &reference(point, workspace, setup);
    row["reference_batches"] = static_cast<int64_t>(truth->batches.size());
    row["reference_rays"] = static_cast<int64_t>(truth->rays);
    if (truth->landed > 0.0) row["reference_missed_by_map_fraction"] = truth->missed_by_map / truth->landed;
    if (!truth->exposures) truth = nullptr;  // no caustic in sight: nothing is relative to it
  }
  std::optional<metrics::ErrorBootstrap> errors;
  std::optional<DisplayErrors> display;
  if (truth) {
    errors.emplace(truth->batches);
    display.emplace(truth->image.mean, *truth->exposures);
  }
  ClosedFormTally closed_form(setup.scene, setup.pass.walk.max_events);

  FrameSums sums;
  Image2D<vec3> first;
  const int64_t frames = point.integer("frames");
  double rmse = 0.0, smape = 0.0, median_error = 0.0;
  for (int64_t f = 0; f < frames; ++f) {
    if (!frame) frame = make_frame(setup, maps, static_cast<uint32_t>(f));
    if (errors) {
      errors->add(frame->image);
      const metrics::ImageError error = metrics::image_error(frame->image, truth->image);
      rmse += error.rmse / static_cast<double>(frames);
      smape += error.smape / static_cast<double>(frames);
      median_error += error.median_relative_error / static_cast<double>(frames);
      display->add(frame->image);
    }
    closed_form.add(frame->paths.list.photons);
    sums.add(*frame);
    if (f == 0) first = std::move(frame->image);
    frame.reset();  // photons of two frames are never in memory at once
  }
  add_ledger(row, sums, maps, setup.pass.emission == EmissionKind::uniform);
  row["medium_mismatches"] = static_cast<int64_t>(sums.mismatches);
  row["accumulator_peak_fraction"] = sums.peak;
  row["accumulator_overflows"] = static_cast<int64_t>(sums.overflows);
  closed_form.report(row);
  if (errors) {
    const metrics::ErrorIntervals e = errors->intervals(workspace.settings().seed);
    const double own = e.reference_relmse + truth->bias_relmse;
    put_interval(row, "relmse", e.relmse);
    put_interval(row, "energy_ratio", e.energy_ratio);
    row["rmse"] = rmse;
    row["smape"] = smape;
    row["median_relative_error"] = median_error;
    row["relmse_debiased"] = e.relmse.value - own;
    row["reference_relmse"] = own;
    row["reference_bias_relmse"] = truth->bias_relmse;
    row["at_floor"] = metrics::at_floor(e.relmse.value, own);
    display->report(row);
  }
  if (picture)
    write_pictures(point, workspace, setup, first, truth, display ? display->flip() : Image2D<float>());
  if (timing) add_times(row, setup, maps, repeats, workspace.settings().seed);
  return row;
}

}  // namespace hybray::caustics_parts
