// What is in a cache's folder: an entry is a folder named by the hash of its key, with a file for each part.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hybray {

// The folder of a key's entry, and the file of one of its parts.
std::filesystem::path entry_folder(const std::filesystem::path& cache, const std::string& key);
std::filesystem::path part_file(const std::filesystem::path& entry, uint32_t part);

// Held while parts of an entry are made or an entry is removed, so that of several processes one works and
// the others wait for it. Nothing depends on it but that: where a file system has no locks, work is done
// twice. The system lets go of it when its process ends.
class EntryLock {
 public:
  // Does not wait; see held(). Makes the entry's folder where it can.
  explicit EntryLock(const std::filesystem::path& entry);
  ~EntryLock();
  EntryLock(const EntryLock&) = delete;
  EntryLock& operator=(const EntryLock&) = delete;

  bool held() const { return held_; }
  bool busy() const { return file_ >= 0 && !held_; }  // another process has it
  void wait();                                        // where it is busy

 private:
  int file_ = -1;
  bool held_ = false;
};

struct CacheEntry {
  std::filesystem::path folder;
  std::string key;                           // empty where no part has a readable header
  std::vector<std::filesystem::path> parts;  // in order
  uint64_t bytes = 0;                        // of all files
  std::filesystem::file_time_type used;
};

// All entries, the least recently used first; none where the folder is not there or cannot be read. Keys are
// read only where asked for.
std::vector<CacheEntry> cache_entries(const std::filesystem::path& cache, bool with_keys = false);

// Removes what the cache has made of an entry, and its folder if that is all there is. Returns whether it is
// gone; an entry that another process works on stays.
bool remove_entry(const CacheEntry& entry);

}  // namespace hybray
