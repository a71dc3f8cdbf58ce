// One of several parts of a sweep, for one of several machines.
#pragma once

#include "harness/sweep/freeze.h"

#include <string>
#include <vector>

namespace hybray {

struct Shard {
  int index = 1, count = 1;  // 1 <= index <= count
};

// Reads "2/3". Throws InputError for anything else.
Shard parse_shard(const std::string& text);

// The points of one shard, in frozen order. The same sweep and count give the same parts on every machine;
// each point is in exactly one of them.
//
// The points stand in line, those of one scene together and in it those that share a reference, and the line
// is cut into pieces of about the same estimated cost. What a cut makes both sides prepare for themselves,
// such as a converged reference, counts against it. No piece is empty unless there are fewer points than
// pieces.
std::vector<Point> points_of_shard(const Experiment& experiment, const FrozenSweep& sweep, Shard shard);

}  // namespace hybray
