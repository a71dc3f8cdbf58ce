#include "harness/cache/cache_part.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "harness/table/files.h"

#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <limits>

#include <fmt/format.h>

namespace hybray {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers in the files are little-endian");

constexpr std::array<char, 8> kMagic{'h', 'y', 'b', 'r', 'c', 'a', 'c', 'h'};
constexpr uint32_t kFormat = 1;
constexpr uint32_t kLongestKey = 1 << 16;

struct Header {
  std::array<char, 8> magic = kMagic;
  uint32_t format = kFormat;
  uint32_t key_bytes = 0;
  uint64_t content_bytes = 0;
  uint64_t checksum = 0;  // of all above, the key and the content
};
static_assert(sizeof(Header) == 32);

uint64_t checksum(const Header& header, std::string_view key, std::string_view content) {
  return hash_text(content, hash_text(key, hash_bytes(&header, offsetof(Header, checksum))));
}

// What is wrong with a header; empty: nothing.
std::string header_problem(const Header& header) {
  if (header.magic != kMagic) return "it is not a file of the cache";
  if (header.format != kFormat) return fmt::format("its format is {}, not {}", header.format, kFormat);
  if (header.key_bytes > kLongestKey) return fmt::format("its key has {} bytes", header.key_bytes);
  return "";
}

}  // namespace

CachePart read_part(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return {};
  const auto damaged = [](std::string problem) {
    return CachePart{PartState::damaged, {}, {}, std::move(problem)};
  };
  CachePart part;
  try {
    part.content = read_file(file, std::numeric_limits<size_t>::max());
  } catch (const Error& unreadable) {
    // Removed by another process since: not damaged.
    if (!std::filesystem::exists(file, error) && !error) return {};
    return damaged(unreadable.what());
  }
  Header header;
  if (part.content.size() < sizeof header) return damaged("it is cut off in its header");
  std::memcpy(&header, part.content.data(), sizeof header);
  if (std::string problem = header_problem(header); !problem.empty()) return damaged(std::move(problem));
  const uint64_t rest = part.content.size() - sizeof header;
  if (rest < header.key_bytes || rest - header.key_bytes != header.content_bytes)
    return damaged(fmt::format("it has {} bytes after its header, not {} + {}", rest, header.key_bytes,
                               header.content_bytes));
  part.key = part.content.substr(sizeof header, header.key_bytes);
  part.content.erase(0, sizeof header + header.key_bytes);
  if (checksum(header, part.key, part.content) != header.checksum) return damaged("its checksum differs");
  part.state = PartState::good;
  return part;
}

std::optional<std::string> read_part_key(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Header header;
  if (!in.read(reinterpret_cast<char*>(&header), sizeof header) || !header_problem(header).empty())
    return std::nullopt;
  std::string key(header.key_bytes, '\0');
  if (!in.read(key.data(), static_cast<std::streamsize>(key.size()))) return std::nullopt;
  return key;
}

uint64_t part_file_bytes(std::string_view key, std::string_view content) {
  return sizeof(Header) + key.size() + content.size();
}

void write_part(const std::filesystem::path& file, std::string_view key, std::string_view content) {
  Header header;
  header.key_bytes = static_cast<uint32_t>(key.size());
  header.content_bytes = content.size();
  header.checksum = checksum(header, key, content);
  std::string bytes;
  bytes.reserve(part_file_bytes(key, content));
  bytes.append(reinterpret_cast<const char*>(&header), sizeof header).append(key).append(content);
  replace_file(file, bytes);
}

}  // namespace hybray
