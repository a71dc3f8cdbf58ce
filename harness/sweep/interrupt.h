// Ctrl-C during a run: the first asks it to stop after the present point, the second ends the program.
#pragma once

namespace hybray {

// While it lives, the first SIGINT sets a flag and brings back the usual handling, so that the second ends
// the program. Where SIGINT is ignored, as in a job that a shell started in the background, it stays so.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool interrupted() const;

 private:
  bool installed_ = false;
};

}  // namespace hybray
