// Reading the fields of structs that the lanes of a vector point to. Per-target code (lanes-inl.h).
#if defined(HYBRAY_FIELDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRAY_FIELDS_INL_H_
#undef HYBRAY_FIELDS_INL_H_
#else
#define HYBRAY_FIELDS_INL_H_
#endif

#include "core/base/lanes-inl.h"
#include "core/base/vec.h"

HWY_BEFORE_NAMESPACE();
namespace hybray {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The value in the first lane of a mask that has one.
template <class V, class M>
HWY_INLINE hn::TFromV<V> first_of(V v, M mask) {
  const hn::DFromV<V> d;
  alignas(64) hn::TFromV<V> values[hn::MaxLanes(d)];
  hn::Store(v, d, values);
  return values[hn::FindFirstTrue(d, hn::RebindMask(d, mask))];
}

// Fields of the structs that the lanes of a mask point to: gathered, or read once where all of them point to
// the same. The mask must have a lane.
template <class D, class Struct>
class Fields {
  using DU = hn::RebindToUnsigned<D>;
  using DI = hn::RebindToSigned<D>;
  using V = hn::Vec<D>;
  using VU = hn::Vec<DU>;
  using VI = hn::Vec<DI>;

 public:
  HWY_INLINE Fields(const std::vector<Struct>& structs, VI index, hn::Mask<D> lanes)
      : first_(structs.data()), at_(hn::Mul(index, hn::Set(DI(), kStride))) {
    const int64_t some = first_of(index, lanes);
    one_ = first_ + some;
    const auto same = hn::RebindMask(D(), hn::Eq(index, hn::Set(DI(), some)));
    uniform_ = hn::AllFalse(D(), hn::AndNot(same, lanes));
  }
  HWY_INLINE V operator()(double Struct::*field) const {
    return uniform_ ? hn::Set(D(), one_->*field) : hn::GatherIndex(D(), &(first_->*field), at_);
  }
  HWY_INLINE VU operator()(uint64_t Struct::*field) const {
    return uniform_ ? hn::Set(DU(), one_->*field) : hn::GatherIndex(DU(), &(first_->*field), at_);
  }
  HWY_INLINE Vec3Lanes<V> operator()(dvec3 Struct::*field) const {
    return {component(field, 0), component(field, 1), component(field, 2)};
  }
  HWY_INLINE V element(double (Struct::*field)[2], int i) const {
    return uniform_ ? hn::Set(D(), (one_->*field)[i]) : hn::GatherIndex(D(), &(first_->*field)[i], at_);
  }

 private:
  static constexpr int64_t kStride = sizeof(Struct) / sizeof(double);
  static_assert(sizeof(Struct) % sizeof(double) == 0);
  HWY_INLINE V component(dvec3 Struct::*field, int c) const {
    return uniform_ ? hn::Set(D(), (one_->*field)[c]) : hn::GatherIndex(D(), &(first_->*field)[c], at_);
  }

  const Struct *first_, *one_;
  VI at_;
  bool uniform_;
};

}  // namespace HWY_NAMESPACE
}  // namespace hybray
HWY_AFTER_NAMESPACE();

#endif
