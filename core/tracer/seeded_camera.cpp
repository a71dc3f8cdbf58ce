#include "core/tracer/seeded_camera.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/scene/surface_point.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include <glm/trigonometric.hpp>

namespace hybray {
namespace {

constexpr std::string_view kOne = "seeded/", kMany = "seeded*";
constexpr float kPi = std::numbers::pi_v<float>;
constexpr uint32_t kDrawsBeforeLess = 500, kDrawsBeforeFloating = 1000, kMostDraws = 4000;
constexpr int kSteps = 16;                // of a walk
constexpr int kAround = 96, kLevel = 24;  // directions that are tried around an eye
constexpr int kAcross = 24, kDown = 14;   // rays that sample a view, 16:9

std::optional<uint32_t> number_after(std::string_view prefix, std::string_view text, uint32_t least,
                                     uint32_t most) {
  if (!text.starts_with(prefix)) return {};
  text.remove_prefix(prefix.size());
  if (text.empty() || (text[0] == '0' && text.size() > 1)) return {};
  uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  if (number < least || number > most) return {};
  return number;
}

// What rays from one point met.
struct Surroundings {
  std::vector<float> distances;  // infinity where nothing is
  int hits = 0, backs = 0;

  float nearest() const { return *std::min_element(distances.begin(), distances.end()); }
  float median() const {
    std::vector<float> sorted = distances;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    return sorted[sorted.size() / 2];
  }
  double covered() const { return static_cast<double>(hits) / static_cast<double>(distances.size()); }
  double nearer_than(float distance) const {
    const auto near =
        std::count_if(distances.begin(), distances.end(), [&](float t) { return t < distance; });
    return static_cast<double>(near) / static_cast<double>(distances.size());
  }
  bool mostly_fronts() const { return 10 * backs <= hits; }
};

class Placement {
 public:
  Placement(const Tracer& tracer, uint32_t number, uint64_t seed)
      : tracer_(tracer), scene_(tracer.scene()), number_(number), seed_(seed) {
    unit_ = std::min(1.0f, scene_.bounds.diagonal() / 10.0f);
  }

  std::optional<Camera> draw(uint32_t attempt) {
    attempt_ = attempt, dimension_ = 0;
    const float height = unit_ * (1.5f + 0.3f * random());
    const float yaw = 2.0f * kPi * random(), pitch = glm::radians(-12.0f + 18.0f * random());
    vec3 eye = start();
    if (!walk(eye, height) || !is_free(eye)) return {};
    Camera camera;
    camera.name = seeded_camera_name(number_);
    camera.eye = eye;
    camera.target =
        eye + vec3(std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw));
    const float wanted = 0.8f * std::pow(0.5f, static_cast<float>(attempt / kDrawsBeforeLess));
    if (!sees_enough(camera, wanted)) return {};
    return camera;
  }

 private:
  float random() { return static_cast<float>(random_unit(number_, dimension_++, attempt_, seed_)); }

  vec3 start() {
    if (!scene_.cameras.empty()) return scene_.cameras[(number_ + attempt_) % scene_.cameras.size()].eye;
    const vec3 size = scene_.bounds.upper - scene_.bounds.lower;
    return scene_.bounds.lower + size * vec3(random(), random(), random());
  }

  // Walks; whether the eye has come to stand on a floor, or need not.
  bool walk(vec3& eye, float height) {
    const bool may_float = attempt_ >= kDrawsBeforeFloating;
    bool stands = stand(eye, height);
    for (int step = 0; step < kSteps; ++step) {
      const float phi = 2.0f * kPi * random();
      const vec3 along(std::cos(phi), 0.0f, std::sin(phi));
      const float before = free_way(eye, -along), after = free_way(eye, along);
      vec3 next = eye + ((before + after) * random() - before) * along;
      if (const bool found = stand(next, height); found || may_float || !stands) eye = next, stands = found;
    }
    return stands || may_float;
  }

