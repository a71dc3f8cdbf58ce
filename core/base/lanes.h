// Which of the instruction sets that the vector code (lanes-inl.h) is compiled for this machine runs.
#pragma once

#include <string>
#include <vector>

namespace hybray {

// The one in use, such as "AVX3" (AVX-512) or "AVX2".
std::string lanes_target();

// All that this machine can run, the one in use first.
std::vector<std::string> lanes_targets();

// Restricts the vector code to one of lanes_targets(); an empty name allows all again. For tests and
// benchmarks: while it runs, no other thread may use vector code.
void use_lanes_target(const std::string& name);

}  // namespace hybray
