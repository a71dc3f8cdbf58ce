// One file of the cache: bytes, the key that they belong to, and a checksum over both. Layout: docs/cache.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace hybray {

enum class PartState { good, missing, damaged };

struct CachePart {
  PartState state = PartState::missing;
  std::string key, content;  // where it is good
  std::string problem;       // where it is damaged: what is wrong
};

// Never throws for what is on disk: a file that cannot be read is damaged.
CachePart read_part(const std::filesystem::path& file);

// The key alone, without looking at the checksum; nothing where there is no readable header.
std::optional<std::string> read_part_key(const std::filesystem::path& file);

// Bytes that the file of a part takes.
uint64_t part_file_bytes(std::string_view key, std::string_view content);

// Appears by rename, whole or not at all. Throws RuntimeError with the system's reason.
void write_part(const std::filesystem::path& file, std::string_view key, std::string_view content);

}  // namespace hybray
