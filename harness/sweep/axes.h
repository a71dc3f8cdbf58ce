// The points of one scene as a product: axes of which each gives some parameters their values.
#pragma once

#include "harness/config/config.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hybray {

// Values that one axis takes: each of its entries gives the same parameters.
using Axis = std::vector<GivenSet>;

// The axes of the points of `scene` (nullptr: of an experiment without scenes), slowest first; together they
// give every parameter. A camera that stands for several for all points of the scene comes first, then the
// list of points, the sweep in its order, and all the rest as one entry. Each parameter comes from the sweep
// or the list of points, else from the scene's override, else from what is fixed.
std::vector<Axis> axes_of(const Config& config, const Given* scene);

// Puts an entry for each of `cameras` in the place of an entry whose camera is "*".
void expand_cameras(std::vector<Axis>& axes, const std::vector<std::string>& cameras);

// Number of combinations; a double, since it may be larger than any integer.
double combination_count(const std::vector<Axis>& axes);

// Every parameter of one combination, by name.
using Combination = std::map<std::string, const Given*>;
std::map<std::string, Value> values_of(const Combination& combination);

// Calls visit for each combination, the last axis fastest.
void for_each_combination(const std::vector<Axis>& axes,
                          const std::function<void(const Combination&)>& visit);

}  // namespace hybray
