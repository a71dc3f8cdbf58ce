#include "harness/sweep/shard.h"

#include "core/base/error.h"
#include "harness/config/parameter_rules.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace hybray {
namespace {

// One point in the line that is cut.
struct Place {
  size_t point = 0;      // in frozen order
  double seconds = 0.0;  // of itself
  std::vector<SharedCost> shared;
};

// Numbers texts in the order in which they first come.
class Numbers {
 public:
  size_t of(const std::string& text) { return known_.emplace(text, known_.size()).first->second; }

 private:
  std::map<std::string, size_t> known_;
};

std::vector<Place> line_up(const Experiment& experiment, const FrozenSweep& sweep) {
  const Parameter* scene = parameter_of_type(experiment, ParameterType::scene);
  Numbers scenes, references;
  std::vector<std::pair<size_t, size_t>> group;  // scene, and all that is shared, of each point
  std::vector<Place> line;
  for (const Point& point : sweep.points) {
    const std::string name = scene ? point.text(scene->name) : "";
    const auto found = sweep.scenes.find(name);
    const SceneFacts facts = found == sweep.scenes.end() ? SceneFacts{} : found->second;
    Place place;
    place.point = line.size();
    // Where nobody knows, all points cost the same.
    place.seconds = experiment.cost_seconds ? std::max(experiment.cost_seconds(point, facts), 1e-9) : 1.0;
    if (experiment.shared_costs) place.shared = experiment.shared_costs(point, facts);
    std::string keys;
    for (const SharedCost& shared : place.shared) keys += shared.key + '\n';
    group.emplace_back(scenes.of(name), references.of(keys));
    line.push_back(std::move(place));
  }
  std::stable_sort(line.begin(), line.end(),
                   [&](const Place& a, const Place& b) { return group[a.point] < group[b.point]; });
  return line;
}

// What a cut between two neighbours makes the later piece prepare once more, seconds.
double prepared_again(const Place& before, const Place& after) {
  double seconds = 0.0;
  for (const SharedCost& shared : after.shared) {
    const auto same = [&](const SharedCost& other) { return other.key == shared.key; };
    if (std::any_of(before.shared.begin(), before.shared.end(), same)) seconds += shared.seconds;
  }
  return seconds;
}

// Where the piece that begins at `begin` ends when `pieces` are still to be made of the rest.
size_t piece_end(const std::vector<Place>& line, size_t begin, int pieces) {
  const size_t points = line.size(), later = static_cast<size_t>(pieces - 1);
  if (later == 0) return points;
  if (points - begin <= later) return std::min(begin + 1, points);
  const auto seconds_of = [&](size_t i, bool first) {
    double seconds = line[i].seconds;
    for (const SharedCost& shared : line[i].shared) seconds += shared.seconds;
    return first ? seconds : seconds - prepared_again(line[i - 1], line[i]);
  };
  // What is left for the later pieces, without what a cut adds.
  double rest = 0.0;
  for (size_t i = begin; i < points; ++i) rest += seconds_of(i, i == begin);
  size_t best = begin + 1;
  double best_wait = std::numeric_limits<double>::infinity(), cost = 0.0;
  for (size_t end = begin + 1; end + later <= points; ++end) {
    const double seconds = seconds_of(end - 1, end - 1 == begin);
    cost += seconds, rest -= seconds;
    // All are done when the slowest is.
    const double wait =
        std::max(cost, (rest + prepared_again(line[end - 1], line[end])) / static_cast<double>(later));
    if (wait < best_wait) best = end, best_wait = wait;
  }
  return best;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  Shard shard{0, 0};
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  bool valid = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  if (valid) {
    const auto count = std::from_chars(index.ptr + 1, end, shard.count);
    valid = count.ec == std::errc() && count.ptr == end && 1 <= shard.index && shard.index <= shard.count;
  }
  if (!valid) throw InputError("--shard " + text, "expected I/N, such as 2/3, with I from 1 to N");
  return shard;
}

std::vector<Point> points_of_shard(const Experiment& experiment, const FrozenSweep& sweep, Shard shard) {
  const std::vector<Place> line = line_up(experiment, sweep);
  size_t begin = 0, end = 0;
  for (int piece = 1; piece <= shard.index; ++piece) {
    begin = end;
    end = piece_end(line, begin, shard.count - piece + 1);
  }
  std::vector<size_t> chosen;
  for (size_t i = begin; i < end; ++i) chosen.push_back(line[i].point);
  std::sort(chosen.begin(), chosen.end());
  std::vector<Point> result;
  for (const size_t i : chosen) result.push_back(sweep.points[i]);
  return result;
}

}  // namespace hybray
