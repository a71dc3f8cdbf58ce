#include "core/scene/file_input.h"

#include "core/base/error.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

namespace hybray {
namespace fs = std::filesystem;
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decoded(const std::string& uri, const std::string& where) {
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : -1;
    if (high < 0 || low < 0 || high + low == 0)
      throw InputError(where, fmt::format("the URI '{}' has a bad percent code", uri));
    text += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return text;
}

bool starts_with(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

std::vector<unsigned char> read_file_bytes(const fs::path& file, const std::string& where, size_t max_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw InputError(where, fmt::format("there is no file '{}'", file.string()));
  if (!fs::is_regular_file(status))
    throw InputError(where, fmt::format("'{}' is not a regular file", file.string()));
  const uintmax_t size = fs::file_size(file, error);
  if (error) throw InputError(where, fmt::format("cannot read '{}': {}", file.string(), error.message()));
  if (size > max_bytes)
    throw InputError(where,
                     fmt::format("'{}' has {} bytes; at most {} are read", file.string(), size, max_bytes));
  std::vector<unsigned char> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream || static_cast<uintmax_t>(stream.gcount()) != size)
    throw InputError(where, fmt::format("cannot read '{}'", file.string()));
  return bytes;
}

fs::path confined_path(const fs::path& folder, const std::string& uri, const std::string& where) {
  const std::string text = percent_decoded(uri, where);
  const auto refuse = [&](const char* why) {
    throw InputError(where,
                     fmt::format("the URI '{}' {}; only files in the scene's own folder are read", uri, why));
  };
  if (text.empty() || text.find('\0') != std::string::npos || text.find('\\') != std::string::npos)
    refuse("is not a relative path");
  const fs::path relative(text);
  if (relative.is_absolute()) refuse("is an absolute path");
  if (text.find(':') < text.find('/')) refuse("has a scheme");
  if (*relative.lexically_normal().begin() == "..") refuse("leaves the folder");

  std::error_code error;
  const fs::path root = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
  if (error)
    throw InputError(where, fmt::format("cannot open the folder '{}': {}", folder.string(), error.message()));
  const fs::path file = fs::weakly_canonical(root / relative, error);
  if (error) throw InputError(where, fmt::format("cannot open '{}': {}", uri, error.message()));
  if (!starts_with(file, root)) refuse("leaves the folder through a symbolic link");
  return file;
}

}  // namespace hybray
