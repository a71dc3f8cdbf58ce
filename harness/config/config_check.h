// Every problem of a config document, each as one clear message derived from the experiment's declaration.
#pragma once

#include "harness/config/json_source.h"
#include "harness/experiments/experiment.h"

#include <span>
#include <string>
#include <vector>

namespace hybray {

struct Problem {
  std::string place;    // "file.json:12:7 (/sweep/resolution/2)"
  std::string message;  // what was found, what was expected
};

// The experiment that the document names. Throws InputError where it names none or an unknown one.
const Experiment& experiment_of(const JsonSource& source, std::span<const Experiment> experiments);

// All problems, in the order of the document. Whatever the JSON Schema rejects is among them.
std::vector<Problem> config_problems(const JsonSource& source, const Experiment& experiment);

// Throws one InputError of all problems, a line each; does nothing when there are none.
void throw_problems(const std::vector<Problem>& problems);

}  // namespace hybray
