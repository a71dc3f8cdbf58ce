// One point of `stability`: the frame as it should be and as it is, ray by ray.
#include "core/base/parallel.h"
#include "core/metrics/statistics.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/stability.h"
#include "harness/experiments/stability_frame.h"
#include "harness/experiments/workspace.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace hybray::stability_parts {
namespace {

using metrics::HitClass;
using ssrm::Verdict;

std::string key_of(const Point& point, std::initializer_list<const char*> names) {
  std::string key;
  for (const char* name : names) key += to_text(point.parameters.at(name)) + ' ';
  return key;
}

// The scene where the point puts it, with what sees and traces it.
struct PlacedScene {
  Scene scene;
  std::unique_ptr<Tracer> robust, fast;

  PlacedScene(const Scene& original, const Pose& pose)
      : scene(posed(original, pose)),
        robust(std::make_unique<Tracer>(scene, Tracer::Config{.robust = true, .high_quality = false})),
        fast(std::make_unique<Tracer>(scene, Tracer::Config{.robust = false, .high_quality = false})) {}
};

const StableRays& stable_rays(const Point& point, Workspace& workspace, const Tracer& robust,
                              const View& view) {
  const std::string key = key_of(point, {"camera", "incidence", "resolution", "near", "far_near_ratio",
                                         "far_plane", "jitter_x", "jitter_y", "judged_rays"});
  return workspace.newest<StableRays>(point.text("scene"), "stable rays", key, [&] {
    return std::make_shared<StableRays>(robust, view, static_cast<size_t>(point.integer("judged_rays")));
  });
}

const PlacedScene& placed(const Point& point, Workspace& workspace, const Pose& pose) {
  const std::string key = key_of(point, {"scene_scale", "offset", "origin", "camera", "incidence"});
  return workspace.newest<PlacedScene>(point.text("scene"), "placed scene", key, [&] {
    return std::make_shared<PlacedScene>(workspace.scene(point.text("scene")), pose);
  });
}

std::vector<ssrm::Correction> exact_labels(const truth::ExactFrame& frame,
                                           const std::vector<truth::ExactFrame::Ray>& rays,
                                           ssrm::Marcher marcher) {
  std::vector<ssrm::Correction> labels(rays.size());
  parallel_blocks(rays.size(), 256, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) labels[i] = frame.march(rays[i], marcher);
  });
  return labels;
}

// |a - b| as a share of the larger of the two, both positive: 1 where one is infinite or not a number.
double relative_error(double a, double b) {
  const double error = std::abs(a - b) / std::max(std::abs(a), std::abs(b));
  return a == b ? 0.0 : std::isfinite(error) ? std::min(error, 1.0) : 1.0;
}

// A traced distance is wrong where it errs by more than this share of itself and a pixel's footprint at its
// origin.
constexpr double kTraceTolerance = 0.01;

Value high_quantile(const std::vector<double>& values, double q) {
  if (values.empty()) return std::monostate{};
  return metrics::quantile(values, q);
}

struct Case {
  const StableRays& stable;
  const DisturbedFrame& frame;
  const std::vector<ssrm::Correction>& exact;
  const ssrm::MarchResults& results;
  double scale;
  metrics::Tolerance tolerance;

  double claimed(size_t i) const {
    return ssrm::plane_distance(frame.depth(), frame.screen_rays, frame.rays, frame.gbuffer.view, i,
                                results.pixel[i]) /
           scale;
  }
  double exact_distance(size_t i) const { return stable.frame.distance(stable.rays[i], exact[i].pixel); }
  bool false_hit(size_t i, uint32_t primitive, double t) const {
    return stable.classify(i, primitive, t, tolerance) != HitClass::right;
  }
};

