#include "harness/table/files.h"

#include "core/base/error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fmt/format.h>
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
  if (!out || std::fwrite(content.data(), 1, content.size(), out.get()) != content.size()) fail();
  if (std::fclose(out.release()) != 0) fail();
  if (std::rename(temporary.c_str(), file.c_str()) != 0) fail();
}

void make_writable_folder(const std::filesystem::path& folder) {
  const auto fail = [&](const std::string& reason) {
    throw InputError(folder.string(), "the output folder cannot be written to: " + reason);
  };
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail(error.message());
  const std::filesystem::path probe = temporary_beside(folder / "probe");
  if (!open_file(probe, "wb")) fail(std::strerror(errno));
  std::remove(probe.c_str());
}

}  // namespace hybray
