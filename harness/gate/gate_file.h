// The gates that stand in a file: a config, or a file of gates alone.
#pragma once

#include "harness/gate/gate.h"

#include <filesystem>
#include <span>
#include <vector>

namespace hybray {

struct GateFile {
  const Experiment* experiment = nullptr;  // whose columns the gates bound
  std::vector<Gate> gates;                 // of a config without any: empty
};

// A file with the key "experiment" is a config and is checked as one; any other is a file of gates for a
// table of `experiment`, which may be nullptr for a config only. Throws InputError with every problem on a
// line of its own, and where a config is of another experiment than `experiment`.
GateFile load_gates(const std::filesystem::path& file, std::span<const Experiment> experiments,
                    const Experiment* experiment);

}  // namespace hybray
