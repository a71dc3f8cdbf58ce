// The random numbers of hash.h in many lanes at once, bit by bit the same. Per-target code (lanes-inl.h).
#if defined(HYBRAY_HASH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRAY_HASH_INL_H_
#undef HYBRAY_HASH_INL_H_
#else
#define HYBRAY_HASH_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybray {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
HWY_INLINE V mix_bits(V x) {
  const hn::DFromV<V> d;
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<30>(x)), hn::Set(d, 0xbf58476d1ce4e5b9ull));
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<27>(x)), hn::Set(d, 0x94d049bb133111ebull));
  return hn::Xor(x, hn::ShiftRight<31>(x));
}

// What random_bits makes of the item and the seed, the same for all dimensions.
template <class V>
HWY_INLINE V random_stream(V item, uint64_t seed) {
  const hn::DFromV<V> d;
  return mix_bits(hn::Add(item, hn::Set(d, 0x9e3779b97f4a7c15ull * (seed + 1))));
}

template <class V>
HWY_INLINE V random_bits(V stream, V dimension) {
  const hn::DFromV<V> d;
  return mix_bits(hn::Xor(stream, hn::Mul(hn::ShiftLeft<32>(dimension), hn::Set(d, 0xd6e8feb86659fd93ull))));
}

template <class D, class V>
HWY_INLINE hn::Vec<D> random_unit(D d, V stream, V dimension) {
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, hn::ShiftRight<11>(random_bits(stream, dimension)));
  return hn::Mul(hn::ConvertTo(d, bits), hn::Set(d, 0x1.0p-53));
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray
HWY_AFTER_NAMESPACE();

#endif
