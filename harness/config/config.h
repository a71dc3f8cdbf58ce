// One config: an experiment, and the values that its parameters take. Read from JSON, checked, changed by the
// command line.
#pragma once

#include "harness/config/assignment.h"
#include "harness/config/json_source.h"
#include "harness/experiments/experiment.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace hybray {

// A parameter with the values it takes; more than one only where it is swept.
struct Setting {
  const Parameter* parameter = nullptr;
  std::vector<Value> values;
  std::vector<std::string> places;  // where each value was given, as messages name it
};

// One value of a parameter.
struct Given {
  const Parameter* parameter = nullptr;
  Value value;
  std::string place;  // where it was given, as messages name it
};

// Values of several parameters that belong together.
using GivenSet = std::vector<Given>;

// The value of `parameter` in `set`, or nullptr.
const Given* find_given(const GivenSet& set, const Parameter* parameter);

// The points are the product of `points` and the lists of `sweep`. What these do not give comes from
// `scene_overrides`, and what those do not give from `fixed`.
struct Config {
  std::filesystem::path file;
  std::string name;  // of the file, without folder and ending; names the table
  const Experiment* experiment = nullptr;
  std::string title, text;
  int64_t seed = 1;
  std::vector<GivenSet> points;                     // in the order of the file; empty: none are listed
  std::vector<Setting> sweep;                       // in the order of the file: the first varies slowest
  std::map<std::string, GivenSet> scene_overrides;  // by scene
  std::vector<Setting> fixed;  // one value each, in declared order, defaults included: every parameter that
                               // is not swept, but for those that only points or overrides give
  bool merge_equal_points = false;  // since the command line took what set them apart
  std::vector<std::string> optional_scenes;

  // The setting of the experiment's parameter of that name, swept or fixed.
  const Setting& setting(const std::string& wanted) const;
};

// The parameters that tell the points of a config apart, slowest first: of the list of points, of the sweep,
// and the camera where "*" stands for several.
std::vector<const Parameter*> varied_parameters(const Config& config);

// The scenes of the points, each once, in order; none for an experiment without a scene.
std::vector<Given> scenes_of(const Config& config);

// A config of one of `experiments`. Each of `assignments` replaces what the file says of a parameter: a
// single value fixes it, several make a sweep; the key `seed` replaces the seed. Throws InputError with every
// problem on a line of its own: place, what was found, what was expected.
Config load_config(const JsonSource& source, const std::filesystem::path& file,
                   std::span<const Experiment> experiments, std::span<const Assignment> assignments = {});

// The same for a file; throws InputError where it cannot be read, too.
Config load_config(const std::filesystem::path& file, std::span<const Experiment> experiments,
                   std::span<const Assignment> assignments = {});

}  // namespace hybray
