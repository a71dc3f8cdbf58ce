// The commands of the program, each from its options to its exit code. Data on stdout or in files, messages
// on stderr.
#pragma once

#include "core/scene/scene_library.h"
#include "harness/experiments/experiment.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hybray {

enum ExitCode : int { kOk = 0, kGateFailed = 1, kUsage = 2, kSomeFailed = 3, kInterrupted = 130 };

// What every command works with.
struct Environment {
  std::span<const Experiment> experiments;
  std::filesystem::path root;  // the project's
  ScenePaths scene_paths;
};

struct RunOptions {
  std::vector<std::string> configs, assignments, filters;
  std::optional<std::string> output;
  bool timing = true;
  int threads = 0;  // 0: all
  bool quiet = false;
};
int run_command(const Environment& environment, const RunOptions& options);

struct PointsOptions {
  std::string config;
  std::vector<std::string> assignments, filters;
};
int points_command(const Environment& environment, const PointsOptions& options);

enum class DescribeFormat { text, schema, markdown };
struct DescribeOptions {
  std::string experiment;  // empty: list all
  DescribeFormat format = DescribeFormat::text;
};
int describe_command(const Environment& environment, const DescribeOptions& options);

struct SceneRenderOptions {
  std::string scene;
  std::string camera;  // empty: the scene's first
  std::string resolution = "1280x720";
  std::string file;  // empty: SCENE-CAMERA.png
};
int scene_list_command(const Environment& environment);
int scene_info_command(const Environment& environment, const std::string& scene);
int scene_export_command(const Environment& environment, const std::string& scene, const std::string& file);
int scene_render_command(const Environment& environment, const SceneRenderOptions& options);

// Reports on the program, the machine and what figures and report need. kUsage where no run could work.
int doctor_command(const Environment& environment);

}  // namespace hybray
