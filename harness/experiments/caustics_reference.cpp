// The converged image that a point is held against: its batches come from the cache as far as it has them,
// and all points of a run that need the same image share it.
#include "core/base/error.h"
#include "core/truth/caustic_reference.h"
#include "harness/cache/cache_entries.h"
#include "harness/cache/reference_cache.h"
#include "harness/experiments/caustics.h"
#include "harness/experiments/caustics_batch_bytes.h"
#include "harness/experiments/workspace.h"
#include "harness/table/build_info.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hybray::caustics_parts {
namespace {

using truth::CausticReferenceBatch;

truth::CausticReferenceSettings reference_settings(const Point& point, const Workspace& workspace,
                                                   const Setup& setup) {
  truth::CausticReferenceSettings settings;
  settings.paths = point.number("reference_paths");
  settings.mixed = point.text("mixed") != "none";
  settings.radius_pixels = point.number("reference_radius");
  settings.lights = setup.pass.lights;
  settings.seed = workspace.settings().seed;
  return settings;
}

// Everything that a batch depends on. Embree's answers depend on its version and on the instruction set.
std::string batch_key(const Point& point, const Setup& setup,
                      const truth::CausticReferenceSettings& settings) {
  const MachineInfo machine = machine_info();
  return fmt::format("caustic reference, format {}: scene {} {:016x} camera {} {} near {} {} Embree {} on {}",
                     kBatchFormat, setup.scene.name, setup.scene.content_hash, point.text("camera"),
                     point.text("resolution"), point.number("near"), truth::describe(settings),
                     embree_version(), fmt::join(machine.features, " "));
}

// The batches of one reference, each from the cache or made now.
class Batches {
 public:
  Batches(const Setup& setup, const truth::CausticReferenceSettings& settings, std::string key,
          ReferenceCache* cache)
      : setup_(setup), settings_(settings), key_(std::move(key)), cache_(cache) {}

  CausticReferenceBatch get(uint32_t number) {
    if (!cache_) return make(number);
    if (auto batch = stored(number)) return std::move(*batch);
    const auto lock = cache_->lock(key_);
    if (auto batch = stored(number)) return std::move(*batch);  // another run has made it meanwhile
    CausticReferenceBatch batch = make(number);
    cache_->save(key_, number, to_bytes(batch));
    return batch;
  }

  void count(ReferenceCounts& counts) const {
    ++(made_ == 0 ? counts.reused : reused_ == 0 ? counts.computed : counts.continued);
    counts.batches_computed += made_;
    counts.batches_reused += reused_;
  }

 private:
  std::optional<CausticReferenceBatch> stored(uint32_t number) {
    const std::optional<std::string> bytes = cache_->load(key_, number);
    if (!bytes) return std::nullopt;
    auto batch = batch_from_bytes(*bytes, setup_.view.width(), setup_.view.height());
    reused_ += batch.has_value();
    return batch;
  }

  CausticReferenceBatch make(uint32_t number) {
    if (!truth_) truth_.emplace(scene_.emplace(setup_.robust), setup_.gbuffer, settings_);
    CausticReferenceBatch batch = truth_->batch(number);
    if (batch.overflows > 0) throw RuntimeError("the reference overflows its accumulator");
    ++made_;
    return batch;
  }

  const Setup& setup_;
  const truth::CausticReferenceSettings& settings_;
  const std::string key_;
  ReferenceCache* cache_;                        // may be none
  std::optional<caustics::CausticScene> scene_;  // with its maps, only where a batch must be made
  std::optional<truth::CausticReference> truth_;
  uint64_t made_ = 0, reused_ = 0;
};

// Batches on their way to a reference.
class Sum {
 public:
  Sum(int width, int height, Reference& result)
      : result_(result), batches_(width, height), wide_(width, height) {}

  void add(CausticReferenceBatch batch) {
    Image2D<vec3> image = std::move(batch.illumination);
    if (!batch.mixed.empty()) {
      has_mixed_ = true;
      for (size_t i = 0; i < image.size(); ++i) {
        wide_[i] += dvec3(batch.mixed_wide[i]) - dvec3(batch.mixed[i]);
        image[i] += batch.mixed[i];
      }
    }
    batches_.add(image);
    result_.batches.push_back(std::move(image));
    result_.landed += batch.counts.landed;
    result_.missed_by_map += batch.counts.missed_by_map;
    result_.rays += batch.rays;
  }

  // Brings the result's image and errors up to the batches so far, at least 2.
  void update() {
    result_.image = batches_.reference();
    const Image2D<vec3>& mean = result_.image.mean;
    result_.lit = std::any_of(mean.begin(), mean.end(), [](const vec3& v) { return v != vec3(0.0f); });
    result_.relmse = result_.bias_relmse = 0.0;
    const double noise = result_.lit ? own_relmse() : 0.0;
    if (has_mixed_) {
      // The difference between the two radii is the bias, with noise of its own; both are errors.
      const double count = static_cast<double>(batches_.count());
      for (size_t i = 0; i < wide_.size(); ++i) {
        const dvec3 bias = wide_[i] / count;
        result_.image.variance[i] += vec3(bias * bias);
      }
    }
    result_.relmse = has_mixed_ && result_.lit ? own_relmse() : noise;
    result_.bias_relmse = result_.relmse - noise;
  }

 private:
  double own_relmse() const {
    return metrics::image_error(result_.image.mean, result_.image).reference_relmse;
  }

  Reference& result_;
  metrics::ImageBatches batches_;
  Image2D<dvec3> wide_;  // of the batches: estimate with wide spheres less that with the usual ones
  bool has_mixed_ = false;
};

std::shared_ptr<Reference> converge(const Point& point, Workspace& workspace, const Setup& setup,
                                    const truth::CausticReferenceSettings& settings, const std::string& key) {
  auto result = std::make_shared<Reference>();
  Batches batches(setup, settings, key, workspace.settings().cache);
  Sum sum(setup.view.width(), setup.view.height(), *result);
  const auto most = static_cast<uint32_t>(point.integer("reference_batches"));
  const double target = point.number("reference_relmse_target");
  for (uint32_t b = 0; b < most; ++b) {
    sum.add(batches.get(b));
    const bool last = b + 1 == most;
    if (!last && (b == 0 || target == 0.0)) continue;
    sum.update();
    // The first number of batches that is enough, however many more the cache has.
    if (result->lit && result->relmse <= target) break;
  }
  if (result->lit) result->exposures = metrics::flip_exposures(result->image.mean);
  batches.count(workspace.references());
  return result;
}

}  // namespace

const Reference& reference(const Point& point, Workspace& workspace, const Setup& setup) {
  const truth::CausticReferenceSettings settings = reference_settings(point, workspace, setup);
  const std::string key = batch_key(point, setup, settings);
  return workspace.shared<Reference>(
      point.text("scene"),
      fmt::format("{} batches {} target {}", key, point.integer("reference_batches"),
                  point.number("reference_relmse_target")),
      [&] { return converge(point, workspace, setup, settings, key); });
}

}  // namespace hybray::caustics_parts
