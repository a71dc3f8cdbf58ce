// Light transport in its plainest form, the brute-force twin of the closed forms: every ray against every
// primitive in double, one random choice at each interface, Fresnel by the cosine formula.
#pragma once

#include "core/scene/surface_point.h"
#include "core/truth/closed_forms.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hybray::test {

// Directions or origins that cover the specular object: a cone about `axis` from a lamp, a disc about
// `center` across a sun's direction.
struct Emission {
  dvec3 axis{0, -1, 0};
  double half_angle = std::numbers::pi;
  dvec3 center{0.0};
  double disc_radius = 0.0;
};

struct Estimate {
  double irradiance = 0.0, standard_error = 0.0;
};

class BruteForce {
 public:
  BruteForce(const Scene& scene, const truth::ClosedForm& form, const Emission& emission, int max_events)
      : scene_(scene), form_(form), emission_(emission), max_events_(max_events) {}

  std::vector<Estimate> run(uint64_t paths, uint64_t seed) const {
    std::vector<double> sum(form_.regions.size(), 0.0), squares(form_.regions.size(), 0.0);
    for (uint64_t i = 0; i < paths; ++i) {
      uint32_t next = 0;
      const auto random = [&] { return random_unit(i, next++, 0, seed); };
      dvec3 origin, direction;
      const double flux = start(random, origin, direction);
      dvec3 point;
      const double weight = flux * follow(random, origin, direction, point);
      if (weight == 0.0) continue;
      for (size_t r = 0; r < sum.size(); ++r)
        if (form_.regions[r].contains(point)) sum[r] += weight, squares[r] += weight * weight;
    }
    std::vector<Estimate> estimates;
    const auto n = static_cast<double>(paths);
    for (size_t r = 0; r < sum.size(); ++r) {
      const double mean = sum[r] / n, area = form_.regions[r].area;
      estimates.push_back({mean / area, std::sqrt(std::max(0.0, squares[r] / n - mean * mean) / n) / area});
    }
    return estimates;
  }

 private:
  static void frame(const dvec3& axis, dvec3& u, dvec3& v) {
    u = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    v = glm::cross(axis, u);
  }

  // The flux that the path stands for.
  template <class Random>
  double start(const Random& random, dvec3& origin, dvec3& direction) const {
    const Light& light = scene_.lights.at(0);
    const double a = random(), phi = 2.0 * std::numbers::pi * random();
    dvec3 u, v;
    if (light.kind == LightKind::point) {
      frame(emission_.axis, u, v);
      const double cosine = 1.0 - a * (1.0 - std::cos(emission_.half_angle));
      const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
      origin = dvec3(light.position);
      direction = cosine * emission_.axis + sine * (std::cos(phi) * u + std::sin(phi) * v);
      return light.intensity * 2.0 * std::numbers::pi * (1.0 - std::cos(emission_.half_angle));
    }
    direction = glm::normalize(dvec3(light.direction));
    frame(direction, u, v);
    const double r = emission_.disc_radius * std::sqrt(a);
    origin = emission_.center - 20.0 * direction + r * (std::cos(phi) * u + std::sin(phi) * v);
    return light.intensity * std::numbers::pi * emission_.disc_radius * emission_.disc_radius;
  }

  bool nearest(const dvec3& o, const dvec3& d, double& t, uint32_t& primitive) const {
    t = 1e30;
    const auto keep = [&](std::optional<double> hit, uint32_t id) {
      if (hit && *hit > 1e-9 && *hit < t) t = *hit, primitive = id;
    };
    for (uint32_t i = 0; i < scene_.triangle_count(); ++i) keep(exact_hit(scene_, i, o, d), i);
    for (uint32_t i = static_cast<uint32_t>(scene_.triangle_count()); i < scene_.primitive_count(); ++i) {
      const LineHits hits = line_hits(scene_.analytic_surface(i), o, d);
      for (int k = 0; k < hits.count; ++k) keep(hits.t[k], i);
    }
    return t < 1e30;
  }

  // Share of the flux that reaches the receiver, at `point`, after at least one event.
  template <class Random>
  double follow(const Random& random, dvec3 o, dvec3 d, dvec3& point) const {
    double weight = 1.0;
    for (int events = 0;; ++events) {
      double t = 0.0;
      uint32_t primitive = 0;
      if (!nearest(o, d, t, primitive)) return 0.0;
      point = o + t * d;
      const Material& m = scene_.materials[scene_.material_of(primitive)];
      dvec3 n = geometric_normal(scene_, primitive, point);
      const bool inside = glm::dot(d, n) > 0.0;
      if (m.transmission > 0.0f && inside) weight *= std::exp(-static_cast<double>(m.absorption.x) * t);
      if (form_.receives(primitive)) return events > 0 ? weight : 0.0;
      if (events == max_events_) return 0.0;
      if (inside) n = -n;
      o = point;
      const double cosine = -glm::dot(d, n);
      const dvec3 mirrored = d + 2.0 * cosine * n;
      if (m.metallic > 0.0f) {
        weight *= m.base_color.x;
        d = mirrored;
        continue;
      }
      const double n1 = inside ? m.ior : 1.0, n2 = inside ? 1.0 : m.ior, ratio = n1 / n2;
      const double sine2 = ratio * ratio * (1.0 - cosine * cosine);
      double reflectance = 1.0, beyond = 0.0;
      if (sine2 < 1.0) {
        beyond = std::sqrt(1.0 - sine2);
        const double s = (n1 * cosine - n2 * beyond) / (n1 * cosine + n2 * beyond);
        const double p = (n1 * beyond - n2 * cosine) / (n1 * beyond + n2 * cosine);
        reflectance = 0.5 * (s * s + p * p);
      }
      d = random() < reflectance ? mirrored : glm::normalize(ratio * d + (ratio * cosine - beyond) * n);
    }
  }

  const Scene& scene_;
  const truth::ClosedForm& form_;
  Emission emission_;
  int max_events_;
};

}  // namespace hybray::test
