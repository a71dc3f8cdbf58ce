// Surfaces that paths meet, in many lanes at once: their points, what they mirror and let through, and what
// becomes of a path there. Per-target code: included inside HWY_BEFORE_NAMESPACE() again for every
// instruction set, so there is no #pragma once.
#if defined(HYBRAY_SURFACE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRAY_SURFACE_LANES_INL_H_
#undef HYBRAY_SURFACE_LANES_INL_H_
#else
#define HYBRAY_SURFACE_LANES_INL_H_
#endif

#include "core/base/exponential-inl.h"
#include "core/base/fields-inl.h"
#include "core/base/hash-inl.h"
#include "core/base/lanes-inl.h"
#include "core/caustics/path_walk.h"
#include "core/optics/fresnel-inl.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace hybray::caustics {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using hybray::HWY_NAMESPACE::Vec3Lanes;

// At most eight doubles: sums over lanes are kept by lane of eight, so that they do not depend on the width.
constexpr size_t kMostLanes = 8;
using D = hn::CappedTag<double, kMostLanes>;
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using DF = hn::Rebind<float, D>;
using DF32I = hn::Rebind<int32_t, D>;
using DF32U = hn::Rebind<uint32_t, D>;
using V = hn::Vec<D>;
using VU = hn::Vec<DU>;
using VI = hn::Vec<DI>;
using VF = hn::Vec<DF>;
using VF32I = hn::Vec<DF32I>;
using M = hn::Mask<D>;
using Vec3 = Vec3Lanes<V>;
using Vec3f = Vec3Lanes<VF>;

// Terms of a FluxLedger, summed by lane.
struct LedgerLanes {
  enum Term { deposited, direct, absorbed, escaped, truncated, balance, kTerms };
  alignas(64) double sums[kTerms][kMostLanes] = {};

  HWY_INLINE void add(Term term, size_t first, M mask, V value) {
    const D d;
    double* place = &sums[term][first % kMostLanes];
    hn::Store(hn::Add(hn::Load(d, place), hn::IfThenElseZero(mask, value)), d, place);
  }
  double total(Term term) const {
    double sum = 0.0;
    for (const double lane : sums[term]) sum += lane;
    return sum;
  }
};

HWY_INLINE V mean(const Vec3& v) {
  return hn::Mul(hn::Add(hn::Add(v.x, v.y), v.z), hn::Set(D(), 1.0 / 3.0));
}
HWY_INLINE Vec3 promoted(const Vec3f& v) {
  const D d;
  return {hn::PromoteTo(d, v.x), hn::PromoteTo(d, v.y), hn::PromoteTo(d, v.z)};
}
HWY_INLINE Vec3f demoted(const Vec3& v) {
  const DF df;
  return {hn::DemoteTo(df, v.x), hn::DemoteTo(df, v.y), hn::DemoteTo(df, v.z)};
}
HWY_INLINE Vec3f load(const vec3* from) {
  Vec3f v;
  hn::LoadInterleaved3(DF(), &from->x, v.x, v.y, v.z);
  return v;
}
HWY_INLINE Vec3f load(const float* x, const float* y, const float* z) {
  const DF df;
  return {hn::Load(df, x), hn::Load(df, y), hn::Load(df, z)};
}
HWY_INLINE M flag(VU tag, uint64_t bits) {
  return hn::RebindMask(D(), hn::TestBit(tag, hn::Set(DU(), bits)));
}

// Lanes that are set, packed to the front of what they are stored to.
class Packed {
 public:
  HWY_INLINE explicit Packed(M mask) : packing_(mask) {}
  HWY_INLINE size_t count() const { return packing_.count(); }
  template <class V, class T>
  HWY_INLINE void store(V v, T* to) const {
    hn::StoreU(packing_.packed(v), hn::DFromV<V>(), to);
  }
  HWY_INLINE VF packed(VF v) const { return packing_.packed(v); }
  HWY_INLINE Vec3f packed(const Vec3f& v) const { return {packed(v.x), packed(v.y), packed(v.z)}; }
  HWY_INLINE void store(const Vec3f& v, float* x, float* y, float* z) const {
    store(v.x, x), store(v.y, y), store(v.z, z);
  }

 private:
  hybray::HWY_NAMESPACE::LanePacking<D> packing_;
};

// SurfaceTable::point and optics::facing.
struct Surface {
  Vec3 position;
  Vec3 geometric, shading;  // on the side of arrival
  V cos_incident, offset;
  M from_inner;
  VI material;
};

