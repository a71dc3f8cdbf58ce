// Reading the files that a scene is made of: whole, and only from where a scene may read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hybray {

// The bytes of a regular file of at most `max_bytes`. Throws InputError(where, ...) if it is missing, not a
// regular file, or larger.
std::vector<unsigned char> read_file_bytes(const std::filesystem::path& file, const std::string& where,
                                           size_t max_bytes);

// The file that the relative URI `uri` (percent-encoded as in RFC 3986) names in `folder`. Throws
// InputError(where, ...) for a URI with a scheme, an absolute path, a bad percent code, or a path that leaves
// the folder, be it by ".." or through a symbolic link.
std::filesystem::path confined_path(const std::filesystem::path& folder, const std::string& uri,
                                    const std::string& where);

}  // namespace hybray
