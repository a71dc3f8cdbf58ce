#include "core/base/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

namespace hybray {

uint64_t hash_bytes(const void* data, size_t size, uint64_t seed) {
  return XXH3_64bits_withSeed(data, size, seed);
}

std::string hex(uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

}  // namespace hybray
