#include "core/truth/march_layers_level0.h"

#include "core/ssrm/cell_walk.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace hybray::truth {
namespace {

using ssrm::Verdict;

// A layer of one pixel as the ray sees it: signed distance from its plane along the ray, < 0 in front of it.
struct Sheet {
  double offset, slope, enter, leave, slopes;
  uint32_t primitive;
  bool front;
  double at(double l) const { return offset + l * slope; }
  double crossing() const { return -offset / slope; }
};

std::vector<Sheet> sheets_of(const ssrm::LayeredView& view, const ssrm::ScreenRay<double>& ray, ivec2 p) {
  const auto [enter, leave] = ssrm::pixel_span(view.first, ray, p.x, p.y);
  const size_t pixel =
      static_cast<size_t>(p.y) * static_cast<size_t>(view.first.width()) + static_cast<size_t>(p.x);
  std::vector<Sheet> sheets;
  for (int i = 0; i < view.count() && view.has(i, pixel); ++i) {
    const ssrm::PixelPlane plane = view.plane(i, p.x, p.y);
    const double offset = ray.oz - plane.center - plane.slope_x * (ray.ox - (p.x + 0.5)) -
                          plane.slope_y * (ray.oy - (p.y + 0.5));
    const double slope = ray.dz - plane.slope_x * ray.dx - plane.slope_y * ray.dy;
    sheets.push_back({offset, slope, offset + enter * slope, offset + leave * slope,
                      std::abs(plane.slope_x) + std::abs(plane.slope_y), view.primitive_of(i, pixel),
                      view.layers.shows_front(pixel, i)});
  }
  return sheets;
}

// A ray among the sheets of pixel after pixel. `slot`: how many of `before`, those of the last pixel, it was
// behind.
struct Among {
  const ssrm::LayeredView& view;
  const ssrm::LayerOptions& options;
  std::vector<Sheet> before;
  size_t slot = 0;

  static bool one_surface(const Sheet& front, const Sheet& back, double l) {
    return front.primitive == back.primitive ||
           front.at(l) - back.at(l) < ssrm::kContinuation * (front.slopes + back.slopes) / 2.0;
  }
  // How many sheets the ray is behind where it enters; nothing where that makes no sense.
  std::optional<size_t> entered(const std::vector<Sheet>& now, double l) const {
    size_t is = 0;
    while (is < now.size() && now[is].enter > 0.0) ++is;
    for (size_t i = is; i < now.size(); ++i)
      if (now[i].enter > 0.0) return std::nullopt;
    if (is > 0 && slot < before.size() && one_surface(now[is - 1], before[slot], l)) return std::nullopt;
    if (slot > 0 && is < now.size() && one_surface(before[slot - 1], now[is], l)) return std::nullopt;
    if (is > 0 && (is == now.size() || !ssrm::is_free(options.free_space, now[is - 1].front, now[is].front)))
      return std::nullopt;
    return is;
  }
  // The layer that is crossed inside the pixel.
  static std::optional<size_t> crossed(const std::vector<Sheet>& now, size_t is) {
    const bool far = now[is].leave >= 0.0, near = now[is - 1].leave <= 0.0;
    if (!far && !near) return std::nullopt;
    return far && (!near || now[is].crossing() <= now[is - 1].crossing()) ? is : is - 1;
  }
};

}  // namespace

ssrm::LayerHit march_layers_level0(const ssrm::LayeredView& view, const ssrm::ScreenRay<double>& ray,
                                   uint32_t pixel, const ssrm::LayerOptions& options) {
  const int width = view.first.width();
  const ivec2 origin(static_cast<int>(pixel) % width, static_cast<int>(pixel) / width);
  const auto index = [&](ivec2 p) { return static_cast<uint32_t>(p.y * width + p.x); };
  ssrm::CellWalk<double> walk(ray, width, view.first.height(), origin.x, origin.y);
  Among among{view, options, sheets_of(view, ray, origin), 0};
  bool late = false;
  for (ivec2 previous = origin;;) {
    const ivec2 here(walk.px, walk.py);
    const auto exit = walk.exit(0);
    const bool ends = ray.l_end <= exit.l();
    std::vector<Sheet> now = sheets_of(view, ray, here);
    if (here != origin) {
      const double enter = ssrm::pixel_span(view.first, ray, here.x, here.y).enter;
      // Behind something before: where is the ray now?
      if (among.slot > 0) {
        const std::optional<size_t> is = among.entered(now, enter);
        if (!is) return {Verdict::behind};
        if (*is > 0)
          if (const auto layer = among.crossed(now, *is))
            return {Verdict::hit, index(here), static_cast<int>(*layer), true};
        late = late || *is == 0;
        among.slot = *is;
      }
      const double rise = std::max(walk.l * ray.dz, (ends ? ray.l_end : exit.l()) * ray.dz);
      if (among.slot == 0 && !now.empty() &&
          rise > static_cast<double>(view.first.pyramid.at(0, here.x, here.y)) - ray.oz) {
        const auto passes = [](const std::vector<Sheet>& s) {
          return !s.empty() && s[0].enter <= 0.0 && s[0].leave >= 0.0;
        };
        if (passes(now)) return {Verdict::hit, index(here), 0, late};
        if (previous != origin && passes(among.before)) return {Verdict::hit, index(previous), 0, late};
        late = true;
        if (now[0].enter <= 0.0) {
          if (!options.march_on) return {Verdict::correction};
        } else {
          const std::optional<size_t> is = view.count() > 1 ? among.entered(now, enter) : std::nullopt;
          if (!is) return {Verdict::behind};
          if (const auto layer = among.crossed(now, *is))
            return {Verdict::hit, index(here), static_cast<int>(*layer), true};
          among.slot = *is;
        }
      }
    }
    if (ends) return {among.slot > 0 && ray.end == Verdict::miss ? Verdict::behind : ray.end};
    among.before = std::move(now);
    previous = here;
    if (!walk.advance(exit)) return {Verdict::offscreen};
  }
}

}  // namespace hybray::truth