// What the table has of the triangles that one vector of paths met, copied together one vector ahead: loads
// of whole structs are several times cheaper than gathers of their fields, and the copies have settled by
// then.
struct StagedTriangles {
  using Entry = SurfaceTable::Entry;
  alignas(64) Entry entries[kMostLanes];
  alignas(64) vec3 normals[3][kMostLanes];  // of the vertices, where the lane's triangle is not flat
  bool all_flat = true;

  HWY_INLINE void stage(const SurfaceTable& table, const PathFront& from, size_t first, size_t lanes) {
    const Scene& scene = table.scene();
    all_flat = true;
    for (size_t lane = 0; lane < lanes && first + lane < from.count; ++lane) {
      const uint32_t primitive = from.hits.primitive[first + lane];
      if (primitive >= table.entries().size()) continue;
      entries[lane] = table.entries()[primitive];
      if (entries[lane].flat()) continue;
      all_flat = false;
      const uvec3& t = scene.triangles[primitive];
      normals[0][lane] = scene.normals[t.x], normals[1][lane] = scene.normals[t.y];
      normals[2][lane] = scene.normals[t.z];
    }
  }
};

HWY_INLINE Vec3f interpolated_normals(const StagedTriangles& staged, VF u, VF v) {
  const VF w = hn::Sub(hn::Sub(hn::Set(DF(), 1.0f), u), v);
  return add(add(scale(w, load(staged.normals[0])), scale(u, load(staged.normals[1]))),
             scale(v, load(staged.normals[2])));
}

// Halves of 64-bit lanes.
HWY_INLINE hn::Vec<DF32U> low_half(VU v) {
  return hn::TruncateTo(DF32U(), v);
}
HWY_INLINE hn::Vec<DF32U> high_half(VU v) {
  return hn::TruncateTo(DF32U(), hn::ShiftRight<32>(v));
}

HWY_INLINE Vec3 abs(const Vec3& v) {
  return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)};
}

HWY_INLINE Surface surface_at(const StagedTriangles& staged, VF u, VF v, const Vec3& hit,
                              const Vec3& direction, LeavingOffset leaving) {
  const D d;
  const DU du;
  const DF df;
  using Entry = SurfaceTable::Entry;
  static_assert(sizeof(Entry) == 4 * sizeof(double) && offsetof(Entry, plane) == 0 &&
                offsetof(Entry, normal) == 8 && offsetof(Entry, reach) == 20 &&
                offsetof(Entry, material_flat) == 24 && offsetof(Entry, normal_reach) == 28);
  VU plane_bits, normal_xy, normal_z_reach, material_flat;
  hn::LoadInterleaved4(du, reinterpret_cast<const uint64_t*>(staged.entries), plane_bits, normal_xy,
                       normal_z_reach, material_flat);
  const V plane = hn::BitCast(d, plane_bits);
  const Vec3f normal{hn::BitCast(df, low_half(normal_xy)), hn::BitCast(df, high_half(normal_xy)),
                     hn::BitCast(df, low_half(normal_z_reach))};
  const V reach = hn::PromoteTo(d, hn::BitCast(df, high_half(normal_z_reach)));
  const M flat = flag(material_flat, Entry::kFlat);

  Surface s;
  s.material = hn::BitCast(DI(), hn::And(material_flat, hn::Set(du, uint64_t{Entry::kFlat - 1})));
  const Vec3 n = promoted(normal);
  s.position = subtract(hit, scale(hn::Sub(dot(n, hit), plane), n));
  Vec3 shading = n;
  if (!staged.all_flat) {
    const Vec3f sum = interpolated_normals(staged, u, v);
    const VF length = hn::Sqrt(dot(sum, sum));
    const Vec3f unit = scale(hn::Div(hn::Set(df, 1.0f), length), sum);
    shading = select(flat, n, promoted(select(hn::Gt(length, hn::Set(df, 1e-6f)), unit, normal)));
  }
  const Vec3 size = abs(s.position);
  const V largest = hn::Max(hn::Max(size.x, size.y), size.z);
  if (leaving == LeavingOffset::largest) {
    s.offset = hn::Mul(hn::Set(d, kSurfaceOffset), hn::Max(largest, reach));
  } else {
    const V normal_reach = hn::PromoteTo(d, hn::BitCast(df, high_half(material_flat)));
    const V least =
        hn::Max(hn::Mul(hn::Set(d, kLeastOfEdge), reach), hn::Mul(hn::Set(d, kLeastOfPosition), largest));
    s.offset = hn::Mul(hn::Set(d, kNormalOffset), hn::Max(hn::Max(dot(abs(n), size), normal_reach), least));
  }

  s.from_inner = hn::Gt(dot(direction, n), hn::Zero(d));
  s.geometric = negate_where(s.from_inner, n);
  s.shading = negate_where(s.from_inner, shading);
  const V cos_shading = hn::Neg(dot(direction, s.shading));
  const M faces = hn::Gt(cos_shading, hn::Zero(d));
  s.shading = select(faces, s.shading, s.geometric);
  s.cos_incident = hn::IfThenElse(faces, cos_shading, hn::Neg(dot(direction, s.geometric)));
  return s;
}

