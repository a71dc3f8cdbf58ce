#include "harness/gate/table_origin.h"

#include "core/base/error.h"
#include "harness/config/json_source.h"
#include "harness/config/json_value.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

std::string text_at(const JsonSource& source, const std::string& pointer) {
  const Json::json_pointer at(pointer);
  const Json value = source.root().contains(at) ? source.root()[at] : Json();
  if (value.is_string() && !value.get_ref<const std::string&>().empty()) return value;
  throw InputError(source.place(pointer), fmt::format("this is no manifest: found {} at {}; expected text",
                                                      found_text(value), pointer));
}

}  // namespace

std::optional<TableOrigin> find_origin(const std::filesystem::path& table) {
  const std::filesystem::path file = table.parent_path() / "manifest.json";
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  const JsonSource source = JsonSource::read(file);
  TableOrigin origin{text_at(source, "/config/experiment"), text_at(source, "/config/file"), {}};
  const std::filesystem::path config(origin.config);
  if (config.filename() != config)
    throw InputError(source.place("/config/file"),
                     "this is no manifest: the config's name has a folder in it");
  if (config.stem() != table.stem()) return std::nullopt;
  const Json::json_pointer points("/run/points");
  if (source.root().contains(points) && source.root()[points].is_number_integer())
    origin.points = source.root()[points];
  return origin;
}

}  // namespace hybray
