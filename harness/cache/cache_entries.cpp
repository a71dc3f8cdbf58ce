#include "harness/cache/cache_entries.h"

#include "core/base/hash.h"
#include "harness/cache/cache_part.h"

#include <algorithm>
#include <cerrno>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace hybray {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockFile = "lock";

bool is_entry_name(std::string_view name) {
  return name.size() == 16 && name.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_ours(const fs::path& file) {
  return file.extension() == ".part" || file.extension() == ".tmp" || file.filename() == kLockFile;
}

std::vector<fs::path> children(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error))
    found.push_back(i->path());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

fs::path entry_folder(const fs::path& cache, const std::string& key) {
  return cache / "references" / hex(hash_text(key));
}

fs::path part_file(const fs::path& entry, uint32_t part) {
  return entry / fmt::format("{:04}.part", part);
}

EntryLock::EntryLock(const fs::path& entry) {
  std::error_code ignored;
  fs::create_directories(entry, ignored);
  file_ = open((entry / kLockFile).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) return;
  if (flock(file_, LOCK_EX | LOCK_NB) == 0) {
    held_ = true;
  } else if (errno != EWOULDBLOCK) {
    close(file_);  // no locks here
    file_ = -1;
  }
}

void EntryLock::wait() {
  while (busy()) {
    if (flock(file_, LOCK_EX) == 0)
      held_ = true;
    else if (errno != EINTR)
      return;
  }
}

EntryLock::~EntryLock() {
  if (file_ >= 0) close(file_);
}

std::vector<CacheEntry> cache_entries(const fs::path& cache, bool with_keys) {
  std::vector<CacheEntry> entries;
  for (const fs::path& folder : children(cache / "references")) {
    std::error_code error;
    if (!is_entry_name(folder.filename().string()) || !fs::is_directory(folder, error)) continue;
    CacheEntry entry;
    entry.folder = folder;
    entry.used = fs::last_write_time(folder, error);
    for (const fs::path& file : children(folder)) {
      if (const uint64_t size = fs::file_size(file, error); !error) entry.bytes += size;
      if (file.extension() == ".part") entry.parts.push_back(file);
    }
    for (size_t i = 0; with_keys && entry.key.empty() && i < entry.parts.size(); ++i)
      entry.key = read_part_key(entry.parts[i]).value_or("");
    entries.push_back(std::move(entry));
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const CacheEntry& a, const CacheEntry& b) { return a.used < b.used; });
  return entries;
}

bool remove_entry(const CacheEntry& entry) {
  const EntryLock lock(entry.folder);
  if (lock.busy()) return false;
  std::error_code error;
  for (const fs::path& file : children(entry.folder))
    if (is_ours(file)) fs::remove(file, error);
  fs::remove(entry.folder, error);
  return !fs::exists(entry.folder, error);
}

}  // namespace hybray
