// Vectors of three in many lanes at once, over Google Highway. Per-target code: included inside
// HWY_BEFORE_NAMESPACE() again for every instruction set, so there is no #pragma once.
//
// Products and sums are rounded one by one and in the order of GLM's scalar code: every instruction set gives
// the same bits, and the same as the scalar code.
#if defined(HYBRAY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRAY_LANES_INL_H_
#undef HYBRAY_LANES_INL_H_
#else
#define HYBRAY_LANES_INL_H_
#endif

#include "core/base/lane_order.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybray {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Vec3Lanes {
  V x, y, z;
};

template <class V>
HWY_INLINE Vec3Lanes<V> add(const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class V>
HWY_INLINE Vec3Lanes<V> subtract(const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V>
HWY_INLINE Vec3Lanes<V> multiply(const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
template <class V>
HWY_INLINE Vec3Lanes<V> scale(const V s, const Vec3Lanes<V>& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
template <class V>
HWY_INLINE V dot(const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
// a where the mask is set, else b.
template <class M, class V>
HWY_INLINE Vec3Lanes<V> select(const M mask, const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return {hn::IfThenElse(mask, a.x, b.x), hn::IfThenElse(mask, a.y, b.y), hn::IfThenElse(mask, a.z, b.z)};
}
// The negative of a where the mask is set.
template <class M, class V>
HWY_INLINE Vec3Lanes<V> negate_where(const M mask, const Vec3Lanes<V>& a) {
  return {hn::IfThenElse(mask, hn::Neg(a.x), a.x), hn::IfThenElse(mask, hn::Neg(a.y), a.y),
          hn::IfThenElse(mask, hn::Neg(a.z), a.z)};
}

// Brings the lanes of a mask to the front, for vectors of at most eight lanes. What a mask's order is gets
// worked out once, however many vectors follow; Highway's Compress would do it for each, and loads its tables
// anew. No branch on how many there are: a mask is known late, and a wrong guess would throw away the work on
// the lanes that come next.
template <class D>
class LanePacking {
 public:
  static constexpr size_t kMostLanes = 8;

  HWY_INLINE explicit LanePacking(hn::Mask<D> mask) {
    uint8_t bits[8] = {};
    hn::StoreMaskBits(D(), mask, bits);
    order_ = kLaneOrder[bits[0]];
    count_ = hn::CountTrue(D(), mask);
  }
  HWY_INLINE size_t count() const { return count_; }
  template <class V>
  HWY_INLINE V packed(V v) const {
    const hn::RebindToUnsigned<hn::DFromV<V>> d;
    static_assert(decltype(d)::kPrivateN <= kMostLanes);
    using T = hn::TFromD<decltype(d)>;
    const auto lane =
        hn::And(hn::Shr(hn::Set(d, static_cast<T>(order_)), hn::Mul(hn::Iota(d, 0), hn::Set(d, T{4}))),
                hn::Set(d, T{7}));
    return hn::TableLookupLanes(v, hn::IndicesFromVec(hn::DFromV<V>(), lane));
  }

 private:
  uint32_t order_;
  size_t count_;
};

}  // namespace HWY_NAMESPACE
}  // namespace hybray
HWY_AFTER_NAMESPACE();

#endif
