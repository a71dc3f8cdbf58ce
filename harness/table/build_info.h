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
  std::string sources;  // git's names of core/ and harness/ as built; empty where files there differed or git
                        // knows nothing
  std::string build_type, compiler, flags;
  std::vector<std::pair<std::string, std::string>> libraries;  // name and version
};

BuildInfo build_info();

// 16 hexadecimal digits that stand for the program as far as they shape results: the sources, the compiler
// and its flags, the libraries. Commits that touch neither core/ nor harness/ leave it alone. Where git does
// not know the sources as they were built, the content of the program's own file stands for them.
std::string program_identity();

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
