// Whole files: read, and written so that a reader sees either the old content or the new, never half of it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hybray {

// The whole file. Throws InputError with the system's reason where it cannot be read, or is larger than
// `max_bytes`.
std::string read_file(const std::filesystem::path& file, size_t max_bytes = size_t{1} << 30);

// Writes `content` beside `file`, hands it to the disk and renames it into place: after a crash or a loss of
// power `file` holds the old content or the new. Throws RuntimeError with the system's reason; `file` is then
// as it was.
void replace_file(const std::filesystem::path& file, std::string_view content);

// Makes the folder if it is not there and proves, by writing and removing them, that a file of `bytes` bytes
// fits into it. Throws InputError with the system's reason.
void make_writable_folder(const std::filesystem::path& folder, size_t bytes = 0);

// Removes what a killed program had begun to write into `folder` and not yet renamed. Only for a folder that
// no other program is writing to.
void remove_unfinished_files(const std::filesystem::path& folder);

// When the file was last written to, seconds since 1970 (UTC); 0 where there is none.
double modified_unix_s(const std::filesystem::path& file);

}  // namespace hybray
