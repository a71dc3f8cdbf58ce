// Where the pictures of a point are.
#pragma once

#include "harness/experiments/experiment.h"
#include "harness/experiments/workspace.h"

#include <algorithm>

namespace hybray {

// pictures/SCENE_CAMERA_WIDTHxHEIGHT_ID<suffix>.png below the run's folder. Makes that folder.
inline std::filesystem::path picture_file(const Point& point, const Workspace& workspace,
                                          const std::string& suffix = "") {
  const std::filesystem::path folder = workspace.settings().output / "pictures";
  std::filesystem::create_directories(folder);
  std::string camera = point.text("camera");
  std::replace(camera.begin(), camera.end(), '/', '-');  // of a seeded camera
  return folder / (point.text("scene") + "_" + camera + "_" + point.text("resolution") + "_" + point.id +
                   suffix + ".png");
}

}  // namespace hybray
