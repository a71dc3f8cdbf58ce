// First of all: compiles this file once for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/caustics/emission_lanes.cpp"
#include <hwy/foreach_target.h>
// clang-format on

#include "core/caustics/emission_lanes.h"

#include "core/base/check.h"
#include "core/base/fields-inl.h"
#include "core/base/hash-inl.h"
#include "core/base/lanes-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybray::caustics {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using hybray::HWY_NAMESPACE::Vec3Lanes;

// As in path_walk_lanes.cpp: sums by lane of eight do not depend on the width.
constexpr size_t kMostLanes = 8;
using D = hn::CappedTag<double, kMostLanes>;
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using DF = hn::Rebind<float, D>;
using V = hn::Vec<D>;
using VU = hn::Vec<DU>;
using Vec3 = Vec3Lanes<V>;
using Packed = hybray::HWY_NAMESPACE::LanePacking<D>;
using Frames = hybray::HWY_NAMESPACE::Fields<D, FrameRays>;

HWY_INLINE V as_double(VU v) {  // of values below 2^63
  return hn::ConvertTo(D(), hn::BitCast(DI(), v));
}
HWY_INLINE V fraction(V v) {
  return hn::Sub(v, hn::Floor(v));
}
HWY_INLINE Vec3 set(const dvec3& v) {
  const D d;
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}

HWY_INLINE void store(const Packed& packed, const Vec3& v, float* x, float* y, float* z) {
  const DF df;
  hn::StoreU(packed.packed(hn::DemoteTo(df, v.x)), df, x);
  hn::StoreU(packed.packed(hn::DemoteTo(df, v.y)), df, y);
  hn::StoreU(packed.packed(hn::DemoteTo(df, v.z)), df, z);
}

HWY_INLINE Vec3 intensity(const Intensity& light, const Vec3& direction) {
  const D d;
  const Vec3 full = set(light.full);
  if (!light.spot) return full;
  const V along =
      hn::Mul(hn::Sub(dot(direction, set(light.axis)), hn::Set(d, light.outer)), hn::Set(d, light.scale));
  const V falloff = hn::Min(hn::Max(along, hn::Zero(d)), hn::Set(d, 1.0));
  return scale(hn::Mul(falloff, falloff), full);
}

