// Converged references on disk, in parts that are pure functions of a key and a number, so that whatever is
// there can be used and more can be added. A cache that cannot be written to, damaged files and other
// processes cost time, never a wrong answer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace hybray {

class EntryLock;

class ReferenceCache {
 public:
  static constexpr uint64_t kDefaultBytes = uint64_t{4} << 30;

  struct Settings {
    std::filesystem::path folder;
    uint64_t max_bytes = kDefaultBytes;                    // of all entries; 0: nothing is kept
    std::function<void(const std::string&)> warn, inform;  // must be set
  };

  explicit ReferenceCache(Settings settings);

  // What was saved, or nothing. A damaged file is removed, with a warning. Counts as a use of the entry.
  std::optional<std::string> load(const std::string& key, uint32_t part);

  // Keeps a part; the least recently used entries go where it would be too much. What cannot be kept is told
  // once.
  void save(const std::string& key, uint32_t part, std::string_view content);

  // To be held from looking for a part to saving it: waits, and says so, while another process makes parts of
  // that key.
  std::unique_ptr<EntryLock> lock(const std::string& key);

 private:
  bool make_room(const std::filesystem::path& entry, uint64_t bytes);
  void cannot_keep(const std::string& reason);

  Settings settings_;
  bool told_ = false;
};

}  // namespace hybray
