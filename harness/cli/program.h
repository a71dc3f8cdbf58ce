// The program `hybray` over a given set of experiments; tests run it over their own.
#pragma once

#include "harness/experiments/experiment.h"

#include <span>

namespace hybray {

// Reads the command line, runs the command and gives the exit code. Every error ends here, as one message on
// stderr.
int program_main(int argc, char** argv, std::span<const Experiment> experiments);

}  // namespace hybray
