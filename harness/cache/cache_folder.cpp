#include "harness/cache/cache_folder.h"

#include <cstdlib>
#include <optional>

#include <unistd.h>

namespace hybray {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> user_cache() {
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && fs::path(xdg).is_absolute())
    return fs::path(xdg) / "hybray";
  if (const char* home = std::getenv("HOME"); home && fs::path(home).is_absolute())
    return fs::path(home) / ".cache" / "hybray";
  return std::nullopt;
}

// Whether the folder could be made, or files in it: its nearest parent that is there decides.
bool can_be_written(fs::path folder) {
  std::error_code error;
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  return fs::is_directory(folder, error) && access(folder.c_str(), W_OK | X_OK) == 0;
}

}  // namespace

fs::path default_cache_folder(const fs::path& project_root) {
  const std::optional<fs::path> user = user_cache();
  return user && can_be_written(*user) ? *user : project_root / "results" / "cache";
}

}  // namespace hybray
