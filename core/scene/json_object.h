// A JSON object read strictly: unknown keys, wrong types and values out of range are errors that name the
// file and the JSON pointer.
#pragma once

#include "core/base/vec.h"

#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

// A closed interval of numbers that are accepted.
struct Range {
  double lower = -std::numeric_limits<float>::max(), upper = std::numeric_limits<float>::max();
};

class JsonObject {
 public:
  // `value` must outlive this. Throws InputError("file: pointer", ...) if it is not an object or has a key
  // other than `known`; the message names the nearest known key.
  JsonObject(const nlohmann::json& value, std::string file, std::string pointer,
             std::initializer_list<const char*> known);

  bool has(const char* key) const;
  const nlohmann::json& value(const char* key) const;  // throws if there is none

  // The value of `key`. The second form returns `otherwise` where it is absent.
  std::string text(const char* key) const;
  std::string text(const char* key, const std::string& otherwise) const;
  double number(const char* key, Range range = {}) const;
  double number(const char* key, double otherwise, Range range) const;
  int64_t integer(const char* key, int64_t otherwise, Range range) const;
  bool boolean(const char* key, bool otherwise) const;
  vec3 vector(const char* key, Range range = {}) const;  // an array of three numbers
  vec3 vector(const char* key, const vec3& otherwise, Range range = {}) const;

  // The elements of an array, none where the key is absent, and the pointer of one of them.
  std::vector<const nlohmann::json*> elements(const char* key) const;
  std::string pointer(const char* key) const;
  std::string pointer(const char* key, size_t element) const;

  const std::string& file() const { return file_; }
  std::string where(const char* key) const;
  [[noreturn]] void fail(const char* key, const std::string& message) const;

 private:
  const nlohmann::json& value_;
  std::string file_, pointer_;
};

}  // namespace hybray
