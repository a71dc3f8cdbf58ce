#include "harness/cli/scene_preview.h"

#include "core/base/develop.h"
#include "core/base/hash.h"
#include "core/base/image2d.h"
#include "core/base/image_io.h"
#include "core/base/parallel.h"
#include "core/scene/surface_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/trigonometric.hpp>

namespace hybray {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kAmbientRays = 16;
constexpr float kBrightestBounce = 4.0f;   // keeps lamps close to a surface from speckling the picture
constexpr int kMaxDepth = 4;               // mirror reflections and transmissions in a row
constexpr float kSmoothRoughness = 0.25f;  // at or below: reflects like a mirror here

struct Surface {
  vec3 position;
  vec3 normal, geometric;  // on the viewer's side
  vec3 offset_position;    // moved off the surface along its geometric normal
  vec3 through_position;   // the same, on the other side
  const Material* material;
};

// Random numbers of one pixel.
struct Sampler {
  uint64_t pixel;
  uint32_t next = 0;
  float operator()() { return static_cast<float>(random_unit(pixel, next++)); }
};

Surface surface_at(const Scene& scene, const Hit& hit, const vec3& origin, const vec3& direction) {
  Surface s;
  s.position = origin + hit.t * direction;
  const SurfacePoint point = surface_point(scene, hit.primitive, hit.u, hit.v, dvec3(s.position));
  s.geometric = vec3(point.geometric_normal);
  if (glm::dot(s.geometric, direction) > 0.0f) s.geometric = -s.geometric;
  s.normal = vec3(point.shading_normal);
  if (glm::dot(s.normal, s.geometric) < 0.0f) s.normal = -s.normal;
  const float epsilon = 1e-4f * (1.0f + glm::length(s.position));
  s.offset_position = s.position + epsilon * s.geometric;
  s.through_position = s.position - epsilon * s.geometric;
  s.material = &scene.materials[point.material];
  return s;
}

vec3 sky(const vec3& direction) {
  const float up = std::max(direction.y, 0.0f);
  return glm::mix(vec3(1.0f, 1.02f, 1.05f), vec3(0.25f, 0.45f, 0.9f), std::sqrt(up)) *
         (direction.y < 0.0f ? 0.3f : 1.0f);
}

float spot_factor(const Light& light, const vec3& to_light) {
  if (light.kind != LightKind::spot) return 1.0f;
  const float cosine = glm::dot(-to_light, light.direction), outer = std::cos(light.outer_cone_angle);
  const float inner = std::cos(light.inner_cone_angle);
  const float t = glm::clamp((cosine - outer) / std::max(inner - outer, 1e-4f), 0.0f, 1.0f);
  return t * t;
}

// Irradiance that one light brings to `s`, with its shadow.
vec3 irradiance(const Tracer& tracer, const Surface& s, const Light& light) {
  vec3 to_light = -light.direction;
  float distance = std::numeric_limits<float>::infinity(), falloff = 1.0f;
  if (light.kind != LightKind::directional) {
    const vec3 d = light.position - s.position;
    distance = glm::length(d);
    to_light = d / distance;
    falloff = spot_factor(light, to_light) / (distance * distance);
  }
  const float cosine = glm::dot(s.normal, to_light);
  if (cosine * falloff <= 0.0f) return vec3(0.0f);
  if (tracer.occluded(s.offset_position, to_light, 0.0f, distance * 0.9999f)) return vec3(0.0f);
  return light.color * (light.intensity * cosine * falloff);
}

vec3 cosine_direction(const vec3& n, float a, float b) {
  const float phi = 2.0f * kPi * a, r = std::sqrt(b);
  const vec3 t = glm::normalize(glm::cross(std::abs(n.x) > 0.5f ? vec3(0, 1, 0) : vec3(1, 0, 0), n));
  return r * std::cos(phi) * t + r * std::sin(phi) * glm::cross(n, t) + std::sqrt(1.0f - b) * n;
}

// Radiance toward the viewer from a diffuse surface of unit colour lit by all lights at once, or (at a
// bounce) by all directional ones and one of the others, picked at random with a chance that follows its
// brightness here.
vec3 direct(const Tracer& tracer, const Surface& s, bool all, Sampler& sampler) {
  const std::vector<Light>& lights = tracer.scene().lights;
  const auto weight = [&](const Light& light) {
    const vec3 d = light.position - s.position;
    return light.kind == LightKind::directional ? 0.0f : light.intensity / (0.05f + glm::dot(d, d));
  };
  vec3 sum(0.0f);
  float total = 0.0f;
  for (const Light& light : lights) {
    if (all || light.kind == LightKind::directional) sum += irradiance(tracer, s, light);
    total += weight(light);
  }
  if (!all && total > 0.0f) {
    float left = sampler() * total;
    const Light* chosen = nullptr;
    for (const Light& light : lights) {
      if (weight(light) <= 0.0f) continue;
      chosen = &light;
      left -= weight(light);
      if (left < 0.0f) break;
    }
    sum += irradiance(tracer, s, *chosen) * (total / weight(*chosen));
  }
  return sum / kPi;
}

vec3 diffuse_color(const Material& m) {
  return m.base_color * ((1.0f - m.metallic) * (1.0f - m.transmission));
}

// Light from the sky and, once reflected, from the surfaces around.
vec3 ambient(const Tracer& tracer, const Surface& s, Sampler& sampler) {
  vec3 sum(0.0f);
  for (int i = 0; i < kAmbientRays; ++i) {
    const float a = (static_cast<float>(i % 4) + sampler()) / 4.0f,
                b = (static_cast<float>(i / 4) + sampler()) / 4.0f;
    const vec3 d = cosine_direction(s.normal, a, b);
    const Hit hit = tracer.intersect(s.offset_position, d);
    if (!hit.valid()) {
      sum += sky(d);
      continue;
    }
    const Surface other = surface_at(tracer.scene(), hit, s.offset_position, d);
    const vec3 color = glm::mix(diffuse_color(*other.material), other.material->base_color, 0.5f);
    const vec3 bounced =
        other.material->emissive + color * (direct(tracer, other, false, sampler) + vec3(0.12f));
    sum += glm::min(bounced, vec3(kBrightestBounce));
  }
  return sum / static_cast<float>(kAmbientRays);
}

vec3 radiance(const Tracer& tracer, const vec3& origin, const vec3& direction, int depth, Sampler& sampler) {
  const Hit hit = tracer.intersect(origin, direction);
  if (!hit.valid()) return sky(direction);
  const Surface s = surface_at(tracer.scene(), hit, origin, direction);
  const Material& m = *s.material;
  vec3 result = m.emissive;
  const vec3 diffuse = diffuse_color(m);
  if (glm::length(diffuse) > 0.0f || m.roughness > kSmoothRoughness) {
    const vec3 color = m.roughness > kSmoothRoughness ? glm::mix(diffuse, m.base_color, m.metallic) : diffuse;
    result += color * (direct(tracer, s, true, sampler) + ambient(tracer, s, sampler));
  }
  if (depth >= kMaxDepth) return result;
  const float cosine = std::max(-glm::dot(s.normal, direction), 0.0f);
  const float r0 = (m.ior - 1.0f) * (m.ior - 1.0f) / ((m.ior + 1.0f) * (m.ior + 1.0f));
  const vec3 f0 = glm::mix(vec3(r0), m.base_color, m.metallic);
  const vec3 fresnel = f0 + (vec3(1.0f) - f0) * std::pow(1.0f - cosine, 5.0f);
  if (m.roughness <= kSmoothRoughness) {
    vec3 mirrored = glm::reflect(direction, s.normal);
    if (glm::dot(mirrored, s.geometric) <= 0.0f) mirrored = glm::reflect(direction, s.geometric);
    result += fresnel * radiance(tracer, s.offset_position, mirrored, depth + 1, sampler);
  }
  if (m.transmission > 0.0f)
    result += (vec3(1.0f) - fresnel) * m.base_color * m.transmission *
              radiance(tracer, s.through_position, direction, depth + 1, sampler);
  return result;
}

}  // namespace

void render_preview(const Tracer& tracer, const Camera& camera, int width, int height,
                    const std::filesystem::path& png) {
  const vec3 forward = glm::normalize(camera.target - camera.eye);
  const vec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const float half = std::tan(0.5f * glm::radians(camera.vertical_fov));
  Image2D<vec3> image(width, height);
  parallel_blocks(image.size(), 256, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      Sampler sampler{i};
      const auto x = static_cast<float>(i % static_cast<size_t>(width)) + sampler();
      const auto y = static_cast<float>(i / static_cast<size_t>(width)) + sampler();
      const float sx = (2.0f * x - static_cast<float>(width)) / static_cast<float>(height) * half;
      const float sy = (1.0f - 2.0f * y / static_cast<float>(height)) * half;
      image[i] = radiance(tracer, camera.eye, glm::normalize(forward + sx * right + sy * up), 0, sampler);
    }
  });
  write_png(png, width, height, develop(image, automatic_exposure(image)));
}

}  // namespace hybray