void add_label_cells(Row& row, const Case& c) {
  const truth::ExactFrame& truth = c.stable.frame;
  uint64_t flipped = 0, hit_flipped = 0, hits = 0, exact_hits = 0, false_hits = 0, exact_false = 0;
  uint64_t further = 0, self = 0, lost = 0;
  std::vector<double> distance_errors;
  for (size_t i = 0; i < c.stable.size(); ++i) {
    const ssrm::Correction& exact = c.exact[i];
    const bool usable = c.frame.usable[i], hit = usable && c.results.verdict[i] == Verdict::hit;
    const bool exact_hit = exact.verdict == Verdict::hit;
    lost += !usable;
    flipped += !usable || c.results.verdict[i] != exact.verdict || c.results.pixel[i] != exact.pixel;
    hit_flipped += hit != exact_hit;
    hits += hit, exact_hits += exact_hit;
    const bool truly_false = exact_hit && c.false_hit(i, truth.primitive()[exact.pixel], c.exact_distance(i));
    exact_false += truly_false;
    if (!hit) continue;
    const uint32_t primitive = c.frame.gbuffer.primitive[c.results.pixel[i]];
    const double claimed = c.claimed(i);
    const bool wrong = c.false_hit(i, primitive, claimed);
    false_hits += wrong;
    further += wrong && !truly_false;
    self += primitive == truth.primitive()[c.stable.rays[i].pixel] && truth.scene().is_triangle(primitive);
    if (exact_hit && c.results.pixel[i] == exact.pixel)
      distance_errors.push_back(relative_error(claimed, c.exact_distance(i)));
  }
  const uint64_t rays = c.stable.size();
  row["alpha"] = share(hits, rays);
  row["exact_alpha"] = share(exact_hits, rays);
  row["labels_flipped_fraction"] = share(flipped, rays);
  row["hits_flipped_fraction"] = share(hit_flipped, rays);
  row["lost_rays_fraction"] = share(lost, rays);
  row["false_hits"] = static_cast<int64_t>(false_hits);
  row["exact_false_hits"] = static_cast<int64_t>(exact_false);
  row["further_false_hits"] = static_cast<int64_t>(further);
  row["march_self_hits"] = static_cast<int64_t>(self);
  row["hit_distance_error_fraction"] = high_quantile(distance_errors, 0.99);
}

void add_buffer_cells(Row& row, const Case& c) {
  const truth::ExactFrame& truth = c.stable.frame;
  const GBuffer& g = c.frame.gbuffer;
  uint64_t changed = 0, covered = 0;
  for (size_t p = 0; p < g.primitive.size(); ++p) {
    covered += truth.primitive()[p] != kNoPrimitive || g.primitive[p] != kNoPrimitive;
    changed += truth.primitive()[p] != g.primitive[p];
  }
  row["pixels_changed_fraction"] = share(changed, covered);
  std::vector<double> depth_errors, angles;
  for (size_t i = 0; i < c.stable.size(); ++i) {
    const uint32_t pixel = c.stable.rays[i].pixel;
    if (g.primitive[pixel] != truth.primitive()[pixel]) continue;
    const double stored = g.view.view_depth_of(static_cast<double>(g.depth[pixel])) / c.scale;
    depth_errors.push_back(relative_error(stored, truth.view_depth(pixel)));
    if (!c.frame.usable[i]) continue;
    const dvec3 is(c.frame.rays.direction(i)), should = c.stable.rays[i].direction;
    angles.push_back(std::atan2(glm::length(glm::cross(is, should)), glm::dot(is, should)) * 180.0 /
                     std::numbers::pi);
  }
  row["depth_error_fraction"] = high_quantile(depth_errors, 0.99);
  row["depth_error_max_fraction"] = high_quantile(depth_errors, 1.0);
  row["direction_error_deg"] = high_quantile(angles, 0.99);
}

void add_trace_cells(Row& row, const Case& c, const Tracer& tracer) {
  const truth::ExactFrame& truth = c.stable.frame;
  uint64_t wrong = 0, self = 0;
  for (size_t i = 0; i < c.stable.size(); ++i) {
    if (!c.frame.usable[i]) {
      ++wrong;
      continue;
    }
    const RayStream& rays = c.frame.traced_rays();
    const Hit hit = tracer.intersect(rays.origin(i), rays.direction(i));
    const double t = static_cast<double>(hit.t) / c.scale, true_t = c.stable.true_t[i];
    // Not a HIT's tolerance: what a tracer hits may lie behind the eye.
    const double own_footprint = truth.view_depth(c.stable.rays[i].pixel) / truth.view().focal();
    wrong += hit.valid() != std::isfinite(true_t) ||
             (hit.valid() && std::abs(t - true_t) > kTraceTolerance * true_t + own_footprint);
    if (!hit.valid()) continue;
    self += hit.primitive == truth.primitive()[c.stable.rays[i].pixel] &&
            truth.scene().is_triangle(hit.primitive);
  }
  row["trace_wrong_fraction"] = share(wrong, c.stable.size());
  row["trace_self_hits"] = static_cast<int64_t>(self);
}

