#include "harness/experiments/region_flux.h"

#include <cmath>
#include <utility>

namespace hybray::caustics_parts {

Estimate estimate_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Estimate e;
  double square = 0.0;
  for (const double v : values) e.mean += v / n;
  for (const double v : values) square += (v - e.mean) * (v - e.mean);
  if (n > 1.0) e.standard_error = std::sqrt(square / (n * (n - 1.0)));
  return e;
}

RegionFlux::RegionFlux(const truth::ClosedForm& form, std::function<dvec3(const dvec3&)> place)
    : form_(form), place_(std::move(place)), flux_(form.regions.size()) {}

void RegionFlux::add(const caustics::PhotonBlocks& photons) {
  std::vector<double> sums(flux_.size(), 0.0);
  photons.for_each([&](const caustics::Photon& photon) {
    if (!form_.receives(photon.primitive)) return;
    const dvec3 at = place_ ? place_(dvec3(photon.position)) : dvec3(photon.position);
    for (size_t r = 0; r < sums.size(); ++r)
      if (form_.regions[r].contains(at)) sums[r] += photon.mean_flux();
  });
  for (size_t r = 0; r < sums.size(); ++r) flux_[r].push_back(sums[r]);
  ++frames_;
}

}  // namespace hybray::caustics_parts
