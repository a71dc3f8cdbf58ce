#include "harness/cache/reference_cache.h"

#include "core/base/error.h"
#include "harness/cache/cache_entries.h"
#include "harness/cache/cache_part.h"
#include "harness/table/files.h"

#include <utility>

#include <fmt/format.h>

namespace hybray {

namespace fs = std::filesystem;

ReferenceCache::ReferenceCache(Settings settings) : settings_(std::move(settings)) {}

std::optional<std::string> ReferenceCache::load(const std::string& key, uint32_t part) {
  const fs::path entry = entry_folder(settings_.folder, key), file = part_file(entry, part);
  CachePart found = read_part(file);
  std::error_code ignored;
  if (found.state == PartState::damaged) {
    settings_.warn(fmt::format("the cached reference {} is damaged and will be made again: {}", file.string(),
                               found.problem));
    fs::remove(file, ignored);
    return std::nullopt;
  }
  // Another key of the same hash: as good as nothing.
  if (found.state == PartState::missing || found.key != key) return std::nullopt;
  fs::last_write_time(entry, fs::file_time_type::clock::now(), ignored);
  return std::move(found.content);
}

void ReferenceCache::save(const std::string& key, uint32_t part, std::string_view content) {
  if (settings_.max_bytes == 0) return;
  const fs::path entry = entry_folder(settings_.folder, key);
  if (!make_room(entry, part_file_bytes(key, content))) {
    cannot_keep(fmt::format("{} bytes are too few", settings_.max_bytes));
    return;
  }
  std::error_code error;
  fs::create_directories(entry, error);
  if (error) {
    cannot_keep(error.message());
    return;
  }
  try {
    write_part(part_file(entry, part), key, content);
  } catch (const Error& failure) {
    cannot_keep(failure.what());
  }
}

std::unique_ptr<EntryLock> ReferenceCache::lock(const std::string& key) {
  if (settings_.max_bytes == 0) return nullptr;
  const fs::path entry = entry_folder(settings_.folder, key);
  auto lock = std::make_unique<EntryLock>(entry);
  if (lock->busy()) {
    settings_.inform("waiting for another run, which makes the same reference");
    lock->wait();
  }
  if (lock->held()) remove_unfinished_files(entry);  // of processes that were killed while they wrote
  return lock;
}

// Removes entries other than `entry`, the least recently used first, until `bytes` more fit; says whether
// they do.
bool ReferenceCache::make_room(const fs::path& entry, uint64_t bytes) {
  const std::vector<CacheEntry> entries = cache_entries(settings_.folder);
  uint64_t total = bytes, own = bytes;
  for (const CacheEntry& e : entries) {
    total += e.bytes;
    if (e.folder == entry) own += e.bytes;
  }
  if (own > settings_.max_bytes) return false;  // nothing is gained by removing the others
  for (const CacheEntry& e : entries) {
    if (total <= settings_.max_bytes) break;
    if (e.folder != entry && remove_entry(e)) total -= e.bytes;
  }
  return total <= settings_.max_bytes;
}

void ReferenceCache::cannot_keep(const std::string& reason) {
  if (std::exchange(told_, true)) return;
  settings_.warn(fmt::format("references cannot be kept in {}, and the run goes on without: {}",
                             settings_.folder.string(), reason));
}

}  // namespace hybray
