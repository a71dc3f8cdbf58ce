// What frames of `stability_caustics` are held against.
#include "harness/experiments/stability_caustics.h"

#include <algorithm>
#include <cmath>

namespace hybray::stability_caustics_parts {
namespace {

constexpr double kBound = 0.01;       // error at which a result counts as broken
constexpr double kSure = 4.0;         // standard errors beyond which it is no matter of noise
constexpr double kNegligible = 0.01;  // of the closed form's flux: regions with less are not looked at
constexpr double kRounding = 1e-5;    // of a region's flux, on top of the noise: positions are floats

double mean_flux(const caustics::Photon& photon) {
  return (static_cast<double>(photon.flux.x) + static_cast<double>(photon.flux.y) +
          static_cast<double>(photon.flux.z)) /
         3.0;
}

}  // namespace

Estimate estimate_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Estimate e;
  double square = 0.0;
  for (const double v : values) e.mean += v / n;
  for (const double v : values) square += (v - e.mean) * (v - e.mean);
  if (n > 1.0) e.standard_error = std::sqrt(square / (n * (n - 1.0)));
  return e;
}

RegionTally::RegionTally(const Body& body) : body_(body) {
  if (body.form) flux_.resize(body.form->regions.size());
}

void RegionTally::add(const caustics::PhotonBlocks& photons) {
  if (!body_.form) return;
  std::vector<double> sums(flux_.size(), 0.0);
  photons.for_each([&](const caustics::Photon& photon) {
    if (!body_.form->receives(photon.primitive)) return;
    const dvec3 place = body_.pose.inverse(dvec3(photon.position));
    for (size_t r = 0; r < sums.size(); ++r)
      if (body_.form->regions[r].contains(place)) sums[r] += mean_flux(photon);
  });
  for (size_t r = 0; r < sums.size(); ++r) flux_[r].push_back(sums[r]);
}

void RegionTally::report(Row& row) const {
  double whole = 0.0, arrived = 0.0, largest = -1.0, z = 0.0;
  Estimate worst;  // relative
  if (!body_.form) return;
  const auto exact_of = [&](const truth::Region& r) { return r.area * r.irradiance * body_.flux_scale; };
  for (const truth::Region& region : body_.form->regions) whole += exact_of(region);
  bool some_broken = false, all_hold = true;
  for (size_t r = 0; r < flux_.size(); ++r) {
    const truth::Region& region = body_.form->regions[r];
    const double exact = exact_of(region);
    const Estimate e = estimate_of(flux_[r]);
    arrived += e.mean;
    if (!(exact > kNegligible * whole)) continue;
    const double error = std::abs(e.mean / exact - 1.0);
    const double noise = std::hypot(e.standard_error / exact, region.quadrature_error / region.irradiance);
    z = std::max(z, error / std::hypot(noise, kRounding));
    some_broken = some_broken || error - kSure * noise > kBound;
    all_hold = all_hold && error + kSure * noise < kBound;
    if (error > largest) largest = error, worst.standard_error = noise;
  }
  row["error_fraction"] = largest;
  row["error_standard_error_fraction"] = worst.standard_error;
  row["closed_form_z"] = z;
  row["lost_fraction"] = 1.0 - arrived / whole;
  row["holds"] = std::string(some_broken ? "no" : all_hold ? "yes" : "unclear");
}

}  // namespace hybray::stability_caustics_parts
