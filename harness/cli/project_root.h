// Where the project's configs and scenes are.
#pragma once

#include <filesystem>

namespace hybray {

// The folder that the environment variable HYBRAY_ROOT names; else the nearest folder with scenes/ and
// configs/ in it, looked for from the present folder upward, then from the program's own folder upward; else
// the present folder. Throws InputError where HYBRAY_ROOT names no folder.
std::filesystem::path find_project_root();

}  // namespace hybray
