#include "core/scene/json_text.h"

#include "core/base/error.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

constexpr int kMaxDepth = 64;

std::string place(std::string_view text, size_t byte, const std::string& file) {
  const std::string_view before = text.substr(0, byte);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const size_t start = before.rfind('\n');
  return fmt::format("{}:{}:{}", file, line, start == before.npos ? byte + 1 : byte - start);
}

void check_depth(std::string_view text, const std::string& file) {
  int depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxDepth)
        throw InputError(place(text, i, file), fmt::format("nested deeper than {} levels", kMaxDepth));
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

// The library's message without its id and without its own words for the place.
std::string plain_message(const std::string& what) {
  const size_t column = what.find("column ");
  const size_t colon = what.find(": ", column == what.npos ? 0 : column);
  if (column != what.npos && colon != what.npos) return what.substr(colon + 2);
  const size_t id = what.find("] ");
  return id == what.npos ? what : what.substr(id + 2);
}

}  // namespace

nlohmann::json parse_json(std::string_view text, const std::string& file) {
  check_depth(text, file);
  try {
    return nlohmann::json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::parse_error& error) {
    const size_t byte = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    throw InputError(place(text, byte, file), "not valid JSON: " + plain_message(error.what()));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file, "not valid JSON: " + plain_message(error.what()));
  }
}

}  // namespace hybray
