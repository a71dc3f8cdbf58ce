// Tables for people, on a terminal or in a log.
#pragma once

#include <string>
#include <vector>

namespace hybray {

using TextTable = std::vector<std::vector<std::string>>;  // rows of equal length

// A line for each row: columns padded to the same width, counted in characters of UTF-8, with two spaces
// between them and none at the end.
std::string aligned_table(const TextTable& rows);

}  // namespace hybray
