// fresnel.h in many lanes at once, operation by operation the same. Per-target code (lanes-inl.h).
#if defined(HYBRAY_FRESNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRAY_FRESNEL_INL_H_
#undef HYBRAY_FRESNEL_INL_H_
#else
#define HYBRAY_FRESNEL_INL_H_
#endif

#include "core/base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybray::optics {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using hybray::HWY_NAMESPACE::Vec3Lanes;

template <class V>
struct RefractionLanes {
  V reflectance, eta_cos;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE RefractionLanes<V> refraction_at(D d, V cos_incident, V eta) {
  const V one = hn::Set(d, 1.0), zero = hn::Zero(d);
  const V cos_i = hn::Min(one, hn::Max(zero, cos_incident));
  const V g2 = hn::Sub(hn::Mul(eta, eta), hn::Sub(one, hn::Mul(cos_i, cos_i)));
  const auto refracts = hn::Gt(g2, zero);
  const V g = hn::Sqrt(hn::Max(g2, zero)), ee = hn::Mul(hn::Mul(eta, eta), cos_i);
  const V s = hn::Add(cos_i, g), p = hn::Add(ee, g);
  const V inverse = hn::Div(one, hn::Mul(s, p));
  const V rs = hn::Mul(hn::Mul(hn::Sub(cos_i, g), p), inverse);
  const V rp = hn::Mul(hn::Mul(hn::Sub(ee, g), s), inverse);
  const V reflectance = hn::Mul(hn::Set(d, 0.5), hn::Add(hn::Mul(rs, rs), hn::Mul(rp, rp)));
  return {hn::IfThenElse(refracts, reflectance, one), hn::IfThenElseZero(refracts, g)};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V fresnel_conductor(D d, V cos_incident, V eta, V k) {
  const V one = hn::Set(d, 1.0), zero = hn::Zero(d), half = hn::Set(d, 0.5), two = hn::Set(d, 2.0);
  const V cos_i = hn::Min(one, hn::Max(zero, cos_incident));
  const V cos2 = hn::Mul(cos_i, cos_i), sin2 = hn::Sub(one, cos2);
  const V difference = hn::Sub(hn::Sub(hn::Mul(eta, eta), hn::Mul(k, k)), sin2);
  const V product = hn::Mul(hn::Mul(hn::Mul(hn::Mul(hn::Set(d, 4.0), eta), eta), k), k);
  const V a2_b2 = hn::Sqrt(hn::Add(hn::Mul(difference, difference), product));
  const V a = hn::Sqrt(hn::Max(zero, hn::Mul(half, hn::Add(a2_b2, difference))));
  const V s_sum = hn::Add(a2_b2, cos2), s_mix = hn::Mul(hn::Mul(two, a), cos_i);
  const V rs = hn::Div(hn::Sub(s_sum, s_mix), hn::Add(s_sum, s_mix));
  const V p_sum = hn::Add(hn::Mul(cos2, a2_b2), hn::Mul(sin2, sin2)), p_mix = hn::Mul(s_mix, sin2);
  const V sum = hn::Add(p_sum, p_mix);
  const V ratio = hn::IfThenElse(hn::Gt(sum, zero), hn::Div(hn::Sub(p_sum, p_mix), sum), one);
  return hn::Mul(hn::Mul(half, rs), hn::Add(one, ratio));
}

template <class V>
HWY_INLINE Vec3Lanes<V> reflected(const Vec3Lanes<V>& direction, const Vec3Lanes<V>& n) {
  const hn::DFromV<V> d;
  const V twice = hn::Mul(hn::Set(d, 2.0), dot(direction, n));
  return subtract(direction, scale(twice, n));
}

template <class V>
HWY_INLINE Vec3Lanes<V> refracted(const Vec3Lanes<V>& direction, const Vec3Lanes<V>& n, const V cos_i,
                                  const V inverse_eta, const V eta_cos) {
  const hn::DFromV<V> d;
  const Vec3Lanes<V> v = scale(inverse_eta, add(direction, scale(hn::Sub(cos_i, eta_cos), n)));
  return scale(hn::Sub(hn::Set(d, 1.5), hn::Mul(hn::Set(d, 0.5), dot(v, v))), v);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray::optics
HWY_AFTER_NAMESPACE();

#endif
