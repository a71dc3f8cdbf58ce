#include "harness/config/suite.h"

#include "core/base/nearest_name.h"
#include "harness/config/config_check.h"
#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"
#include "harness/config/schema.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const std::vector<std::string> kKeys = {"$schema", "title", "text", "configs"};
const std::vector<std::string> kEntryKeys = {"config", "set", "filter"};

// A value as it would stand on the command line. Text that could be taken for a list there becomes one.
std::string assignment_text(const Json& value) {
  if (!value.is_string()) return value.dump();
  const auto& text = value.get_ref<const std::string&>();
  const bool plain = text.find(',') == std::string::npos && !text.starts_with('[') && !text.starts_with('{');
  return plain ? text : Json::array({value}).dump();
}

// Reads one suite and collects its problems.
class Reader {
 public:
  Reader(const JsonSource& source, const fs::path& file) : source_(source), folder_(file.parent_path()) {}

  Suite run() {
    Suite suite;
    for (const auto& [key, value] : source_.root().items()) {
      const std::string pointer = child_pointer("", key);
      if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
        at_key(pointer, unknown_name("key", key, kKeys));
      } else if (key == "configs") {
        configs(pointer, value, suite.entries);
      } else if (!value.is_string()) {
        at_value(pointer, fmt::format("found {}; expected text", found_text(value)));
      }
    }
    if (problems_.empty()) {
      for (const SchemaViolation& violation : schema_violations(suite_schema(), source_.root()))
        at_value(violation.pointer, violation.message);
    }
    throw_problems(problems_);
    suite.title = source_.root().value("title", "");
    suite.text = source_.root().value("text", "");
    return suite;
  }

 private:
  void at_value(const std::string& pointer, const std::string& message) {
    problems_.push_back({source_.place(pointer), message});
  }
  void at_key(const std::string& pointer, const std::string& message) {
    problems_.push_back({source_.key_place(pointer), message});
  }

  void configs(const std::string& pointer, const Json& list, std::vector<SuiteEntry>& entries) {
    if (!list.is_array() || list.empty()) {
      at_value(pointer, fmt::format("found {}; expected a list [...] of configs",
                                    list.is_array() ? "an empty list" : found_text(list)));
      return;
    }
    for (size_t i = 0; i < list.size(); ++i) entry(child_pointer(pointer, i), list[i], entries);
  }

  void entry(const std::string& pointer, const Json& json, std::vector<SuiteEntry>& entries) {
    SuiteEntry entry{{}, source_.place(pointer), {}, {}};
    if (json.is_string()) {
      config(pointer, json, entry, entries);
    } else if (!json.is_object()) {
      at_value(pointer, fmt::format("found {}; expected the path of a config, or an object {{...}}",
                                    found_text(json)));
    } else {
      if (!json.contains("config"))
        at_value(pointer, "the key \"config\" is missing: it gives the config's path");
      for (const auto& [key, value] : json.items()) {
        const std::string member = child_pointer(pointer, key);
        if (key == "config")
          config(member, value, entry, entries);
        else if (key == "set")
          assignments(member, value, entry.assignments);
        else if (key == "filter")
          assignments(member, value, entry.filters);
        else
          at_key(member, unknown_name("key", key, kEntryKeys));
      }
    }
    entries.push_back(std::move(entry));
  }

  void config(const std::string& pointer, const Json& json, SuiteEntry& entry,
              const std::vector<SuiteEntry>& before) {
    if (!json.is_string() || json.get_ref<const std::string&>().empty()) {
      at_value(pointer, fmt::format("found {}; expected the path of a config", found_text(json)));
      return;
    }
    entry.config = folder_ / fs::path(json.get<std::string>());
    std::error_code error;
    if (!fs::is_regular_file(entry.config, error)) {
      at_value(pointer, fmt::format("there is no config {}{}", entry.config.string(), near(json)));
    }
    for (const SuiteEntry& other : before) {
      if (other.config.stem() != entry.config.stem()) continue;
      at_value(pointer, fmt::format("a config named \"{}\" stands in this list before, at {}",
                                    entry.config.stem().string(), other.place));
    }
  }

  // Suggests a file of the same folder.
  std::string near(const Json& wanted) const {
    const fs::path path(wanted.get<std::string>());
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& file : fs::directory_iterator("." / folder_ / path.parent_path(), error)) {
      if (file.path().extension() == ".json")
        names.push_back((path.parent_path() / file.path().filename()).string());
    }
    std::sort(names.begin(), names.end());
    const std::string nearest = nearest_name(path.string(), names);
    return nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest);
  }

  void assignments(const std::string& pointer, const Json& object, std::vector<Assignment>& result) {
    if (!object.is_object()) {
      at_value(pointer, fmt::format("found {}; expected an object {{...}}", found_text(object)));
      return;
    }
    for (const auto& [key, value] : object.items()) {
      const std::string member = child_pointer(pointer, key);
      if (value.is_null())
        at_value(member, "found null; expected a value, a list [...] of values or a range {...}");
      else
        result.push_back({key, assignment_text(value), source_.place(member)});
    }
  }

  const JsonSource& source_;
  const fs::path folder_;
  std::vector<Problem> problems_;
};

}  // namespace

bool is_suite(const JsonSource& source) {
  return source.root().is_object() && source.root().contains("configs") &&
         !source.root().contains("experiment");
}

Suite read_suite(const JsonSource& source, const std::filesystem::path& file) {
  return Reader(source, file).run();
}

}  // namespace hybray
