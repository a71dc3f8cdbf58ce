// Photons counted in the regions of a scene's closed form, frame by frame.
#pragma once

#include "core/caustics/photon_blocks.h"
#include "core/truth/closed_forms.h"
#include "harness/experiments/experiment.h"

#include <optional>
#include <vector>

namespace hybray::caustics_parts {

class ClosedFormTally {
 public:
  // A scene without a closed form for this number of specular events leaves the tally idle.
  ClosedFormTally(const Scene& scene, int max_events);

  // The photons of one independent frame.
  void add(const caustics::PhotonBlocks& photons);

  // Cells closed_form_error_fraction, closed_form_z, closed_form_standard_error_fraction.
  void report(Row& row) const;

 private:
  std::optional<truth::ClosedForm> form_;
  std::vector<std::vector<double>> flux_;  // W by region and frame
};

}  // namespace hybray::caustics_parts