using Optics = optics::SurfaceOptics;
using Materials = hybray::HWY_NAMESPACE::Fields<D, Optics>;
using Media = hybray::HWY_NAMESPACE::Fields<D, optics::Medium>;

// What is left of a weight after t metres (Beer-Lambert).
HWY_INLINE Vec3 through_medium(const Media& media, V t, const Vec3& weight) {
  const Vec3 absorption = media(&optics::Medium::absorption);
  const auto kept = [&](V a) HWY_ATTR {
    const VF x = hn::DemoteTo(DF(), hn::Mul(hn::Neg(a), t));
    return hn::PromoteTo(D(), hybray::HWY_NAMESPACE::exp_of_negative(x));
  };
  return multiply(weight, {kept(absorption.x), kept(absorption.y), kept(absorption.z)});
}

// optics::split, times the weight: what a surface mirrors and lets through.
struct Shares {
  Vec3 back, through;
  V base_entry, eta_cos, inverse_eta;
};

HWY_INLINE Shares shares_of(const Materials& materials, VU tag, M specular, const Surface& surface,
                            const Vec3& weight) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V metal = materials(&Optics::metal), clear = materials(&Optics::clear),
          base = materials(&Optics::base);
  const M has_metal = hn::And(specular, hn::Gt(metal, zero));
  const M has_clear = hn::And(specular, hn::Gt(clear, zero)), has_base = hn::Gt(base, zero);
  const M refracting = hn::AndNot(flag(tag, optics::surface_tag::kThin), has_clear);
  const M coated = hn::And(hn::And(specular, has_base), flag(tag, optics::surface_tag::kCoated));
  const Vec3 color = materials(&Optics::color);
  const V outside = materials.element(&Optics::crossing, 0), inside = materials.element(&Optics::crossing, 1);

  const M through_inside = hn::And(refracting, surface.from_inner);
  const auto at = optics::HWY_NAMESPACE::refraction_at(d, surface.cos_incident,
                                                       hn::IfThenElse(through_inside, inside, outside));
  // The base of an opaque surface is met from outside, whichever side that is.
  V coat = at.reflectance;
  const M coat_differs = hn::And(coated, through_inside);
  if (!hn::AllFalse(d, coat_differs))
    coat = hn::IfThenElse(coat_differs,
                          optics::HWY_NAMESPACE::refraction_at(d, surface.cos_incident, outside).reflectance,
                          coat);
  coat = hn::IfThenElseZero(coated, coat);

  Vec3 reflectance{zero, zero, zero};
  if (!hn::AllFalse(d, has_metal)) {
    Vec3 mirrored = color;
    const M conductor = hn::And(has_metal, flag(tag, optics::surface_tag::kConductor));
    if (!hn::AllFalse(d, conductor)) {
      const Vec3 eta = materials(&Optics::eta), k = materials(&Optics::k);
      const V c = surface.cos_incident;
      mirrored = select(conductor,
                        Vec3{optics::HWY_NAMESPACE::fresnel_conductor(d, c, eta.x, k.x),
                             optics::HWY_NAMESPACE::fresnel_conductor(d, c, eta.y, k.y),
                             optics::HWY_NAMESPACE::fresnel_conductor(d, c, eta.z, k.z)},
                        color);
    }
    reflectance = select(has_metal, scale(metal, mirrored), reflectance);
  }
  V clear_reflectance = at.reflectance;
  if (!hn::AllTrue(d, hn::Or(refracting, hn::Not(has_clear)))) {
    const V sheet = hn::Div(hn::Mul(hn::Set(d, 2.0), at.reflectance), hn::Add(one, at.reflectance));
    clear_reflectance = hn::IfThenElse(refracting, at.reflectance, sheet);
  }
  const V mirrored_clear = hn::IfThenElseZero(has_clear, hn::Mul(clear, clear_reflectance));
  const V mirrored_base = hn::IfThenElseZero(hn::And(specular, has_base), hn::Mul(base, coat));
  const auto sum = [&](V r) HWY_ATTR { return hn::Add(hn::Add(r, mirrored_clear), mirrored_base); };
  reflectance = {sum(reflectance.x), sum(reflectance.y), sum(reflectance.z)};
  const V transmitted = hn::IfThenElseZero(has_clear, hn::Mul(clear, hn::Sub(one, clear_reflectance)));

  Shares s;
  s.back = multiply(weight, reflectance);
  s.through = multiply(weight, scale(transmitted, color));
  s.base_entry =
      hn::IfThenElse(specular, hn::IfThenElseZero(has_base, hn::Mul(base, hn::Sub(one, coat))), base);
  s.eta_cos = hn::IfThenElseZero(refracting, at.eta_cos);
  s.inverse_eta = hn::IfThenElse(surface.from_inner, outside, inside);
  return s;
}