  // Distance to the next surface, or else to the border of the scene's bounds.
  float free_way(const vec3& eye, const vec3& direction) const {
    float t = tracer_.intersect(eye, direction).t;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0.0f) continue;
      const float side = direction[axis] > 0.0f ? scene_.bounds.upper[axis] : scene_.bounds.lower[axis];
      t = std::min(t, std::max(0.0f, (side - eye[axis]) / direction[axis]));
    }
    return t;
  }

  void look(Surroundings& s, const vec3& eye, const vec3& direction) const {
    const Hit hit = tracer_.intersect(eye, direction);
    s.distances.push_back(hit.t);
    if (!hit.valid()) return;
    ++s.hits;
    s.backs += glm::dot(normal_at(hit, eye, direction), dvec3(direction)) > 0.0;
  }
  dvec3 normal_at(const Hit& hit, const vec3& eye, const vec3& direction) const {
    return geometric_normal(scene_, hit.primitive, dvec3(eye + hit.t * direction));
  }

  // Moves the eye to `height` above the floor below it, if there is one and the way up from it is free.
  bool stand(vec3& eye, float height) const {
    const vec3 down(0.0f, -1.0f, 0.0f);
    const Hit floor = tracer_.intersect(eye, down);
    if (!floor.valid() || normal_at(floor, eye, down).y < 0.85) return false;
    const vec3 foot = eye + floor.t * down;
    if (tracer_.occluded(foot, -down, 0.02f * height, height + 0.4f * unit_)) return false;
    eye = foot - height * down;
    return true;
  }

  bool is_free(const vec3& eye) const {
    Surroundings all, level;
    for (int i = 0; i < kAround; ++i) {  // a spherical Fibonacci set
      const float y = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / kAround, r = std::sqrt(1.0f - y * y);
      const float phi = static_cast<float>(i) * kPi * (3.0f - std::sqrt(5.0f));
      look(all, eye, vec3(r * std::cos(phi), y, r * std::sin(phi)));
    }
    for (int i = 0; i < kLevel; ++i) {
      const float phi = 2.0f * kPi * static_cast<float>(i) / kLevel;
      look(level, eye, vec3(std::cos(phi), 0.0f, std::sin(phi)));
    }
    return std::min(all.nearest(), level.nearest()) >= 0.4f * unit_ && level.median() >= 1.5f * unit_ &&
           all.mostly_fronts();
  }

  bool sees_enough(const Camera& camera, double wanted) const {
    const vec3 forward = glm::normalize(camera.target - camera.eye);
    const vec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
    const float half = std::tan(0.5f * glm::radians(camera.vertical_fov));
    Surroundings view;
    for (int y = 0; y < kDown; ++y) {
      for (int x = 0; x < kAcross; ++x) {
        const float sx = (2.0f * (static_cast<float>(x) + 0.5f) / kAcross - 1.0f) * half * 16.0f / 9.0f;
        const float sy = (1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / kDown) * half;
        look(view, camera.eye, glm::normalize(forward + sx * right + sy * up));
      }
    }
    return view.covered() >= wanted && view.nearest() >= 0.4f * unit_ && view.nearer_than(unit_) <= 0.1 &&
           view.median() >= 2.5f * unit_ && view.mostly_fronts();
  }

  const Tracer& tracer_;
  const Scene& scene_;
  uint32_t number_;
  uint64_t seed_;
  float unit_;  // what counts as a metre
  uint32_t attempt_ = 0, dimension_ = 0;
};

}  // namespace

std::string seeded_camera_name(uint32_t number) {
  return std::string(kOne) + std::to_string(number);
}

std::optional<uint32_t> seeded_camera_number(std::string_view name) {
  return number_after(kOne, name, 0, kLargestSeededCamera);
}

std::optional<uint32_t> seeded_camera_count(std::string_view pattern) {
  return number_after(kMany, pattern, 1, kMostSeededCameras);
}

bool begins_like_seeded_camera(std::string_view text) {
  return text.starts_with(kOne) || text.starts_with(kMany);
}

Camera seeded_camera(const Tracer& tracer, uint32_t number, uint64_t seed) {
  Placement placement(tracer, number, seed);
  for (uint32_t attempt = 0; attempt < kMostDraws; ++attempt)
    if (std::optional<Camera> camera = placement.draw(attempt)) return *camera;
  throw InputError("scene " + tracer.scene().name, "no place was found for the camera " +
                                                       seeded_camera_name(number) +
                                                       "; expected free space from which surfaces are seen");
}

Camera camera_of(const Tracer& tracer, const std::string& name) {
  const std::optional<uint32_t> number = seeded_camera_number(name);
  return number ? seeded_camera(tracer, *number) : find_camera(tracer.scene(), name);
}

}  // namespace hybray
