// Every experiment of this build, in one list.
#include "harness/experiments/caustics.h"
#include "harness/experiments/ssrm.h"
#include "harness/experiments/ssrm_speed.h"

namespace hybray {

std::span<const Experiment> experiments() {
  static const std::vector<Experiment> all = {ssrm_experiment(), ssrm_speed_experiment(),
                                              caustics_experiment()};
  return all;
}

const Experiment* find_experiment(const std::string& name, std::span<const Experiment> experiments) {
  for (const Experiment& experiment : experiments) {
    if (experiment.name == name) return &experiment;
  }
  return nullptr;
}

}  // namespace hybray
