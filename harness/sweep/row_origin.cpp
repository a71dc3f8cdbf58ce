#include "harness/sweep/row_origin.h"

#include "harness/table/build_info.h"

#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hybray {

RowOrigin row_origin(bool timing, int threads) {
  const MachineInfo machine = machine_info();
  RowOrigin origin{{"program", program_identity()},
                   {"instruction_sets", fmt::format("{}", fmt::join(machine.features, " "))},
                   {"threads", fmt::format("{}", threads)},
                   {"timing", timing ? "true" : "false"}};
  if (timing) origin["cpu"] = machine.cpu;
  return origin;
}

std::string difference(const RowOrigin& a, const RowOrigin& b) {
  std::set<std::string> names;
  for (const auto* origin : {&a, &b}) {
    for (const auto& [name, value] : *origin) names.insert(name);
  }
  const auto same = [&](const std::string& name) {
    const auto in_a = a.find(name), in_b = b.find(name);
    return in_a != a.end() && in_b != b.end() && in_a->second == in_b->second;
  };
  std::erase_if(names, same);
  if (names.contains("timing")) names.erase("cpu");  // named only with timing
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace hybray