// Rays that are HIT at one sub-pixel position of the camera and not at the other.
Value flicker(const Case& c, const Tracer& robust, const StableView& stable, ssrm::Marcher marcher) {
  View::Settings settings = stable.settings;
  settings.jitter = dvec2(0.0);
  const View still(stable.camera, settings, robust.scene().bounds);
  const truth::ExactFrame frame(robust.scene(), still, make_gbuffer(robust, still, kPrimitive).primitive);
  std::vector<truth::ExactFrame::Ray> rays;
  std::vector<size_t> of;
  for (size_t i = 0; i < c.stable.size(); ++i) {
    const uint32_t pixel = c.stable.rays[i].pixel;
    if (frame.primitive()[pixel] == kNoPrimitive) continue;
    if (auto ray = frame.mirror_ray(pixel)) rays.push_back(*ray), of.push_back(i);
  }
  const std::vector<ssrm::Correction> labels = exact_labels(frame, rays, marcher);
  uint64_t changed = 0;
  for (size_t j = 0; j < of.size(); ++j)
    changed += (labels[j].verdict == Verdict::hit) != (c.exact[of[j]].verdict == Verdict::hit);
  return share(changed, of.size());
}

void add_keys(Row& row, const Point& point, const View& view, const Scene& scene) {
  for (const char* name : {"scene", "camera", "marcher", "depth_format", "depth_rounding", "depth_convention",
                           "far_plane", "origin", "ray_offset", "tracer", "derivatives"})
    row[name] = point.text(name);
  row["width"] = int64_t{view.width()};
  row["height"] = int64_t{view.height()};
  row["near_m"] = point.number("near");
  row["far_near_ratio"] = point.number("far_near_ratio");
  row["scene_scale"] = point.number("scene_scale");
  row["offset_m"] = point.number("offset");
  if (point.number("incidence") >= 0.0) row["incidence_deg"] = point.number("incidence");
  row["jitter_x_px"] = point.number("jitter_x");
  row["jitter_y_px"] = point.number("jitter_y");
  row["footprint_factor"] = point.number("footprint_factor");
  row["triangles"] = static_cast<int64_t>(scene.triangle_count());
  row["threads"] = int64_t{thread_count()};
}

RayOffset offset_of(const Point& point) {
  const std::string& name = point.text("ray_offset");
  return name == "scaled"  ? RayOffset::scaled
         : name == "fixed" ? RayOffset::fixed
         : name == "none"  ? RayOffset::none
                           : RayOffset::split;
}

}  // namespace

Row run(const Point& point, Workspace& workspace) {
  const std::string& name = point.text("scene");
  const Scene& scene = workspace.scene(name);
  const Tracer& robust = workspace.robust_tracer(name);
  const StableView view(point, robust);
  const StableRays& stable = stable_rays(point, workspace, robust, view.view);
  const Pose pose = pose_of(point, view.camera);
  const PlacedScene& there = placed(point, workspace, pose);
  const ssrm::Marcher marcher =
      point.text("marcher") == "paper" ? ssrm::Marcher::paper : ssrm::Marcher::plane;

  const DisturbedFrame frame(*there.robust, placed_view(view, pose, there.scene), storage_of(point),
                             point.text("derivatives") == "difference", stable, offset_of(point));
  const std::vector<ssrm::Correction> exact = exact_labels(stable.frame, stable.rays, marcher);
  const ssrm::MarchResults results = frame.march(marcher);
  const Case c{stable, frame, exact, results, pose.scale, {point.number("footprint_factor")}};

  Row row;
  add_keys(row, point, view.view, scene);
  row["judged_rays"] = static_cast<int64_t>(stable.size());
  add_label_cells(row, c);
  add_buffer_cells(row, c);
  add_trace_cells(row, c, point.text("tracer") == "robust" ? *there.robust : *there.fast);
  if (view.settings.jitter != dvec2(0.0)) row["jitter_flipped_fraction"] = flicker(c, robust, view, marcher);
  return row;
}

}  // namespace hybray::stability_parts
