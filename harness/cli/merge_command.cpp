#include "harness/cli/commands.h"
#include "harness/cli/log.h"
#include "harness/sweep/merge.h"

#include <fmt/format.h>

namespace hybray {

int merge_command(const Environment& environment, const MergeOptions& options) {
  const std::vector<std::filesystem::path> folders(options.folders.begin(), options.folders.end());
  const MergeResult result =
      merge_tables(environment.experiments, folders, options.output, options.allow_missing);
  for (const std::string& warning : result.warnings) log_warning(warning);
  if (result.missing > 0)
    log_warning(fmt::format("{} of {} points have no row", result.missing, result.points));
  log_info(fmt::format("{} points -> {}", result.points - result.missing, result.table.string()));
  return kOk;
}

}  // namespace hybray
