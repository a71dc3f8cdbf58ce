#include "harness/table/folder_lock.h"

#include "core/base/error.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hybray {
namespace {

// Whether the descriptor's file still has that name. A holder removes the file as it lets go; whoever had
// opened it before would then hold a lock that nobody else sees.
bool is_still_named(int descriptor, const std::filesystem::path& file) {
  struct stat open_file = {}, named = {};
  return fstat(descriptor, &open_file) == 0 && stat(file.c_str(), &named) == 0 &&
         open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

std::string content_of(int descriptor) {
  char text[32] = {};
  const ssize_t count = pread(descriptor, text, sizeof text - 1, 0);
  return count > 0 ? std::string(text, static_cast<size_t>(count)) : "unknown";
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : file_(folder / ".hybray.lock") {
  while (descriptor_ < 0) {
    const int descriptor = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) throw InputError(file_.string(), std::string("cannot be made: ") + strerror(errno));
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
      if (is_still_named(descriptor, file_))
        descriptor_ = descriptor;
      else
        close(descriptor);
      continue;
    }
    const int reason = errno;
    const std::string holder = content_of(descriptor);
    close(descriptor);
    throw InputError(folder.string(),
                     reason == EWOULDBLOCK
                         ? fmt::format("another run (process {}) is writing to this folder", holder)
                         : std::string("the folder cannot be locked: ") + strerror(reason));
  }
  const std::string process = fmt::format("{}", getpid());
  if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, process.data(), process.size(), 0) < 0) {
    // The number only helps people to find the holder; the lock holds without it.
  }
}

FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);  // while the lock still holds
  close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

}  // namespace hybray
