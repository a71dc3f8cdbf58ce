// The commands of the program, each from its options to its exit code. Data on stdout or in files, messages
// on stderr.
#pragma once

#include "core/scene/scene_library.h"
#include "harness/cache/reference_cache.h"
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

struct CacheOptions {
  std::optional<std::string> folder;
  uint64_t max_bytes = ReferenceCache::kDefaultBytes;
};

struct RunOptions {
  std::vector<std::string> configs, assignments, filters;
  std::optional<std::string> output;
  std::string shard;   // "I/N"; empty: all points
  bool fresh = false;  // start over
  bool timing = true;
  int threads = 0;  // 0: all
  bool quiet = false;
  bool use_cache = true;
  CacheOptions cache;
};
int run_command(const Environment& environment, const RunOptions& options);

enum class PointsFormat { text, csv, json };
struct PointsOptions {
  std::vector<std::string> configs, assignments, filters;
  std::string shard;  // as in RunOptions
  PointsFormat format = PointsFormat::text;
};
int points_command(const Environment& environment, const PointsOptions& options);

struct MergeOptions {
  std::vector<std::string> folders;
  std::string output;
  bool allow_missing = false;
};
int merge_command(const Environment& environment, const MergeOptions& options);

struct CheckOptions {
  std::vector<std::string> tables;
  std::optional<std::string> gates;     // config or file of gates; empty: the config that the manifest names
  std::optional<std::string> baseline;  // folder of the accepted tables; empty: the project's
  std::optional<std::string> junit, markdown;  // files to write; of check_command
};
int check_command(const Environment& environment, const CheckOptions& options);
int accept_command(const Environment& environment, const CheckOptions& options);

enum class DescribeFormat { text, schema, markdown, gate_schema };
struct DescribeOptions {
  std::string experiment;  // empty: list all
  DescribeFormat format = DescribeFormat::text;
};
int describe_command(const Environment& environment, const DescribeOptions& options);

// An entry is named by the first digits of its hash.
int cache_list_command(const Environment& environment, const CacheOptions& options);
int cache_check_command(const Environment& environment, const CacheOptions& options);
int cache_clear_command(const Environment& environment, const CacheOptions& options,
                        const std::vector<std::string>& entries);  // none: all of them
std::filesystem::path cache_folder(const Environment& environment, const CacheOptions& options);

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
