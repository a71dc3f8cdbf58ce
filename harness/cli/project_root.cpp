#include "harness/cli/project_root.h"

#include "core/base/error.h"

#include <cstdlib>
#include <optional>

namespace hybray {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> search_upward(fs::path folder) {
  std::error_code error;
  while (true) {
    if (fs::is_directory(folder / "scenes", error) && fs::is_directory(folder / "configs", error))
      return folder;
    if (!folder.has_relative_path()) return std::nullopt;
    folder = folder.parent_path();
  }
}

}  // namespace

fs::path find_project_root() {
  std::error_code error;
  if (const char* root = std::getenv("HYBRAY_ROOT"); root && *root) {
    if (!fs::is_directory(root, error))
      throw InputError(root, "HYBRAY_ROOT names a folder that is not there");
    return root;
  }
  const fs::path here = fs::current_path(error);
  if (const auto root = search_upward(here)) return *root;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    if (const auto root = search_upward(program.parent_path())) return *root;
  }
  return here;
}

}  // namespace hybray
