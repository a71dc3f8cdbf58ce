// The converged image that a point is held against, computed once for all points of a run that need it.
#include "core/base/error.h"
#include "core/truth/caustic_reference.h"
#include "harness/experiments/caustics.h"
#include "harness/experiments/workspace.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hybray::caustics_parts {
namespace {

using truth::CausticReferenceBatch;

std::shared_ptr<Reference> converge(const Point& point, const Workspace& workspace, const Setup& setup,
                                    bool mixed) {
  truth::CausticReferenceSettings settings;
  settings.paths = point.number("reference_paths");
  settings.mixed = mixed;
  settings.radius_pixels = point.number("reference_radius");
  settings.lights = setup.pass.lights;
  settings.seed = workspace.settings().seed;
  const caustics::CausticScene scene(setup.robust);
  const truth::CausticReference truth(scene, setup.gbuffer, settings);

  auto result = std::make_shared<Reference>();
  const int w = setup.view.width(), h = setup.view.height();
  metrics::ImageBatches batches(w, h), bias(w, h);
  Image2D<dvec3> wide(w, h);
  const auto count = static_cast<uint32_t>(point.integer("reference_batches"));
  bool has_mixed = false;
  for (uint32_t b = 0; b < count; ++b) {
    CausticReferenceBatch batch = truth.batch(b);
    if (batch.overflows > 0) throw RuntimeError("the reference overflows its accumulator");
    Image2D<vec3> image = std::move(batch.illumination);
    if (!batch.mixed.empty()) {
      has_mixed = true;
      for (size_t i = 0; i < image.size(); ++i) {
        wide[i] += (dvec3(batch.mixed_wide[i]) - dvec3(batch.mixed[i])) / static_cast<double>(count);
        image[i] += batch.mixed[i];
      }
    }
    batches.add(image);
    result->batches.push_back(std::move(image));
    result->landed += batch.counts.landed;
    result->missed_by_map += batch.counts.missed_by_map;
    result->rays += batch.rays;
  }
  result->image = batches.reference();
  if (has_mixed) {
    // The difference between the two radii is the bias, with noise of its own; both are errors.
    metrics::ReferenceImage with_bias = result->image;
    for (size_t i = 0; i < wide.size(); ++i) with_bias.variance[i] += vec3(wide[i] * wide[i]);
    const Image2D<vec3>& mean = result->image.mean;
    const bool lit = std::any_of(mean.begin(), mean.end(), [](const vec3& v) { return v != vec3(0.0f); });
    if (lit)
      result->bias_relmse = metrics::image_error(mean, with_bias).reference_relmse -
                            metrics::image_error(mean, result->image).reference_relmse;
    result->image = std::move(with_bias);
  }
  return result;
}

}  // namespace

const Reference& reference(const Point& point, Workspace& workspace, const Setup& setup) {
  const bool mixed = point.text("mixed") != "none";
  const std::string key =
      fmt::format("caustic reference {} {} near {} lights {} paths {} batches {} radius {} mixed {}",
                  point.text("camera"), point.text("resolution"), point.number("near"),
                  fmt::join(setup.pass.lights, ","), point.number("reference_paths"),
                  point.integer("reference_batches"), point.number("reference_radius"), mixed);
  return workspace.shared<Reference>(point.text("scene"), key,
                                     [&] { return converge(point, workspace, setup, mixed); });
}

}  // namespace hybray::caustics_parts
