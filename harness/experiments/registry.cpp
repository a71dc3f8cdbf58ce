// Every experiment of this build, in one list.
#include "harness/experiments/caustics.h"
#include "harness/experiments/ssrm.h"
#include "harness/experiments/ssrm_accuracy.h"
#include "harness/experiments/ssrm_breakeven.h"
#include "harness/experiments/ssrm_layers.h"
#include "harness/experiments/ssrm_rays.h"
#include "harness/experiments/ssrm_speed.h"
#include "harness/experiments/stability.h"
#include "harness/experiments/stability_caustics.h"

namespace hybray {

std::span<const Experiment> experiments() {
  static const std::vector<Experiment> all = {
      ssrm_experiment(),        ssrm_accuracy_experiment(), ssrm_breakeven_experiment(),
      ssrm_layers_experiment(), ssrm_rays_experiment(),     ssrm_speed_experiment(),
      stability_experiment(),   caustics_experiment(),      stability_caustics_experiment()};
  return all;
}

const Experiment* find_experiment(const std::string& name, std::span<const Experiment> experiments) {
  for (const Experiment& experiment : experiments) {
    if (experiment.name == name) return &experiment;
  }
  return nullptr;
}

}  // namespace hybray
