// A suite: configs that are run together, each with changes of its own.
#pragma once

#include "harness/config/assignment.h"
#include "harness/config/json_source.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hybray {

struct SuiteEntry {
  std::filesystem::path config;
  std::string place;  // where the suite names it
  std::vector<Assignment> assignments, filters;
};

struct Suite {
  std::string title, text;
  std::vector<SuiteEntry> entries;
};

// Whether a document is a suite and no config: it lists "configs" and names no experiment.
bool is_suite(const JsonSource& source);

// The suite of `file`, from whose folder its configs are named. Throws InputError with every problem on a
// line of its own: what the schema rejects, a config that is not there, two of one name. What "set" and
// "filter" ask for is checked when it meets its config.
Suite read_suite(const JsonSource& source, const std::filesystem::path& file);

}  // namespace hybray
