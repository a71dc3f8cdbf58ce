// What one parameter accepts: as a check, in words for messages and docs, and as a value read from text.
#pragma once

#include "harness/experiments/experiment.h"

#include <span>
#include <string>
#include <utility>

namespace hybray {

// What a config may give, in words: `an integer from 1 to 9`, `one of "standard", "reversed"`.
std::string expectation(const Parameter& parameter);

// Whether the parameter accepts `value`; an integer given for a number becomes one.
bool accept(const Parameter& parameter, Value& value);

// `value` as JSON would write it: "text", 1.5, true, null.
std::string json_text(const Value& value);

// `found X; expected Y`, with the nearest choice where there is one. `found` is X as the user wrote it.
std::string rejection(const Parameter& parameter, const std::string& found, const Value& value);

// The value that KEY=VALUE on the command line gives: text for names and choices, else JSON. Throws
// InputError with `place` where the parameter does not accept it.
Value value_from_text(const Parameter& parameter, const std::string& text, const std::string& place);

// Whether `value` is the "*" that stands for each camera of a scene.
bool stands_for_every_camera(const Parameter& parameter, const Value& value);

// Whether `value` stands for several cameras: "*", or "seeded*COUNT".
bool stands_for_cameras(const Parameter& parameter, const Value& value);

// The values that `value` stands for in any scene: "seeded/0" and so on for "seeded*COUNT", else itself
// alone.
std::vector<Value> expanded(const Parameter& parameter, const Value& value);

// What is wrong with `value` as one of `count` values, that is with "*" among several; empty: nothing.
std::string star_problem(const Parameter& parameter, const Value& value, size_t count);

// The experiment's parameter of that name, or nullptr.
const Parameter* find_parameter(const Experiment& experiment, const std::string& name);

// Its first parameter of that type, or nullptr.
const Parameter* parameter_of_type(const Experiment& experiment, ParameterType type);

// `unknown parameter "x"; did you mean "y"?`
std::string unknown_parameter(const Experiment& experiment, const std::string& name);

// `unknown experiment "x"; did you mean "y"?`
std::string unknown_experiment(const std::string& name, std::span<const Experiment> experiments);

// `; did you mean "y"?`, or `; known are: y, z` where nothing is near.
std::string suggestion(const std::string& name, const std::vector<std::string>& known);

// `unknown WHAT "x"` with the suggestion.
std::string unknown_name(const std::string& what, const std::string& name,
                         const std::vector<std::string>& known);

// The sides that a resolution parameter accepts, pixels: its range, or 1 to 65536.
std::pair<int64_t, int64_t> side_range(const Parameter& parameter);

}  // namespace hybray
