// The known name nearest to a misspelt one, for error messages.
#pragma once

#include <span>
#include <string>

namespace hybray {

// The name in `known` with the fewest edits from `word` (insertion, deletion, substitution, swap of
// neighbours; case counts for less than an edit), or "" if none is near: at most one edit for every three
// letters of `word`, and at least one. The first of equals wins.
std::string nearest_name(const std::string& word, std::span<const std::string> known);

}  // namespace hybray
