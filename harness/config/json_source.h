// A JSON file together with where each of its values stands, for messages with line and column.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

class JsonSource {
 public:
  // Parses `text`; `name` stands in messages. Throws InputError with line and column for a syntax error, a
  // key that stands twice in one object, and nesting deeper than any config needs.
  JsonSource(const std::string& text, std::string name);
  ~JsonSource();
  JsonSource(JsonSource&&) noexcept;

  // The same for a file; throws InputError where it cannot be read.
  static JsonSource read(const std::filesystem::path& file);

  const nlohmann::ordered_json& root() const;

  // "file.json:12:7 (/sweep/scene/2)": where the value at this JSON pointer begins, lines and columns (in
  // bytes) from 1. The place of the nearest parent that is there, for a pointer that is not; no pointer in
  // brackets for the whole document.
  std::string place(const std::string& pointer) const;

  // The same for the key of the member at this JSON pointer.
  std::string key_place(const std::string& pointer) const;

 private:
  std::string describe(const std::string& pointer, const std::map<std::string, size_t>& offsets) const;

  std::string name_;
  std::string text_;
  std::unique_ptr<nlohmann::ordered_json> root_;
  std::map<std::string, size_t> value_offsets_, key_offsets_;  // in bytes, by JSON pointer
};

// `pointer` with one more step into an object or array, escaped as RFC 6901 says.
std::string child_pointer(const std::string& pointer, const std::string& key);
std::string child_pointer(const std::string& pointer, size_t index);

}  // namespace hybray
