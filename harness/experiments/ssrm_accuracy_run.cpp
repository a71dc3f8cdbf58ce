// One point of `ssrm_accuracy`: march, check, verdicts, times.
#include "core/ssrm/hit_checks.h"
#include "core/ssrm/march.h"
#include "core/ssrm/march_dda.h"
#include "core/ssrm/march_hiz.h"
#include "core/truth/march_level0.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/ssrm_accuracy.h"
#include "harness/experiments/ssrm_frame.h"
#include "harness/experiments/ssrm_picture.h"
#include "harness/timing/interleaved.h"

#include <optional>
#include <stdexcept>

namespace hybray::ssrm_accuracy_parts {
namespace {

using ssrm::HitCheck;
using ssrm::MarchResults;

using March = void (*)(const Point& point, const SsrmFrame& frame, MarchResults& results);

void march_strict(const Point& point, const SsrmFrame& frame, ssrm::Marcher marcher, MarchResults& results) {
  ssrm::march(frame.depth(), frame.screen_rays, frame.rays().pixel,
              {.step_budget = static_cast<uint64_t>(point.integer("step_budget")),
               .code = ssrm::MarchCode::lanes,
               .marcher = marcher},
              results);
}

void march_paper(const Point& point, const SsrmFrame& frame, MarchResults& results) {
  march_strict(point, frame, ssrm::Marcher::paper, results);
}

void march_plane(const Point& point, const SsrmFrame& frame, MarchResults& results) {
  march_strict(point, frame, ssrm::Marcher::plane, results);
}

void march_level0(const Point&, const SsrmFrame& frame, MarchResults& results) {
  results = truth::march_level0<double>(frame.depth(), frame.screen_rays, frame.rays().pixel);
}

void march_dda(const Point& point, const SsrmFrame& frame, MarchResults& results) {
  ssrm::march_dda(frame.depth(), frame.view(), frame.rays(), frame.screen_rays,
                  {point.number("thickness"), point.number("stride"),
                   static_cast<uint64_t>(point.integer("step_budget"))},
                  results);
}

void march_hiz(const Point& point, const SsrmFrame& frame, MarchResults& results) {
  ssrm::march_hiz(frame.depth(), frame.gbuffer, frame.rays(), frame.screen_rays,
                  {point.number("thickness"), point.number("confidence"),
                   static_cast<uint64_t>(point.integer("step_budget"))},
                  results);
}

struct Marcher {
  const char* name;
  March march;
  std::vector<const char*> own_parameters;  // of those that not every marcher has, as columns
};

// One line a marcher.
const Marcher kMarchers[] = {
    {"paper", march_paper, {}},
    {"plane", march_plane, {}},
    {"level0", march_level0, {}},
    {"dda", march_dda, {"thickness_m", "stride_px"}},
    {"hiz", march_hiz, {"thickness_m", "confidence"}},
};

const Marcher& marcher_of(const Point& point) {
  for (const Marcher& marcher : kMarchers)
    if (point.text("marcher") == marcher.name) return marcher;
  throw std::logic_error("marcher " + point.text("marcher") + " is declared but not built");
}

HitCheck check_of(const Point& point) {
  for (const HitCheck check :
       {HitCheck::triangle, HitCheck::continuity, HitCheck::conservative, HitCheck::strict})
    if (point.text("check") == label(check)) return check;
  return HitCheck::none;
}

void add_keys(Row& row, const Point& point, const Marcher& marcher) {
  for (const char* name : {"marcher", "check"}) row[name] = point.text(name);
  for (const std::string column : marcher.own_parameters)
    row[column] = point.number(column == "confidence" ? column : column.substr(0, column.rfind('_')));
  row["step_budget"] = point.integer("step_budget");
  row["footprint_factor"] = point.number("footprint_factor");
}

// Judges `results` with HITs at the distances that `results` holds, or else at the planes of their pixels.
metrics::VerdictTable judged(const Point& point, const SsrmSetup& setup, const JudgedFrame& shared,
                             const MarchResults& results, std::vector<metrics::HitClass>* classes = nullptr) {
  const SsrmFrame& frame = shared.frame;
  return metrics::judge(results, frame.depth(), frame.screen_rays, frame.rays(), shared.truth, frame.gbuffer,
                        setup.scene, {point.number("footprint_factor")}, classes);
}

std::optional<ssrm::PathCheck> path_check(HitCheck check, const ssrm::SurfaceView& surfaces,
                                          const SsrmFrame& frame) {
  if (!checks_path(check)) return std::nullopt;
  std::optional<ssrm::PathCheck> path(std::in_place, surfaces.depth, frame.rays().size());
  ssrm::bound_neighbourhood(surfaces.depth, path->neighbourhood);
  return path;
}

// `marched`: before the check. `rays` must not be empty.
void add_times(Row& row, const Point& point, const SsrmFrame& frame, const Marcher& marcher,
               const ssrm::SurfaceView& surfaces, const MarchResults& marched, int repeats, uint64_t seed) {
  const HitCheck check = check_of(point);
  MarchResults results = marched, checked = marched, paper = marched;
  std::optional<ssrm::PathCheck> path = path_check(check, surfaces, frame);
  enum { kMarch, kPaper, kNeighbourhood, kCheck };
  std::vector<Variant> variants = {{"march", [&] { marcher.march(point, frame, results); }},
                                   {"paper_march", [&] { march_paper(point, frame, paper); }}};
  if (check != HitCheck::none) {
    variants.push_back({"neighbourhood", [&] {
                          if (path) ssrm::bound_neighbourhood(surfaces.depth, path->neighbourhood);
                        }});
    variants.push_back({"check", [&] {
                          checked = marched;
                          check_hits(surfaces, path ? &*path : nullptr, frame.rays(), frame.screen_rays,
                                     check, checked);
                        }});
  }
  const InterleavedTimes times = time_interleaved(variants, repeats, seed);
  std::vector<double> whole(times.of(kMarch).begin(), times.of(kMarch).end());
  for (size_t v = 0; v < variants.size(); ++v) {
    if (v == kNeighbourhood && !path) continue;
    put_time(row, variants[v].name, times.of(v));
    if (v >= kNeighbourhood)
      for (size_t r = 0; r < whole.size(); ++r) whole[r] += times.of(v)[r];
  }
  put_ratio(row, "march_cost_ratio", times.of(kMarch), times.of(kPaper), seed);
  put_ratio(row, "checked_march_cost_ratio", whole, times.of(kPaper), seed);
  row["repeats"] = int64_t{repeats};
}

}  // namespace

Row run(const Point& point, Workspace& workspace) {
  // The same buffers at every point, so that neighbouring points share them.
  constexpr unsigned kBuffers = kGeometricNormal | kMaterial;
  const SsrmSetup setup(point, workspace, kBuffers);
  const JudgedFrame& shared = shared_frame(point, workspace, kBuffers);
  const SsrmFrame& frame = shared.frame;
  const Marcher& marcher = marcher_of(point);
  const HitCheck check = check_of(point);
  const ssrm::DepthView depth = frame.depth();
  const ssrm::SurfaceView surfaces{depth, frame.gbuffer, setup.scene};
  Row row;
  add_view_cells(row, point, setup, frame);
  add_keys(row, point, marcher);

  const size_t rays = frame.rays().size();
  MarchResults marched;
  marched.resize(rays);
  marcher.march(point, frame, marched);
  row["steps_per_ray"] = share(marched.steps, rays);
  // What is compared is where the pixel's plane puts a HIT, for every marcher; its own depth is judged
  // beside.
  const bool own_depth = !marched.distance.empty();
  if (own_depth) {
    const metrics::VerdictTable own = judged(point, setup, shared, marched);
    row["precision_own_depth"] = share(own.right, own.hits());
    marched.distance.clear();
  }
  std::vector<metrics::HitClass> before, after;
  row["alpha_unchecked"] = share(judged(point, setup, shared, marched, &before).hits(), rays);
  MarchResults results = marched;
  if (check != HitCheck::none) {
    std::optional<ssrm::PathCheck> path = path_check(check, surfaces, frame);
    const ssrm::CheckCounts counts =
        check_hits(surfaces, path ? &*path : nullptr, frame.rays(), frame.screen_rays, check, results);
    if (path) row["check_steps_per_hit"] = share(counts.steps, counts.checked);
  }
  add_verdict_cells(row, judged(point, setup, shared, results, &after));
  uint64_t lost = 0;
  for (size_t i = 0; i < rays; ++i)
    lost += before[i] == metrics::HitClass::right && results.verdict[i] == ssrm::Verdict::rejected;
  row["rejected_right_fraction"] = share(lost, rays);
  if (point.boolean("picture"))
    write_verdict_picture(point, workspace, frame.gbuffer, setup.scene, frame.rays(), results, after);
  if (workspace.settings().timing && rays > 0)
    add_times(row, point, frame, marcher, surfaces, marched, static_cast<int>(point.integer("repeats")),
              workspace.settings().seed);
  return row;
}

}  // namespace hybray::ssrm_accuracy_parts
