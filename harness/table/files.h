// Whole files: read, and written so that a reader sees either the old content or the new, never half of it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hybray {

// The whole file. Throws InputError with the system's reason where it cannot be read, or is larger than
// `max_bytes`.
std::string read_file(const std::filesystem::path& file, size_t max_bytes = size_t{1} << 30);

// Writes `content` beside `file` and renames it into place. Throws RuntimeError with the system's reason;
// `file` is then as it was.
void replace_file(const std::filesystem::path& file, std::string_view content);

// Makes the folder if it is not there and proves that a file can be made in it. Throws InputError with the
// system's reason.
void make_writable_folder(const std::filesystem::path& folder);

}  // namespace hybray
