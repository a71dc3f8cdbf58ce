#include "harness/table/files.h"

#include "core/base/error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hybray {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open_file(const std::filesystem::path& path, const char* mode) {
  return File(std::fopen(path.c_str(), mode), &std::fclose);
}

// A name beside `file` that no other process uses.
std::filesystem::path temporary_beside(const std::filesystem::path& file) {
  return fmt::format("{}.{}.tmp", file.string(), getpid());
}

// Whether temporary_beside made this name, in whatever process.
bool is_temporary(const std::filesystem::path& file) {
  const std::string process = file.stem().extension().string();  // ".1234"
  return file.extension() == ".tmp" && process.size() > 1 &&
         process.find_first_not_of("0123456789", 1) == std::string::npos;
}

bool write_all(std::FILE* file, std::string_view content) {
  return std::fwrite(content.data(), 1, content.size(), file) == content.size() && std::fflush(file) == 0;
}

// Makes a rename last through a loss of power, where the file system can.
void sync_folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

std::string read_file(const std::filesystem::path& file, size_t max_bytes) {
  const auto fail = [&](const std::string& reason) -> InputError {
    return {file.string(), "cannot be read: " + reason};
  };
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw fail("it is a folder");
  const File in = open_file(file, "rb");
  if (!in) throw fail(std::strerror(errno));
  std::string content;
  char buffer[1 << 16];
  while (const size_t count = std::fread(buffer, 1, sizeof buffer, in.get())) {
    content.append(buffer, count);
    if (content.size() > max_bytes) throw fail(fmt::format("it is larger than {} bytes", max_bytes));
  }
  if (std::ferror(in.get())) throw fail(std::strerror(errno));
  return content;
}

void replace_file(const std::filesystem::path& file, std::string_view content) {
  const std::filesystem::path temporary = temporary_beside(file);
  const auto fail = [&] {
    const std::string reason = std::strerror(errno);
    std::remove(temporary.c_str());
    throw RuntimeError(file.string() + ": cannot be written: " + reason);
  };
  File out = open_file(temporary, "wb");
  if (!out || !write_all(out.get(), content) || fsync(fileno(out.get())) != 0) fail();
  if (std::fclose(out.release()) != 0) fail();
  if (std::rename(temporary.c_str(), file.c_str()) != 0) fail();
  sync_folder_of(file);
}

void make_writable_folder(const std::filesystem::path& folder, size_t bytes) {
  const auto fail = [&](const std::string& reason) {
    throw InputError(folder.string(), "the output folder cannot be written to: " + reason);
  };
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail(error.message());
  const std::filesystem::path probe = temporary_beside(folder / "probe");
  File out = open_file(probe, "wb");
  if (!out) fail(std::strerror(errno));
  // Written and not only looked up: a quota or a limit of the process shows in no count of free bytes.
  const bool fits = write_all(out.get(), std::string(bytes, ' '));
  const int reason = errno;
  out.reset();
  std::remove(probe.c_str());
  if (!fits) fail(fmt::format("{} (about {} bytes are needed)", std::strerror(reason), bytes));
}

void remove_unfinished_files(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (is_temporary(entry.path())) std::filesystem::remove(entry.path(), ignored);
  }
}

double modified_unix_s(const std::filesystem::path& file) {
  struct stat facts = {};
  if (stat(file.c_str(), &facts) != 0) return 0;
  return static_cast<double>(facts.st_mtim.tv_sec) + 1e-9 * static_cast<double>(facts.st_mtim.tv_nsec);
}

}  // namespace hybray
