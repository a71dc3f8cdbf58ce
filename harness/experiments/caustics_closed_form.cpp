#include "harness/experiments/caustics_closed_form.h"

#include <algorithm>
#include <cmath>

namespace hybray::caustics_parts {

ClosedFormTally::ClosedFormTally(const Scene& scene, int max_events)
    : form_(truth::closed_form(scene, max_events)) {
  if (form_) flux_.emplace(*form_);
}

void ClosedFormTally::add(const caustics::PhotonBlocks& photons) {
  if (flux_) flux_->add(photons);
}

void ClosedFormTally::report(Row& row) const {
  if (!form_) return;
  double error = 0.0, whole = 0.0, worst_z = 0.0, worst_standard_error = 0.0;
  for (size_t r = 0; r < flux_->regions(); ++r) {
    const truth::Region& region = form_->regions[r];
    const double exact = region.area * region.irradiance;
    const Estimate flux = flux_->of(r);
    error += std::abs(flux.mean - exact);
    whole += exact;
    if (flux_->frames() < 2 || !(exact > 0.0)) continue;
    // Positions are floats: what is exact but for rounding has next to no spread of its own.
    const double rounding = 1e-5 * exact;
    const double standard_error =
        std::hypot(flux.standard_error, region.area * region.quadrature_error, rounding);
    worst_standard_error = std::max(worst_standard_error, standard_error / exact);
    if (standard_error > 0.0) worst_z = std::max(worst_z, std::abs(flux.mean - exact) / standard_error);
  }
  if (!(whole > 0.0)) return;
  row["closed_form_error_fraction"] = error / whole;
  row["closed_form_z"] = worst_z;
  row["closed_form_standard_error_fraction"] = worst_standard_error;
}

}  // namespace hybray::caustics_parts
