// One config: an experiment, and the values that its parameters take. Read from JSON, checked, changed by the
// command line.
#pragma once

#include "harness/experiments/experiment.h"

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hybray {

// A parameter with the values it takes; more than one only where it is swept.
struct Setting {
  const Parameter* parameter = nullptr;
  std::vector<Value> values;
  std::vector<std::string> places;  // where each value was given, as messages name it
};

struct Config {
  std::filesystem::path file;
  std::string name;  // of the file, without folder and ending; names the table
  const Experiment* experiment = nullptr;
  std::string title, text;
  int64_t seed = 1;
  std::vector<Setting> sweep;  // in the order of the file: the first varies slowest
  std::vector<Setting> fixed;  // every other parameter, in declared order, defaults included
  std::vector<std::string> optional_scenes;

  // The setting of the experiment's parameter of that name, swept or fixed.
  const Setting& setting(const std::string& wanted) const;
};

// Splits "KEY=VALUE" at the first "=". Throws InputError with `place` where there is none.
std::pair<std::string, std::string> split_assignment(const std::string& assignment, const std::string& place);

// Loads a config of one of `experiments`. Each of `assignments` (KEY=VALUE, as from `--set`) replaces a
// parameter or a whole sweep; the key `seed` replaces the seed. Throws InputError with every problem on a
// line of its own: place, what was found, what was expected.
Config load_config(const std::filesystem::path& file, std::span<const Experiment> experiments,
                   std::span<const std::string> assignments = {});

}  // namespace hybray
