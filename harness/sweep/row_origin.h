// What a row depends on besides the point that it is of.
#pragma once

#include <map>
#include <string>

namespace hybray {

// Named parts: `program` (program_identity), `instruction_sets` of the machine (the general tracer picks its
// kernels by them), `threads`, `timing`, and with timing the `cpu`. A row is taken over from an earlier
// session only where its id and all of these are the same: this run would then have made the same row, up to
// the noise of its times.
using RowOrigin = std::map<std::string, std::string>;

// Of rows made by this program, on this machine, now. `threads`: that parallel loops can use.
RowOrigin row_origin(bool timing, int threads);

// The names of the parts that are not the same in both, as "program, timing"; empty: none.
std::string difference(const RowOrigin& a, const RowOrigin& b);

}  // namespace hybray
