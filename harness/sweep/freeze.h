// From a config to the points of its sweep, each with every parameter resolved and an id that says what it
// is.
#pragma once

#include "harness/config/config.h"
#include "harness/sweep/scene_catalog.h"

#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace hybray {

struct FreezeOptions {
  std::vector<Assignment> filters;  // points must match; of several values for one key, any
  double memory_bytes = std::numeric_limits<double>::infinity();  // that a point may need
  bool may_be_empty = false;                                      // whether filters may leave no point
  std::vector<Assignment> suite_filters = {};                     // points must match these, too
};

struct SkippedScene {
  std::string scene;
  size_t points = 0;             // of the sweep that are left out
  bool for_each_camera = false;  // `points` counts "*" as one camera, since the scene's cameras are not known
};

struct FrozenSweep {
  std::vector<Point> points;
  std::vector<SkippedScene> skipped;         // optional scenes whose source is missing
  std::map<std::string, SceneFacts> scenes;  // of the points, by name
};

// The points of a config: listed points slowest, then the sweep in the order of the file (first key slowest),
// except that all points of one scene come together; "*" cameras expanded. Throws InputError: a filter that
// names no parameter or matches no point, a scene or camera that is not there, two points that are the same,
// more than 100,000 points, a point that needs more memory than options.memory_bytes. Scenes are loaded only
// when every check that needs none has passed.
FrozenSweep freeze(const Config& config, SceneCatalog& scenes, const FreezeOptions& options = {});

// 16 hexadecimal digits: hash of the experiment's name, all parameters, the seed and the scene's content (0:
// no scene).
std::string point_id(const std::string& experiment, const std::map<std::string, Value>& parameters,
                     int64_t seed, uint64_t scene_hash);

}  // namespace hybray
