// Where the cache is when nobody says.
#pragma once

#include <filesystem>

namespace hybray {

// hybray in XDG_CACHE_HOME (where that is an absolute path), else in .cache of HOME; results/cache of the
// project where none of these can be written to. Makes nothing.
std::filesystem::path default_cache_folder(const std::filesystem::path& project_root);

}  // namespace hybray
