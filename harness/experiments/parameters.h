// Shorthand for the parameters that experiments declare, and those that they have in common.
#pragma once

#include "harness/experiments/experiment.h"

#include <utility>

namespace hybray::parameter {

inline Parameter number(const char* name, const char* unit, double standard, double least, double most,
                        const char* text) {
  return {name, ParameterType::number, unit, standard, least, most, {}, text};
}
inline Parameter integer(const char* name, const char* unit, int64_t standard, double least, double most,
                         const char* text) {
  return {name, ParameterType::integer, unit, standard, least, most, {}, text};
}
inline Parameter choice(const char* name, const char* standard, std::vector<std::string> choices,
                        const char* text) {
  return {name, ParameterType::choice, "", std::string(standard), {}, {}, std::move(choices), text};
}
inline Parameter flag(const char* name, bool standard, const char* text) {
  return {name, ParameterType::boolean, "", standard, {}, {}, {}, text};
}

inline Parameter scene() {
  return {
      "scene", ParameterType::scene, "", std::monostate{}, {}, {}, {}, "Scene by name (hybray scene list)."};
}
inline Parameter camera() {
  const char* text = "Camera of the scene by name; \"*\" stands for each of them.";
  return {"camera", ParameterType::camera, "", std::string("*"), {}, {}, {}, text};
}
inline Parameter resolution(const char* standard) {
  const char* text = "Width and height of the main view.";
  return {"resolution", ParameterType::resolution, "px", std::string(standard), 1, 16384, {}, text};
}
inline Parameter near_plane(double standard) {
  return number("near", "m", standard, 1e-9, 1e9, "Distance of the near plane.");
}
inline Parameter repeats() {
  return integer("repeats", "", 7, 1, 1000, "Timed rounds after one that is not counted.");
}

}  // namespace hybray::parameter
