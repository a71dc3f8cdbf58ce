// Flux of photons in the regions of a closed form, frame by frame.
#pragma once

#include "core/caustics/photon_blocks.h"
#include "core/truth/closed_forms.h"

#include <functional>
#include <vector>

namespace hybray::caustics_parts {

// A mean of independent values and its standard error; 0 of a single value.
struct Estimate {
  double mean = 0.0, standard_error = 0.0;
};
Estimate estimate_of(const std::vector<double>& values);

class RegionFlux {
 public:
  // `form` must outlive it. `place`: from the photons' coordinates to those of the form; none: they are the
  // same.
  explicit RegionFlux(const truth::ClosedForm& form, std::function<dvec3(const dvec3&)> place = {});

  // The photons of one independent frame.
  void add(const caustics::PhotonBlocks& photons);

  size_t regions() const { return flux_.size(); }
  Estimate of(size_t region) const { return estimate_of(flux_[region]); }  // W
  size_t frames() const { return frames_; }

 private:
  const truth::ClosedForm& form_;
  std::function<dvec3(const dvec3&)> place_;
  size_t frames_ = 0;
  std::vector<std::vector<double>> flux_;  // W by region and frame
};

}  // namespace hybray::caustics_parts
