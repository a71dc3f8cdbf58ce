// One run at a time in a folder.
#pragma once

#include <filesystem>

namespace hybray {

// Holds FOLDER/.hybray.lock, by flock, until it is destroyed; the file is then removed. A lock ends with its
// process however that ends, so that a file left behind by a killed one locks nothing.
class FolderLock {
 public:
  // The folder must be there. Throws InputError where another process (or this one) holds the lock, naming
  // it, or where the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace hybray
