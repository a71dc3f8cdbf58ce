// One point of `stability_caustics`: frames, the closed form, what leaked, and what met the wrong side.
#include "core/base/error.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/stability_caustics.h"
#include "harness/experiments/workspace.h"

#include <cmath>

namespace hybray::stability_caustics_parts {
namespace {

using namespace caustics;

PassSettings pass_settings(const Point& point, uint64_t seed) {
  PassSettings s;
  s.map_resolution = static_cast<int>(point.integer("map_resolution"));
  s.rays_per_texel = point.number("rays_per_texel");
  s.emission = point.text("emission") == "uniform" ? EmissionKind::uniform : EmissionKind::map;
  s.first_surface = FirstSurface::traced;
  s.walk.max_events = static_cast<int>(point.integer("mirror_depth"));
  s.walk.leaving =
      point.text("leaving_offset") == "largest" ? LeavingOffset::largest : LeavingOffset::along_normal;
  s.walk.seed = seed;
  s.lights = {0};
  return s;
}

void add_keys(Row& row, const Point& point) {
  for (const char* name : {"body", "origin", "leaving_offset", "emission"}) row[name] = point.text(name);
  for (const char* name : {"map_resolution", "mirror_depth", "frames"}) row[name] = point.integer(name);
  for (const char* name : {"ior", "scale", "rays_per_texel"}) row[name] = point.number(name);
  row["thickness_m"] = point.number("thickness");
  row["incidence_degrees"] = point.number("incidence");
  row["turn_degrees"] = point.number("turn");
  row["offset_m"] = point.number("offset");
  row["robust"] = point.boolean("robust");
}

bool is_sound(const Photon& photon) {
  for (int c = 0; c < 3; ++c)
    if (!std::isfinite(photon.position[c]) || !std::isfinite(photon.direction[c]) ||
        !std::isfinite(photon.flux[c]) || photon.flux[c] < 0.0f)
      return false;
  return std::isfinite(photon.cos_in) && photon.cos_in >= 0.0f;
}

// Accounts of all frames together.
struct Sums {
  WalkCounts counts;
  uint64_t paths = 0, unsound = 0;

  void add(const LightPaths& frame) {
    counts.add(frame.list.counts);
    paths += frame.list.paths;
    frame.list.photons.for_each([&](const Photon& photon) { unsound += !is_sound(photon); });
  }
};

void add_account(Row& row, const Body& body, const Sums& sums, int64_t frames) {
  const FluxLedger& l = sums.counts.ledger;
  row["paths"] = static_cast<int64_t>(sums.paths) / frames;
  row["medium_mismatches"] = static_cast<int64_t>(sums.counts.medium_mismatches);
  row["medium_mismatch_fraction"] = share(sums.counts.medium_mismatches, sums.paths);
  row["negative_or_nan"] = static_cast<int64_t>(sums.unsound);
  if (!(l.emitted > 0.0)) return;
  if (body.closed)
    row["leaked_fraction"] = (l.escaped + (body.dark ? l.deposited + l.direct : 0.0)) / l.emitted;
  row["escaped_fraction"] = l.escaped / l.emitted;
  row["truncated_fraction"] = l.truncated / l.emitted;
  row["ledger_residual_fraction"] = std::abs(l.emitted - l.total()) / l.emitted;
}

void add_audit(Row& row, const Body& body, const CausticScene& scene, const PathAudit& audit) {
  row["self_intersections"] = static_cast<int64_t>(audit.self_intersections);
  row["self_intersection_fraction"] = share(audit.self_intersections, audit.segments);
  if (body.dark || body.receiver_ior == 0.0f) return;
  double all = 0.0, right = 0.0;
  for (size_t m = 0; m < audit.arrived.size(); ++m) {
    all += audit.arrived[m];
    if (scene.optics.media[m].ior == static_cast<double>(body.receiver_ior)) right += audit.arrived[m];
  }
  if (all > 0.0) row["wrong_medium_fraction"] = 1.0 - right / all;
}

void trace(Row& row, const Point& point, uint64_t seed) {
  const Body body = make_body(point);
  row["collapsed_triangles"] = static_cast<int64_t>(body.collapsed);
  const Tracer tracer(body.scene, {.robust = point.boolean("robust"), .high_quality = true});
  const CausticScene scene(tracer);
  const PassSettings pass = pass_settings(point, seed);
  const MapSet maps = make_maps(scene, pass);
  RegionTally regions(body);
  std::optional<DensityTally> densities;
  if (point.text("body") == "grazed_receiver" && body.form) densities.emplace(point, body, tracer, scene);

  Sums sums;
  LightPaths paths;
  const int64_t frames = point.integer("frames");
  for (int64_t f = 0; f < frames; ++f) {
    trace_light_paths(scene, pass, maps, static_cast<uint32_t>(f), paths);
    sums.add(paths);
    regions.add(paths.list.photons);
    if (densities) densities->add(paths);
  }
  add_account(row, body, sums, frames);
  add_audit(row, body, scene, audit_light_paths(scene, pass, maps, 0));
  regions.report(row);
  if (densities) densities->report(row);
}

}  // namespace

Row run(const Point& point, Workspace& workspace) {
  Row row;
  add_keys(row, point);
  const uint64_t seed = workspace.settings().seed;
  if (point.text("body") == "interface") {
    add_interface(row, point, seed);
    return row;
  }
  try {
    trace(row, point, seed);
  } catch (const InputError& error) {
    // Rounding can leave a scene that is none: that, too, is where the method ends.
    row["refused"] = std::string(error.what());
  }
  return row;
}

}  // namespace hybray::stability_caustics_parts
