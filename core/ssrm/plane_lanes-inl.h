// Rays against the planes of pixels, in double and in many lanes: the closer look at a ray that stopped
// (plane_gap of correction.h). Per-target code, as march_wave-inl.h.
#if defined(HYBRAY_PLANE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRAY_PLANE_LANES_INL_H_
#undef HYBRAY_PLANE_LANES_INL_H_
#else
#define HYBRAY_PLANE_LANES_INL_H_
#endif

#include "core/ssrm/correction.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybray::ssrm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DD = hn::CappedTag<double, 8>;
using VD = hn::Vec<DD>;
using MD = hn::Mask<DD>;
using DHF = hn::Rebind<float, DD>;
using DHI = hn::Rebind<int32_t, DD>;
using VHF = hn::Vec<DHF>;
using VHI = hn::Vec<DHI>;
using MHI = hn::Mask<DHI>;

HWY_INLINE VD gather_double(const float* from, VHI index) {
  return hn::PromoteTo(DD(), hn::GatherIndex(DHF(), from, index));
}

// A mask of double lanes as one of integers.
HWY_INLINE MHI narrow(MD m) {
  const DD d;
  const VD flag = hn::IfThenElseZero(m, hn::Set(d, 1.0));
  return hn::Ne(hn::DemoteTo(DHI(), flag), hn::Zero(DHI()));
}

struct AxisDouble {
  VD origin, direction, inverse, entry;  // entry border - pixel: 0 forward, 1 backward

  HWY_INLINE AxisDouble(VD o, VD d)
      : origin(o),
        direction(d),
        inverse(hn::Div(hn::Set(DD(), 1.0), d)),
        entry(hn::IfThenElseZero(hn::Lt(d, hn::Zero(DD())), hn::Set(DD(), 1.0))) {}
  HWY_INLINE VD crossing(VD border) const { return hn::Mul(hn::Sub(border, origin), inverse); }
  HWY_INLINE VD enter(VD pixel) const { return crossing(hn::Add(pixel, entry)); }
  HWY_INLINE VD leave(VD pixel) const { return crossing(hn::Add(pixel, hn::Sub(hn::Set(DD(), 1.0), entry))); }
};

struct RayDouble {
  AxisDouble x, y;
  VD oz, dz, l_end;

  // Rays by their index.
  HWY_INLINE RayDouble(const ScreenRays& rays, VHI ray)
      : x(gather_double(rays.ox.data(), ray), gather_double(rays.dx.data(), ray)),
        y(gather_double(rays.oy.data(), ray), gather_double(rays.dy.data(), ray)),
        oz(gather_double(rays.oz.data(), ray)),
        dz(gather_double(rays.dz.data(), ray)),
        l_end(gather_double(rays.l_end.data(), ray)) {}
};

// How far rays are behind the planes of their pixels where they enter and leave these, march depth.
struct PixelGap {
  VD enter, leave;
  VD magnitude;  // |depth| + |slope x| + |slope y| of the pixel
};

HWY_INLINE PixelGap pixel_gap(const DepthView& view, const RayDouble& ray, VHI px, VHI py) {
  const DD d;
  const VHI pixel = hn::Add(hn::Mul(py, hn::Set(DHI(), view.width())), px), pair = hn::Add(pixel, pixel);
  const float* slopes = &view.derivatives.data()->x;
  const VD sign = hn::Set(d, static_cast<double>(view.depth_sign));
  const VD gx = hn::Mul(sign, gather_double(slopes, pair)),
           gy = hn::Mul(sign, gather_double(slopes + 1, pair));
  const VD center = gather_double(view.pyramid.texels(), pixel);
  const VD x = hn::PromoteTo(d, px), y = hn::PromoteTo(d, py), half = hn::Set(d, 0.5);
  const VD across_x = hn::Mul(gx, hn::Sub(ray.x.origin, hn::Add(x, half)));
  const VD across_y = hn::Mul(gy, hn::Sub(ray.y.origin, hn::Add(y, half)));
  const VD offset = hn::Sub(hn::Sub(hn::Sub(ray.oz, center), across_x), across_y);
  const VD slope = hn::Sub(hn::Sub(ray.dz, hn::Mul(gx, ray.x.direction)), hn::Mul(gy, ray.y.direction));
  const VD enter = hn::Max(ray.x.enter(x), ray.y.enter(y));
  const VD leave = hn::Min(hn::Min(ray.x.leave(x), ray.y.leave(y)), ray.l_end);
  return {hn::Add(offset, hn::Mul(enter, slope)), hn::Add(offset, hn::Mul(leave, slope)),
          hn::Add(hn::Add(hn::Abs(center), hn::Abs(gx)), hn::Abs(gy))};
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray::ssrm
HWY_AFTER_NAMESPACE();

#endif
