// Main memory: how much there is, and how it is written.
#pragma once

#include <string>

namespace hybray {

// Bytes that a new program can use without swapping.
double available_memory_bytes();

// "3.2 GiB", "512 MiB", "0 B".
std::string format_bytes(double bytes);

}  // namespace hybray
