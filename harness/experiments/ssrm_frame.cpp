#include "harness/experiments/ssrm_frame.h"

#include "core/base/parallel.h"
#include "core/tracer/seeded_camera.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/resolution.h"

#include <bit>
#include <utility>

namespace hybray {
namespace {

View::Settings view_settings(const Point& point) {
  const Resolution size = *parse_resolution(point.text("resolution"));
  return {.width = size.width,
          .height = size.height,
          .near = point.number("near"),
          .far = point.number("far"),
          .convention = point.text("depth_convention") == "standard" ? DepthConvention::standard
                                                                     : DepthConvention::reversed};
}

}  // namespace

DepthPyramid pyramid_of(const GBuffer& g) {
  DepthPyramid pyramid(g.view.width(), g.view.height());
  pyramid.build(g.depth, g.view.depth_sign(), g.view.background_depth());
  return pyramid;
}

SsrmSetup::SsrmSetup(const Point& point, Workspace& workspace, unsigned more_bits)
    : scene(workspace.scene(point.text("scene"))),
      robust(workspace.robust_tracer(point.text("scene"))),
      view(camera_of(robust, point.text("camera")), view_settings(point), scene.bounds),
      bits(kDepth | kShadingNormal | kPrimitive | more_bits),
      difference(point.text("derivatives") == "difference") {
  if (!difference) bits |= kDepthDerivatives;
}

GBuffer SsrmSetup::make_buffers() const {
  GBuffer g = make_gbuffer(robust, view, bits);
  if (difference) g.depth_derivatives = difference_derivatives(g.depth);
  return g;
}

SsrmFrame::SsrmFrame(const SsrmSetup& setup)
    : gbuffer(setup.make_buffers()),
      pyramid(pyramid_of(gbuffer)),
      reflection(make_reflection_rays(gbuffer, setup.scene)),
      screen_rays(ssrm::project_rays(reflection.rays, setup.view, setup.scene.bounds)) {}

void SsrmFrame::add_slanted(SlantedPyramid::Bounds bounds) {
  if (!slanted) slanted.emplace(view().width(), view().height());
  slanted->build(gbuffer.depth, gbuffer.depth_derivatives, view().depth_sign(), view().background_depth(),
                 bounds);
}

size_t SsrmFrame::memory_bytes() const {
  return gbuffer.memory_bytes() + pyramid.memory_bytes() + rays().memory_bytes() +
         screen_rays.memory_bytes() + (slanted ? slanted->memory_bytes() : 0);
}

JudgedFrame::JudgedFrame(const SsrmSetup& setup)
    : frame(setup), truth(truth::trace_truth(setup.robust, frame.rays(), setup.view)) {
  frame.add_slanted(SlantedPyramid::Bounds::slanted);
}

const JudgedFrame& shared_frame(const Point& point, Workspace& workspace, unsigned more_bits) {
  std::string key = std::to_string(more_bits);
  for (const Parameter& p : ssrm_view_parameters()) key += ' ' + to_text(point.parameters.at(p.name));
  return workspace.newest<JudgedFrame>(point.text("scene"), "frame", key, [&] {
    return std::make_shared<JudgedFrame>(SsrmSetup(point, workspace, more_bits));
  });
}

std::vector<Parameter> ssrm_view_parameters() {
  using namespace parameter;
  return {
      scene(),
      camera(),
      resolution("1920x1080"),
      near_plane(0.1),
      number("far", "m", 0.0, 0.0, 1e12, "Distance of the far plane; 0: just beyond the scene."),
      choice("depth_convention", "reversed", {"standard", "reversed"},
             "Device depth that grows with distance (standard) or falls (reversed)."),
      choice("derivatives", "plane", {"plane", "difference"},
             "Depth derivatives from the triangle's plane, or by differences inside 2x2 quads as graphics "
             "hardware makes them."),
  };
}

Column share_of_rays(const char* name, Better better, const char* text) {
  return {name, "1", ColumnKind::metric, better, text, {}, {kMovedRays, 0.0}};
}

Column samples_read(const char* name, Better better, const char* text) {
  return {name, "1", ColumnKind::metric, better, text, {}, {0.0, 10 * kMovedRays}};
}

Column follows_rays(Column column) {
  return column::within({2.0, kMovedRays}, std::move(column));
}

Parameter step_budget_parameter(const char* text) {
  return parameter::integer("step_budget", "", 0, 0, 1e9, text);
}

Parameter footprint_factor_parameter() {
  return parameter::number("footprint_factor", "", 1.0, 1e-3, 1e3,
                           "k of the tolerance that makes a HIT right.");
}

Parameter verdict_picture_parameter() {
  return parameter::flag("picture", false,
                         "Write the verdict picture: grey = resolved, blue = unknown, light blue = miss, "
                         "red = false hit, black = background.");
}

void add_trace_mode_columns(std::vector<Column>& columns) {
  columns.push_back(column::finding(
      "hw_mode", "fastest mode of the general tracer for all rays, by measurement", Comparison::none));
  columns.push_back(column::finding(
      "hw_mode_unresolved", "fastest mode for the unresolved rays, by measurement", Comparison::none));
}

double width_of(const Point& point) {
  return parse_resolution(point.text("resolution"))->width;
}

double pixels_of(const Point& point) {
  const Resolution size = *parse_resolution(point.text("resolution"));
  return static_cast<double>(size.width) * size.height;
}

SharedCost scene_cost(const Point& point, const SceneFacts& scene) {
  return {"scene " + point.text("scene"), 0.1 + 1.2e-6 * static_cast<double>(scene.triangles)};
}

void add_view_columns(std::vector<Column>& columns) {
  using namespace column;
  using enum Better;
  add(columns,
      {
          key("scene", "scene"),
          key("camera", "camera"),
          key("width", "width of the main view", "px"),
          key("height", "height of the main view", "px"),
          key("near_m", "near plane", "m"),
          {"far_m", "m", ColumnKind::key, none, "far plane in use", Comparison::value, {0.0, 1e-12}},
          key("depth_convention", "depth convention"),
          key("derivatives", "origin of the depth derivatives"),
          counted("triangles", "triangles of the scene"),
          follows_rays(counted("rays", "reflection rays, one a covered pixel")),
          follows_rays(counted("geometric_mirror_rays",
                               "rays mirrored about the geometric normal instead of the shading normal")),
          follows_rays(counted("paths_skipped", "background pixels, for which no ray was made")),
          counted("buffers_skipped", "kinds of geometry buffer that this point did not need"),
      });
  add_threads(columns);
}

void add_view_cells(Row& row, const Point& point, const SsrmSetup& setup, const SsrmFrame& frame) {
  for (const char* name : {"scene", "camera", "depth_convention", "derivatives"})
    row[name] = point.text(name);
  row["width"] = int64_t{setup.view.width()};
  row["height"] = int64_t{setup.view.height()};
  row["near_m"] = setup.view.near();
  row["far_m"] = setup.view.far();
  row["triangles"] = static_cast<int64_t>(setup.scene.triangle_count());
  row["rays"] = static_cast<int64_t>(frame.rays().size());
  row["geometric_mirror_rays"] = static_cast<int64_t>(frame.reflection.mirrored_about_geometric_normal);
  row["paths_skipped"] = static_cast<int64_t>(frame.gbuffer.depth.size() - frame.gbuffer.covered_pixels);
  row["buffers_skipped"] = int64_t{kGBufferKinds - std::popcount(setup.bits)};
  row["threads"] = int64_t{thread_count()};
}

void add_verdict_columns(std::vector<Column>& columns) {
  using column::add;
  using enum Better;
  add(columns,
      {
          share_of_rays("alpha", higher, "HIT / rays"),
          share_of_rays("miss_fraction", none, "MISS / rays"),
          share_of_rays("false_miss_fraction", lower, "share of MISS whose ray truly hits something"),
          share_of_rays("unknown_offscreen_fraction", none,
                        "rays that left the view volume at the side or the far plane / rays"),
          share_of_rays("unknown_behind_fraction", none,
                        "rays already behind the failing pixel's plane where they enter it / rays"),
          share_of_rays("unknown_viewer_fraction", none, "rays that left through the near plane / rays"),
          share_of_rays("unknown_correction_fraction", none,
                        "rays that failed the correction otherwise / rays"),
          share_of_rays("unknown_budget_fraction", none, "rays whose step budget was exhausted / rays"),
          share_of_rays("unknown_rejected_fraction", none,
                        "HITs of the march that failed a later check / rays"),
          share_of_rays("precision", higher, "right HITs / HITs"),
          share_of_rays("precision_loose", higher, "HITs within max(1 % of t*, 1.5 footprints) / HITs"),
          share_of_rays("recall", higher, "right HITs / rays whose true hit the main view sees"),
          share_of_rays("alpha_max", none, "rays whose true hit the main view sees / rays"),
          share_of_rays("false_hit_fraction", lower, "false HITs / HITs; phantom + early + through"),
          share_of_rays("phantom_fraction", lower, "HITs of rays that truly hit nothing / HITs"),
          share_of_rays("early_fraction", lower, "HITs claimed before the true hit / HITs"),
          share_of_rays("through_fraction", lower, "HITs claimed beyond the true hit / HITs"),
      });
}

void add_verdict_cells(Row& row, const metrics::VerdictTable& t) {
  using ssrm::Verdict;
  const auto of_rays = [&](Verdict v) { return share(t.count(v), t.rays); };
  row["alpha"] = of_rays(Verdict::hit);
  row["miss_fraction"] = of_rays(Verdict::miss);
  row["false_miss_fraction"] = share(t.false_misses, t.count(Verdict::miss));
  row["unknown_offscreen_fraction"] = of_rays(Verdict::offscreen);
  row["unknown_behind_fraction"] = of_rays(Verdict::behind);
  row["unknown_viewer_fraction"] = of_rays(Verdict::viewer);
  row["unknown_correction_fraction"] = of_rays(Verdict::correction);
  row["unknown_budget_fraction"] = of_rays(Verdict::budget);
  row["unknown_rejected_fraction"] = of_rays(Verdict::rejected);
  row["precision"] = share(t.right, t.hits());
  row["precision_loose"] = share(t.right_loose, t.hits());
  row["recall"] = share(t.right, t.visible_true_hits);
  row["alpha_max"] = share(t.visible_true_hits, t.rays);
  row["false_hit_fraction"] = share(t.phantom + t.early + t.through, t.hits());
  row["phantom_fraction"] = share(t.phantom, t.hits());
  row["early_fraction"] = share(t.early, t.hits());
  row["through_fraction"] = share(t.through, t.hits());
}

}  // namespace hybray