double start_map_paths(const MapEmission& emission, uint64_t first, size_t count, uint16_t medium,
                       PathFront& to, std::span<uint32_t, PathFront::kAllocated> texels) {
  const D d;
  const DU du;
  const size_t lanes = hn::Lanes(d);
  const std::vector<MapTexel>& list = emission.map.texels;
  const VU last = hn::Set(du, list.size() - 1);
  Path path;
  path.medium = medium, path.in_map = true;
  const VU tag = hn::Set(du, path_tag::of(path));
  alignas(64) double emitted[kMostLanes] = {};
  // Which texels, for all paths, then what these hold: nothing waits for what was written just now.
  alignas(64) PathFront::Lanes<uint64_t> index, texel;
  const auto number_of = [&](size_t i) HWY_ATTR { return as_double(hn::Iota(du, first + i)); };
  for (size_t i = 0; i < count; i += lanes) {
    const V at =
        hn::Mul(hn::Add(number_of(i), hn::Set(d, emission.offset)), hn::Set(d, emission.texels_a_path));
    hn::Store(hn::Min(hn::BitCast(du, hn::ConvertTo(DI(), at)), last), du, &index[i]);
  }
  for (size_t i = 0; i < count; ++i) {
    const MapTexel& t = list[index[i]];
    texel[i] = uint64_t{t.x} | uint64_t{t.y} << 16 | uint64_t{t.frame} << 32;
  }
  const VU low = hn::Set(du, uint64_t{0xffff});
  for (size_t i = 0; i < count; i += lanes) {
    const auto here = hn::FirstN(d, count - i);
    const VU place = hn::IfThenElseZero(hn::RebindMask(du, here), hn::Load(du, &texel[i]));
    const VU texel_index = hn::Load(du, &index[i]);
    const V number = number_of(i);
    const VU jitter =
        hybray::HWY_NAMESPACE::random_bits(hybray::HWY_NAMESPACE::random_stream(texel_index, emission.seed),
                                           hn::Set(du, uint64_t{MapEmission::kJitter}));
    const V unit = hn::Set(d, 0x1p-32);
    const V shift_x = hn::Mul(as_double(hn::ShiftRight<32>(jitter)), unit);
    const V shift_y = hn::Mul(as_double(hn::And(jitter, hn::Set(du, uint64_t{0xffffffff}))), unit);
    const V x = hn::Add(as_double(hn::And(place, low)),
                        fraction(hn::Add(shift_x, hn::Mul(number, hn::Set(d, MapEmission::kPlasticX)))));
    const V y = hn::Add(as_double(hn::And(hn::ShiftRight<16>(place), low)),
                        fraction(hn::Add(shift_y, hn::Mul(number, hn::Set(d, MapEmission::kPlasticY)))));

    const Frames frames(emission.frames, hn::BitCast(DI(), hn::ShiftRight<32>(place)), here);
    const Vec3 point = add(add(frames(&FrameRays::corner), scale(x, frames(&FrameRays::step_x))),
                           scale(y, frames(&FrameRays::step_y)));
    Vec3 origin = point, direction = frames(&FrameRays::forward);
    V density = frames(&FrameRays::area);
    if (!emission.frames[0].orthographic) {  // all of a light's frames are alike
      const V inverse = hn::Div(hn::Set(d, 1.0), hn::Sqrt(dot(point, point)));
      origin = frames(&FrameRays::origin);
      direction = scale(inverse, point);
      density = hn::Mul(density, hn::Mul(hn::Mul(inverse, inverse), inverse));
    }
    V per_path = hn::Mul(hn::Set(d, emission.texels_a_path), density);
    if (emission.domain_density > 0.0)
      per_path =
          hn::Div(per_path, hn::Add(hn::Set(d, 1.0), hn::Mul(per_path, hn::Set(d, emission.domain_density))));
    const Vec3 flux = scale(per_path, intensity(emission.intensity, direction));
    const V mean = hn::Mul(hn::Add(hn::Add(flux.x, flux.y), flux.z), hn::Set(d, 1.0 / 3.0));
    const auto shines = hn::And(here, hn::Gt(mean, hn::Zero(d)));
    double* sum = &emitted[i % kMostLanes];
    hn::Store(hn::Add(hn::Load(d, sum), hn::IfThenElseZero(shines, mean)), d, sum);

    const Packed packed(shines);
    const size_t at = to.count;
    store(packed, origin, &to.rays.ox[at], &to.rays.oy[at], &to.rays.oz[at]);
    store(packed, direction, &to.rays.dx[at], &to.rays.dy[at], &to.rays.dz[at]);
    hn::StoreU(packed.packed(flux.x), d, &to.red[at]);
    hn::StoreU(packed.packed(flux.y), d, &to.green[at]);
    hn::StoreU(packed.packed(flux.z), d, &to.blue[at]);
    hn::StoreU(packed.packed(mean), d, &to.initial[at]);
    hn::StoreU(hn::Zero(d), d, &to.length[at]);
    hn::StoreU(packed.packed(hn::Iota(du, first + i)), du, &to.number[at]);
    hn::StoreU(tag, du, &to.tag[at]);
    const hn::Rebind<uint32_t, D> du32;
    hn::StoreU(packed.packed(hn::TruncateTo(du32, texel_index)), du32, &texels[at]);
    to.count += packed.count();
  }
  double sum = 0.0;
  for (const double lane : emitted) sum += lane;
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray::caustics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybray::caustics {

HWY_EXPORT(start_map_paths);

double start_map_paths(const MapEmission& emission, uint64_t first, size_t count, uint16_t medium,
                       PathFront& to, std::span<uint32_t, PathFront::kAllocated> texels) {
  HYBRAY_CHECK_LE(first + count, emission.paths);
  HYBRAY_CHECK_LE(to.count + count, PathFront::kSize);
  return HWY_DYNAMIC_DISPATCH(start_map_paths)(emission, first, count, medium, to, texels);
}

}  // namespace hybray::caustics
#endif
