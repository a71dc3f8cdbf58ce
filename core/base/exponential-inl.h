// exponential.h in many lanes at once, operation by operation the same. Per-target code (lanes-inl.h).
#if defined(HYBRAY_EXPONENTIAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRAY_EXPONENTIAL_INL_H_
#undef HYBRAY_EXPONENTIAL_INL_H_
#else
#define HYBRAY_EXPONENTIAL_INL_H_
#endif

#include "core/base/exponential.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybray {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
HWY_INLINE V exp_of_negative(V x) {
  const hn::DFromV<V> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const V shift = hn::Set(d, exponential::kWhole);
  const V whole = hn::Add(hn::Mul(x, hn::Set(d, exponential::kLog2E)), shift), n = hn::Sub(whole, shift);
  const V r = hn::Sub(hn::Sub(x, hn::Mul(n, hn::Set(d, exponential::kLn2High))),
                      hn::Mul(n, hn::Set(d, exponential::kLn2Low)));
  const auto pair = [&](int k) HWY_ATTR {
    return hn::Add(hn::Set(d, exponential::kTaylor[k]), hn::Mul(hn::Set(d, exponential::kTaylor[k + 1]), r));
  };
  const V r2 = hn::Mul(r, r);
  const V sum = hn::Add(hn::Add(pair(0), hn::Mul(pair(2), r2)),
                        hn::Mul(hn::Add(pair(4), hn::Mul(pair(6), r2)), hn::Mul(r2, r2)));
  const V scaled = hn::BitCast(d, hn::Add(hn::BitCast(du, sum), hn::ShiftLeft<23>(hn::BitCast(du, whole))));
  return hn::IfThenElseZero(hn::Ge(x, hn::Set(d, exponential::kSmallest)), scaled);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray
HWY_AFTER_NAMESPACE();

#endif
