#include "harness/cli/progress.h"

#include "harness/cli/log.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace hybray {

std::string format_duration(double seconds) {
  const auto s = static_cast<long long>(std::max(0.0, seconds) + 0.5);
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

Progress::Progress(std::string title, std::vector<double> costs, bool quiet)
    : title_(std::move(title)),
      costs_(std::move(costs)),
      redraw_(stderr_is_terminal() && !quiet),
      quiet_(quiet) {}

void Progress::point_starts(size_t index, const std::string& label) {
  if (!redraw_) return;
  constexpr size_t kBar = 24;
  const size_t filled = kBar * index / costs_.size();
  const double left = remaining(index);
  const std::string time = left < 0 ? "" : format_duration(left) + " left  ";
  std::string line = fmt::format("{} [{:#<{}}{:.<{}}] {}/{}  {}{}", title_, "", filled, "", kBar - filled,
                                 index + 1, costs_.size(), time, label);
  if (const size_t columns = stderr_columns(); line.size() >= columns) line.resize(columns - 1);
  fmt::print(stderr, "\r\x1b[K{}", line);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::point_done(size_t index, const std::string& label) {
  if (redraw_ || quiet_) return;
  const double left = remaining(index + 1);
  log_info(fmt::format("{} {}/{} {} ({} so far, about {} left)", title_, index + 1, costs_.size(), label,
                       format_duration(elapsed()), format_duration(left)));
}

void Progress::clear() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
  drawn_ = false;
}

double Progress::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double Progress::remaining(size_t done) const {
  const auto split = costs_.begin() + static_cast<std::ptrdiff_t>(done);
  const double before = std::accumulate(costs_.begin(), split, 0.0);
  const double after = std::accumulate(split, costs_.end(), 0.0);
  if (before <= 0) return done == 0 ? -1 : 0;
  return elapsed() * after / before;
}

}  // namespace hybray
