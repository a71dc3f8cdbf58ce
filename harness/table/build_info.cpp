#include "harness/table/build_info.h"

#include "core/base/hash.h"
#include "core/base/lanes.h"
#include "core/tracer/tracer.h"
#include "harness/table/files.h"
#include "hybray_build.h"  // made by CMake
#include "hybray_git.h"    // made at every build, changed only with the commit

#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

namespace hybray {

BuildInfo build_info() {
  BuildInfo info;
  info.version = HYBRAY_VERSION;
  info.git_commit = HYBRAY_GIT_COMMIT;
  info.git_dirty = HYBRAY_GIT_DIRTY != 0;
  info.sources = HYBRAY_GIT_SOURCES;
  info.build_type = HYBRAY_BUILD_TYPE;
  info.compiler = HYBRAY_COMPILER;
  info.flags = HYBRAY_FLAGS;
  info.libraries = {{"Embree", embree_version()},
                    {"OpenImageIO", HYBRAY_OIIO_VERSION},
                    {"GLM", HYBRAY_GLM_VERSION},
                    {"oneTBB", HYBRAY_TBB_VERSION},
                    {"nlohmann-json", HYBRAY_JSON_VERSION},
                    {"TinyGLTF", HYBRAY_TINYGLTF_VERSION},
                    {"Boost", HYBRAY_BOOST_VERSION},
                    {"CLI11", HYBRAY_CLI11_VERSION},
                    {"spdlog", HYBRAY_SPDLOG_VERSION},
                    {"fmt", HYBRAY_FMT_VERSION},
                    {"xxHash", HYBRAY_XXHASH_VERSION},
                    {"Highway", fmt::format("{}, {}", HYBRAY_HWY_VERSION, lanes_target())}};
  return info;
}

std::string program_identity() {
  const BuildInfo info = build_info();
  if (info.sources.empty()) return hex(hash_text(read_file("/proc/self/exe")));
  std::string text =
      fmt::format("{};{};{};{};{}", info.version, info.sources, info.build_type, info.compiler, info.flags);
  for (const auto& [name, version] : info.libraries) text += fmt::format(";{} {}", name, version);
  return hex(hash_text(text));
}

std::string version_line() {
  const BuildInfo info = build_info();
  return fmt::format("hybray {} ({}{})", info.version, info.git_commit.substr(0, 12),
                     info.git_dirty ? ", dirty" : "");
}

MachineInfo machine_info() {
  MachineInfo info;
  info.cpu = "unknown";
  std::ifstream cpus("/proc/cpuinfo");
  for (std::string line; std::getline(cpus, line);) {
    const size_t colon = line.find(": ");
    if (!line.starts_with("model name") || colon == std::string::npos) continue;
    info.cpu = line.substr(colon + 2);
    break;
  }
#if defined(__x86_64__)
  const std::pair<const char*, bool> features[] = {{"sse4.2", __builtin_cpu_supports("sse4.2") != 0},
                                                   {"avx", __builtin_cpu_supports("avx") != 0},
                                                   {"avx2", __builtin_cpu_supports("avx2") != 0},
                                                   {"fma", __builtin_cpu_supports("fma") != 0},
                                                   {"avx512f", __builtin_cpu_supports("avx512f") != 0}};
  for (const auto& [name, there] : features) {
    if (there) info.features.emplace_back(name);
  }
#endif
  info.hardware_threads = static_cast<int>(std::thread::hardware_concurrency());
  info.memory_bytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return info;
}

}  // namespace hybray
