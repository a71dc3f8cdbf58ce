// Photons counted in the regions of a scene's closed form, against it.
#pragma once

#include "harness/experiments/experiment.h"
#include "harness/experiments/region_flux.h"

#include <optional>

namespace hybray::caustics_parts {

class ClosedFormTally {
 public:
  // A scene without a closed form for this number of specular events leaves the tally idle.
  ClosedFormTally(const Scene& scene, int max_events);
  ClosedFormTally(const ClosedFormTally&) = delete;
  ClosedFormTally& operator=(const ClosedFormTally&) = delete;

  // The photons of one independent frame.
  void add(const caustics::PhotonBlocks& photons);

  // Cells closed_form_error_fraction, closed_form_z, closed_form_standard_error_fraction.
  void report(Row& row) const;

 private:
  std::optional<truth::ClosedForm> form_;
  std::optional<RegionFlux> flux_;
};

}  // namespace hybray::caustics_parts
