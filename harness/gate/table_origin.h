// What the manifest beside a table says of its making, as far as a check needs it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hybray {

struct TableOrigin {
  std::string experiment;         // its name
  std::string config;             // name of the config file, without a folder
  std::optional<int64_t> points;  // that the run should have rows for
};

// Nothing where no manifest.json is beside the table, or that of a table of another name. Throws InputError
// with the place for a manifest that is damaged.
std::optional<TableOrigin> find_origin(const std::filesystem::path& table);

}  // namespace hybray
