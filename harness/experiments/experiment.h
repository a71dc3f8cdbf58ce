// An experiment is declared once: its parameters, its columns, and the function that turns one point into one
// row. Config validation, the JSON Schema, `hybray describe`, the CSV header and the docs all come from this
// declaration.
#pragma once

#include "core/scene/scene_library.h"
#include "harness/table/value.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hybray {

enum class ParameterType {
  boolean,
  integer,
  number,
  choice,      // text, one of `choices`
  scene,       // name of a scene
  camera,      // name of a camera of the point's scene; "*" in a config stands for each of them in turn
  resolution,  // "WIDTHxHEIGHT", each in [minimum, maximum] pixels
};

struct Parameter {
  std::string name;
  ParameterType type;
  std::string unit;     // "m", "px"; empty: a pure number or a name
  Value default_value;  // monostate: the config must give it
  std::optional<double> minimum, maximum;
  std::vector<std::string> choices;
  std::string text;  // one sentence for people
};

enum class ColumnKind { key, metric, time, count };
enum class Better { none, lower, higher };

// What holding a table against an accepted one does with a column.
enum class Comparison {
  identity,  // rows with the same values belong together
  value,     // must be as accepted, within the tolerance
  none,      // depends on the machine or the command line
};

// How far a value may be from the accepted one: absolute + relative * the larger magnitude of the two.
struct Tolerance {
  double absolute = 0.0, relative = 0.0;
};

struct Column {
  std::string name;
  std::string unit;
  ColumnKind kind;
  Better better;
  std::string text;
  std::optional<Comparison> comparison = {};  // empty: by kind, see below
  Tolerance tolerance = {};
};

// As declared; else keys identify, metrics and counts are compared, times are not.
inline Comparison comparison_of(const Column& column) {
  if (column.comparison) return *column.comparison;
  if (column.kind == ColumnKind::key) return Comparison::identity;
  return column.kind == ColumnKind::time ? Comparison::none : Comparison::value;
}

// One frozen point of a sweep: every parameter of the experiment has a value.
struct Point {
  std::string id;  // 16 hexadecimal digits: hash of the experiment, all parameters, the seed and the scene
  std::map<std::string, Value> parameters;

  bool boolean(const std::string& name) const { return std::get<bool>(parameters.at(name)); }
  int64_t integer(const std::string& name) const { return std::get<int64_t>(parameters.at(name)); }
  double number(const std::string& name) const { return std::get<double>(parameters.at(name)); }
  const std::string& text(const std::string& name) const {
    return std::get<std::string>(parameters.at(name));
  }
};

// One row: cells by column name. Columns left out stay empty.
using Row = std::map<std::string, Value>;

// What a run lends to the experiments: cached scenes, the folder for pictures, and settings of the whole run.
class Workspace;

// What a sweep must know about a scene, and what costs depend on besides the parameters of a point.
struct SceneFacts {
  uint64_t content_hash = 0;
  uint64_t triangles = 0;
  std::vector<std::string> cameras;
  uint64_t lights = 0;
  double specular_share = 0.0;  // about how much of all directions specular surfaces take up, seen from a
                                // light; sum over the lights
};

// Work that a point does once for itself and for every later point with the same key.
struct SharedCost {
  std::string key;
  double seconds = 0.0;  // on two cores
};

struct Experiment {
  std::string name;
  std::string text;
  std::vector<Parameter> parameters;
  std::vector<Column> columns;
  std::function<Row(const Point&, Workspace&)> run;
  // Main memory that a point needs, bytes, from its parameters alone; a point that needs more than there is
  // fails before any work.
  std::function<double(const Point&)> memory_bytes;
  // Rough cost of a point, seconds on two cores, for `hybray points` and the progress line.
  std::function<double(const Point&, const SceneFacts&)> cost_seconds;
  // What comes on top for the first of the points that share it: scenes, references.
  std::function<std::vector<SharedCost>(const Point&, const SceneFacts&)> shared_costs = nullptr;
};

// Every experiment of this build.
std::span<const Experiment> experiments();

// The one of that name among them, or nullptr.
const Experiment* find_experiment(const std::string& name,
                                  std::span<const Experiment> experiments = hybray::experiments());

}  // namespace hybray