// optics::reflection.
HWY_INLINE Vec3 reflection(const Surface& surface, const Vec3& direction) {
  const D d;
  const Vec3 out = optics::HWY_NAMESPACE::reflected(direction, surface.shading);
  const M leaves = hn::Gt(dot(out, surface.geometric), hn::Zero(d));
  if (HWY_LIKELY(hn::AllTrue(d, leaves))) return out;
  return select(leaves, out, optics::HWY_NAMESPACE::reflected(direction, surface.geometric));
}

// Four values of each lane as one quarter of a photon. All lanes, however many count: see LanePacking.
HWY_INLINE void store_quarter(const Vec3f& v, VF w, Photon* photons, size_t quarter) {
  alignas(64) float quads[kMostLanes][4];
  hn::StoreInterleaved4(v.x, v.y, v.z, w, DF(), &quads[0][0]);
  for (size_t i = 0; i < hn::Lanes(DF()); ++i)
    std::memcpy(reinterpret_cast<char*>(photons + i) + sizeof(quads[0]) * quarter, quads[i],
                sizeof(quads[0]));
}

HWY_INLINE void arrive(const Packed& lanes, const Surface& surface, const Vec3f& direction,
                       const Vec3& weight, V length, VU tag, VU primitive, Arrivals& to) {
  static_assert(offsetof(Photon, cos_in) == 12 && offsetof(Photon, normal) == 16 &&
                offsetof(Photon, material) == 28 && offsetof(Photon, direction) == 32 &&
                offsetof(Photon, primitive) == 44 && offsetof(Photon, flux) == 48 &&
                offsetof(Photon, events) == 60 && offsetof(Photon, missed_by_map) == 62);
  const DU du;
  const DF df;
  const auto word = [&](VU v) HWY_ATTR { return hn::BitCast(df, hn::TruncateTo(DF32U(), v)); };
  const VU missed = hn::IfThenElseZero(hn::Eq(hn::And(tag, hn::Set(du, path_tag::kInMap)), hn::Zero(du)),
                                       hn::Set(du, uint64_t{1} << 16));
  const VU events = hn::And(tag, hn::Set(du, path_tag::kEvents));
  Photon* photons = &to.photons[to.count];
  const auto quarter = [&](size_t i, const Vec3f& v, VF w)
                           HWY_ATTR { store_quarter(lanes.packed(v), lanes.packed(w), photons, i); };
  quarter(0, demoted(surface.position), hn::DemoteTo(df, surface.cos_incident));
  quarter(1, demoted(surface.geometric), word(hn::BitCast(du, surface.material)));
  quarter(2, direction, word(primitive));
  quarter(3, demoted(weight), word(hn::Or(events, missed)));
  lanes.store(length, &to.length[to.count]);
  lanes.store(tag, &to.tag[to.count]);
  to.count += lanes.count();
}

// Hits are scattered over memory: what the next lanes need is on its way while these are worked on.
HWY_INLINE void prefetch(const SurfaceTable& table, const PathFront& from, size_t i, size_t lanes) {
  for (size_t j = i + 3 * lanes; j < std::min(from.count, i + 4 * lanes); ++j)
    table.prefetch_entry(from.hits.primitive[j]);
  for (size_t j = i + 2 * lanes; j < std::min(from.count, i + 3 * lanes); ++j)
    table.prefetch_normals(from.hits.primitive[j]);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray::caustics
HWY_AFTER_NAMESPACE();

#endif
