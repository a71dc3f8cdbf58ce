#include "harness/sweep/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <unistd.h>

namespace hybray {
namespace {

// The first number of a one-line file such as a cgroup's memory.max; infinity where there is none ("max", or
// no such file).
double number_in(const char* file) {
  double number = 0;
  return std::ifstream(file) >> number ? number : std::numeric_limits<double>::infinity();
}

double system_available() {
  std::ifstream info("/proc/meminfo");
  std::string key, unit;
  double kibibytes = 0;
  while (info >> key >> kibibytes && std::getline(info, unit)) {
    if (key == "MemAvailable:") return kibibytes * 1024;
  }
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace

double available_memory_bytes() {
  // A container may be allowed less than the machine has.
  return std::min(system_available(), number_in("/sys/fs/cgroup/memory.max"));
}

std::string format_bytes(double bytes) {
  const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  size_t unit = 0;
  while (bytes >= 1024 && unit + 1 < std::size(units)) bytes /= 1024, ++unit;
  return bytes < 10 && unit > 0 ? fmt::format("{:.1f} {}", bytes, units[unit])
                                : fmt::format("{:.0f} {}", bytes, units[unit]);
}

}  // namespace hybray
