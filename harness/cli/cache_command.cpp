#include "core/base/error.h"
#include "harness/cache/cache_entries.h"
#include "harness/cache/cache_folder.h"
#include "harness/cache/cache_part.h"
#include "harness/cli/commands.h"
#include "harness/cli/log.h"
#include "harness/sweep/memory.h"

#include <algorithm>
#include <chrono>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace hybray {
namespace {

std::string local_time(std::filesystem::file_time_type time) {
  const auto system = std::chrono::file_clock::to_sys(time);
  const auto seconds = std::chrono::floor<std::chrono::seconds>(system.time_since_epoch()).count();
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(static_cast<std::time_t>(seconds)));
}

std::string name_of(const CacheEntry& entry) {
  return entry.folder.filename().string();
}

// The entries that the prefixes name, all of them without any. Throws InputError for a prefix of none.
std::vector<CacheEntry> chosen(std::vector<CacheEntry> entries, const std::vector<std::string>& prefixes) {
  if (prefixes.empty()) return entries;
  std::vector<CacheEntry> found;
  for (const std::string& prefix : prefixes)
    if (std::none_of(entries.begin(), entries.end(),
                     [&](const CacheEntry& e) { return name_of(e).starts_with(prefix); }))
      throw InputError(prefix, "the cache has no entry whose hash begins so (see hybray cache list)");
  std::copy_if(entries.begin(), entries.end(), std::back_inserter(found), [&](const CacheEntry& e) {
    return std::any_of(prefixes.begin(), prefixes.end(),
                       [&](const std::string& prefix) { return name_of(e).starts_with(prefix); });
  });
  return found;
}

}  // namespace

std::filesystem::path cache_folder(const Environment& environment, const CacheOptions& options) {
  return options.folder ? std::filesystem::path(*options.folder) : default_cache_folder(environment.root);
}

int cache_list_command(const Environment& environment, const CacheOptions& options) {
  const std::filesystem::path folder = cache_folder(environment, options);
  const std::vector<CacheEntry> entries = cache_entries(folder, true);
  uint64_t total = 0;
  for (const CacheEntry& entry : entries) {
    fmt::print("{}  {:>4} batches  {:>8}  {}  {}\n", name_of(entry), entry.parts.size(),
               format_bytes(static_cast<double>(entry.bytes)), local_time(entry.used), entry.key);
    total += entry.bytes;
  }
  log_info(fmt::format("{} references, {} of at most {} in {}", entries.size(),
                       format_bytes(static_cast<double>(total)),
                       format_bytes(static_cast<double>(options.max_bytes)), folder.string()));
  return kOk;
}

int cache_check_command(const Environment& environment, const CacheOptions& options) {
  const std::filesystem::path folder = cache_folder(environment, options);
  size_t good = 0, damaged = 0;
  for (const CacheEntry& entry : cache_entries(folder)) {
    for (const std::filesystem::path& file : entry.parts) {
      const CachePart part = read_part(file);
      good += part.state == PartState::good;
      if (part.state != PartState::damaged) continue;
      ++damaged;
      std::error_code error;
      const bool removed = std::filesystem::remove(file, error);
      log_warning(fmt::format("{}: {}{}", file.string(), part.problem, removed ? "; removed" : ""));
    }
  }
  log_info(fmt::format("{} batches are good, {} were damaged in {}", good, damaged, folder.string()));
  return damaged > 0 ? kGateFailed : kOk;
}

int cache_clear_command(const Environment& environment, const CacheOptions& options,
                        const std::vector<std::string>& prefixes) {
  const std::filesystem::path folder = cache_folder(environment, options);
  size_t removed = 0, kept = 0;
  uint64_t bytes = 0;
  for (const CacheEntry& entry : chosen(cache_entries(folder), prefixes)) {
    if (remove_entry(entry)) {
      ++removed, bytes += entry.bytes;
    } else {
      ++kept;
      log_error(fmt::format("{} stays: a run works on it, or it cannot be removed", entry.folder.string()));
    }
  }
  log_info(fmt::format("{} references removed, {}, from {}", removed,
                       format_bytes(static_cast<double>(bytes)), folder.string()));
  return kept > 0 ? kSomeFailed : kOk;
}

}  // namespace hybray
