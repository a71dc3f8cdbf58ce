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

}  // namespace

RegionTally::RegionTally(const Body& body) : body_(body) {
  if (body.form) flux_.emplace(*body.form, [&body](const dvec3& x) { return body.pose.inverse(x); });
}

void RegionTally::add(const caustics::PhotonBlocks& photons) {
  if (flux_) flux_->add(photons);
}

void RegionTally::report(Row& row) const {
  if (!body_.form) return;
  double whole = 0.0, arrived = 0.0, largest = -1.0, noise_of_largest = 0.0, z = 0.0;
  const auto exact_of = [&](const truth::Region& r) { return r.area * r.irradiance * body_.flux_scale; };
  for (const truth::Region& region : body_.form->regions) whole += exact_of(region);
  bool some_broken = false, all_hold = true;
  for (size_t r = 0; r < flux_->regions(); ++r) {
    const truth::Region& region = body_.form->regions[r];
    const double exact = exact_of(region);
    const caustics_parts::Estimate e = flux_->of(r);
    arrived += e.mean;
    if (!(exact > kNegligible * whole)) continue;
    const double error = std::abs(e.mean / exact - 1.0);
    const double noise = std::hypot(e.standard_error / exact, region.quadrature_error / region.irradiance);
    z = std::max(z, error / std::hypot(noise, kRounding));
    some_broken = some_broken || error - kSure * noise > kBound;
    all_hold = all_hold && error + kSure * noise < kBound;
    if (error > largest) largest = error, noise_of_largest = noise;
  }
  row["error_fraction"] = largest;
  row["error_standard_error_fraction"] = noise_of_largest;
  row["closed_form_z"] = z;
  row["lost_fraction"] = 1.0 - arrived / whole;
  row["holds"] = std::string(some_broken ? "no" : all_hold ? "yes" : "unclear");
}

}  // namespace hybray::stability_caustics_parts
