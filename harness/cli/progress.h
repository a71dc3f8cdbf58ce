// How far a run is, on stderr: one line that is redrawn on a terminal, a log line per point elsewhere.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace hybray {

// "0:42", "12:05", "3:04:05".
std::string format_duration(double seconds);

class Progress {
 public:
  // `costs`: the estimated seconds of each point; what is left is estimated from them and from how long the
  // points so far really took.
  Progress(std::string title, std::vector<double> costs, bool quiet);

  void point_starts(size_t index, const std::string& label);
  void point_done(size_t index, const std::string& label);
  void clear();  // takes the line off the terminal, before a message

 private:
  double elapsed() const;
  double remaining(size_t done) const;  // seconds; negative: not known yet

  std::string title_;
  std::vector<double> costs_;
  bool redraw_, quiet_, drawn_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace hybray
