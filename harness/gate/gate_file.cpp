#include "harness/gate/gate_file.h"

#include "core/base/error.h"
#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"
#include "harness/config/schema.h"
#include "harness/gate/gate_rules.h"
#include "harness/gate/gate_schema.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kKeys = {"$schema", "title", "text", "gates"};

std::vector<Problem> file_problems(const JsonSource& source, const Experiment& experiment) {
  std::vector<Problem> problems;
  for (const auto& [key, value] : source.root().items()) {
    const std::string pointer = child_pointer("", key);
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      problems.push_back({source.key_place(pointer), unknown_name("key", key, kKeys)});
    } else if (key == "gates") {
      const std::vector<Problem> found = gate_problems(source, pointer, experiment);
      problems.insert(problems.end(), found.begin(), found.end());
    } else if (!value.is_string()) {
      problems.push_back({source.place(pointer), fmt::format("found {}; expected text", found_text(value))});
    }
  }
  if (!problems.empty()) return problems;
  for (const SchemaViolation& violation :
       schema_violations(gate_file_schema({&experiment, 1}), source.root()))
    problems.push_back({source.place(violation.pointer), violation.message});
  return problems;
}

}  // namespace

GateFile load_gates(const std::filesystem::path& file, std::span<const Experiment> experiments,
                    const Experiment* experiment) {
  const JsonSource source = JsonSource::read(file);
  const Json& root = source.root();
  if (!root.is_object())
    throw InputError(source.place(""), fmt::format("found {}; expected an object {{...}}", found_text(root)));
  if (root.contains("experiment")) {
    const Experiment& own = experiment_of(source, experiments);
    if (experiment && experiment != &own) {
      throw InputError(source.place("/experiment"),
                       fmt::format("the config is of the experiment \"{}\", the table of \"{}\"", own.name,
                                   experiment->name));
    }
    throw_problems(config_problems(source, own));
    return {&own, gates_from(root.value("gates", Json::array()), own)};
  }
  if (!root.contains("gates"))
    throw InputError(source.place(""), "neither a config (\"experiment\") nor gates (\"gates\")");
  if (!experiment) {
    throw InputError(
        file.string(),
        "which experiment the table is of is not known: no manifest.json is beside it, and these gates "
        "name none");
  }
  throw_problems(file_problems(source, *experiment));
  return {experiment, gates_from(root["gates"], *experiment)};
}

}  // namespace hybray
