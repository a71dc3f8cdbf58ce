// Content hashes (xxHash, 64 bit) and the counter-based random numbers made from a hash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace hybray {

// Hash of bytes, chained by `seed`: hash(b, hash(a)) covers both.
uint64_t hash_bytes(const void* data, size_t size, uint64_t seed = 0);

inline uint64_t hash_text(std::string_view text, uint64_t seed = 0) {
  return hash_bytes(text.data(), text.size(), seed);
}

template <class T>
uint64_t hash_span(std::span<const T> values, uint64_t seed = 0) {
  return hash_bytes(values.data(), values.size_bytes(), seed);
}

// 16 lower-case hexadecimal digits.
std::string hex(uint64_t hash);

// One step of a 64-bit mixing function (the finaliser of MurmurHash3 with Stafford's constants "Mix13").
inline uint64_t mix_bits(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// Counter-based random bits: a pure function of (item, dimension, sample, seed), so that results do not
// depend on threads or order.
inline uint64_t random_bits(uint64_t item, uint32_t dimension, uint32_t sample = 0, uint64_t seed = 0) {
  uint64_t x = mix_bits(item + 0x9e3779b97f4a7c15ull * (seed + 1));
  return mix_bits(x ^ (static_cast<uint64_t>(dimension) << 32 | sample) * 0xd6e8feb86659fd93ull);
}

// Uniform double in [0, 1) from the same counter.
inline double random_unit(uint64_t item, uint32_t dimension, uint32_t sample = 0, uint64_t seed = 0) {
  return static_cast<double>(random_bits(item, dimension, sample, seed) >> 11) * 0x1.0p-53;
}

}  // namespace hybray
