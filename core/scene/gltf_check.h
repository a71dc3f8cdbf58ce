// What a glTF document must look like before anything in it is used (glTF 2.0 specification, section 5,
// "Properties Reference").
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

// Checks the parts of a glTF document that the loader reads: types of properties, required properties, and
// every index against the length of the array that it points into. tinygltf itself lets wrong types pass as
// if they were absent, cuts large integers, and walks nested values by recursion. Throws InputError("file:
// /pointer/to/it", ...); also for extensions that are required and not known.
void check_gltf_json(const nlohmann::json& document, const std::string& file);

}  // namespace hybray
