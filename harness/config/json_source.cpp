#include "harness/config/json_source.h"

#include "core/base/error.h"
#include "harness/table/files.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

constexpr size_t kMaxDepth = 64;
constexpr size_t kMaxBytes = size_t{16} << 20;

// "file:line:column" of a byte of the text.
std::string position(const std::string& name, std::string_view text, size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return fmt::format("{}:{}:{}", name, line, before.size() - line_start + 1);
}

// Listens to the parser and walks over the same text alongside: between two events only white space, commas
// and colons can stand.
class PositionRecorder : public nlohmann::json_sax<nlohmann::json> {
 public:
  PositionRecorder(const std::string& text, const std::string& name, std::map<std::string, size_t>& values,
                   std::map<std::string, size_t>& keys)
      : text_(text), name_(name), values_(values), keys_(keys) {
    if (text.starts_with("\xef\xbb\xbf")) next_ = 3;  // a byte order mark, which the parser skips too
  }

  bool null() override { return scalar(); }
  bool boolean(bool) override { return scalar(); }
  bool number_integer(number_integer_t) override { return scalar(); }
  bool number_unsigned(number_unsigned_t) override { return scalar(); }
  bool number_float(number_float_t, const string_t&) override { return scalar(); }
  bool string(string_t&) override { return scalar(); }
  bool binary(binary_t&) override { return scalar(); }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    const size_t offset = take_token();
    Level& level = levels_.back();
    const std::string pointer = child_pointer(level.pointer, key);
    if (!level.keys.insert(key).second) {
      throw InputError(position(name_, text_, offset) + " (" + pointer + ")",
                       fmt::format("the key \"{}\" stands twice in this object; its first place is {}", key,
                                   position(name_, text_, keys_.at(pointer))));
    }
    keys_[pointer] = offset;
    level.member = pointer;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) override {
    std::string reason = error.what();
    const auto* syntax = dynamic_cast<const nlohmann::json::parse_error*>(&error);
    const size_t offset = !syntax ? take_token() : syntax->byte > 0 ? syntax->byte - 1 : 0;
    // The library's own "[json.exception...] parse error at line 1, column 2: " goes: the place stands before
    // the message already.
    if (const size_t end = reason.find("] "); end != std::string::npos) reason.erase(0, end + 2);
    if (const size_t end = reason.find(": "); reason.starts_with("parse error") && end != std::string::npos) {
      reason.erase(0, end + 2);
    }
    if (text_.empty())
      reason = "the file is empty";  // in our words: the library's differ from version to version
    throw InputError(position(name_, text_, offset), "this is not JSON: " + reason);
  }

 private:
  struct Level {
    std::string pointer;
    bool is_array;
    size_t count = 0;            // values so far, of an array
    std::string member;          // pointer of the value that follows, of an object
    std::set<std::string> keys;  // so far, of an object
  };

  // Start of the token that the parser just read; steps over it.
  size_t take_token() {
    next_ = std::min(text_.find_first_not_of(" \t\r\n,:", next_), text_.size());
    const size_t start = next_;
    if (start == text_.size()) return start;
    if (text_[start] == '"') {
      for (++next_; next_ < text_.size() && text_[next_] != '"'; ++next_) next_ += text_[next_] == '\\';
      ++next_;
    } else if (std::string_view("{}[]").find(text_[start]) != std::string_view::npos) {
      ++next_;
    } else {
      next_ = std::min(text_.find_first_of(" \t\r\n,:]}", start), text_.size());
    }
    return start;
  }

  std::string record_value() {
    const size_t offset = take_token();
    std::string pointer;
    if (!levels_.empty()) {
      Level& level = levels_.back();
      pointer = level.is_array ? child_pointer(level.pointer, level.count++) : level.member;
    }
    values_[pointer] = offset;
    return pointer;
  }

  bool scalar() {
    record_value();
    return true;
  }

  bool open(bool is_array) {
    const size_t offset = next_;
    levels_.push_back({record_value(), is_array, 0, {}, {}});
    if (levels_.size() > kMaxDepth) {
      throw InputError(position(name_, text_, offset),
                       fmt::format("objects and lists are nested more than {} deep here", kMaxDepth));
    }
    return true;
  }

  bool close() {
    take_token();
    levels_.pop_back();
    return true;
  }

  const std::string& text_;
  const std::string& name_;
  std::map<std::string, size_t>&values_, &keys_;
  std::vector<Level> levels_;
  size_t next_ = 0;
};

}  // namespace

std::string child_pointer(const std::string& pointer, const std::string& key) {
  std::string result = pointer + '/';
  for (const char c : key) {
    if (c == '~')
      result += "~0";
    else if (c == '/')
      result += "~1";
    else
      result += c;
  }
  return result;
}

std::string child_pointer(const std::string& pointer, size_t index) {
  return fmt::format("{}/{}", pointer, index);
}

JsonSource::JsonSource(const std::string& text, std::string name) : name_(std::move(name)), text_(text) {
  PositionRecorder recorder(text_, name_, value_offsets_, key_offsets_);
  nlohmann::json::sax_parse(text_, &recorder);
  root_ = std::make_unique<nlohmann::ordered_json>(nlohmann::ordered_json::parse(text_));
}

JsonSource::~JsonSource() = default;
JsonSource::JsonSource(JsonSource&&) noexcept = default;

JsonSource JsonSource::read(const std::filesystem::path& file) {
  return JsonSource(read_file(file, kMaxBytes), file.string());
}

const nlohmann::ordered_json& JsonSource::root() const {
  return *root_;
}

std::string JsonSource::place(const std::string& pointer) const {
  return describe(pointer, value_offsets_);
}

std::string JsonSource::key_place(const std::string& pointer) const {
  return describe(pointer, key_offsets_);
}

std::string JsonSource::describe(const std::string& pointer,
                                 const std::map<std::string, size_t>& offsets) const {
  const auto found = offsets.find(pointer);
  if (found == offsets.end() && !pointer.empty()) return place(pointer.substr(0, pointer.rfind('/')));
  const size_t offset = found == offsets.end() ? 0 : found->second;
  const std::string brackets = pointer.empty() ? "" : " (" + pointer + ")";
  return position(name_, text_, offset) + brackets;
}

}  // namespace hybray
