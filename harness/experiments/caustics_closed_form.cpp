#include "harness/experiments/caustics_closed_form.h"

#include <algorithm>
#include <cmath>

namespace hybray::caustics_parts {

ClosedFormTally::ClosedFormTally(const Scene& scene, int max_events)
    : form_(truth::closed_form(scene, max_events)) {
  if (form_) flux_.resize(form_->regions.size());
}

void ClosedFormTally::add(const caustics::PhotonBlocks& photons) {
  if (!form_) return;
  std::vector<double> sums(flux_.size(), 0.0);
  photons.for_each([&](const caustics::Photon& photon) {
    if (!form_->receives(photon.primitive)) return;
    const double flux = (static_cast<double>(photon.flux.x) + static_cast<double>(photon.flux.y) +
                         static_cast<double>(photon.flux.z)) /
                        3.0;
    for (size_t r = 0; r < sums.size(); ++r)
      if (form_->regions[r].contains(dvec3(photon.position))) sums[r] += flux;
  });
  for (size_t r = 0; r < sums.size(); ++r) flux_[r].push_back(sums[r]);
}

void ClosedFormTally::report(Row& row) const {
  if (!form_) return;
  double error = 0.0, whole = 0.0, worst_z = 0.0, worst_standard_error = 0.0;
  for (size_t r = 0; r < flux_.size(); ++r) {
    const truth::Region& region = form_->regions[r];
    const double exact = region.area * region.irradiance;
    const double n = static_cast<double>(flux_[r].size());
    double mean = 0.0, square = 0.0;
    for (const double f : flux_[r]) mean += f / n;
    for (const double f : flux_[r]) square += (f - mean) * (f - mean);
    error += std::abs(mean - exact);
    whole += exact;
    if (n < 2.0 || !(exact > 0.0)) continue;
    // Positions are floats: what is exact but for rounding has next to no spread of its own.
    const double rounding = 1e-5 * exact;
    const double standard_error =
        std::hypot(std::sqrt(square / (n * (n - 1.0))), region.area * region.quadrature_error, rounding);
    worst_standard_error = std::max(worst_standard_error, standard_error / exact);
    if (standard_error > 0.0) worst_z = std::max(worst_z, std::abs(mean - exact) / standard_error);
  }
  if (!(whole > 0.0)) return;
  row["closed_form_error_fraction"] = error / whole;
  row["closed_form_z"] = worst_z;
  row["closed_form_standard_error_fraction"] = worst_standard_error;
}

}  // namespace hybray::caustics_parts
