// What this program was built from and with, and what it runs on: the provenance of every number it writes.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hybray {

struct BuildInfo {
  std::string version;     // of the project
  std::string git_commit;  // 40 hexadecimal digits, or "unknown"
  bool git_dirty = false;  // tracked files differed from that commit
  std::string build_type, compiler, flags;
  std::vector<std::pair<std::string, std::string>> libraries;  // name and version
};

BuildInfo build_info();

// "hybray 0.1.0 (0123456789ab, dirty)".
std::string version_line();

struct MachineInfo {
  std::string cpu;                    // model name
  std::vector<std::string> features;  // instruction sets that matter here and that the CPU has
  int hardware_threads = 0;
  double memory_bytes = 0;
};

MachineInfo machine_info();

}  // namespace hybray
