// Ctrl-C during a run, or SIGTERM, as a batch system sends before it kills: the first asks it to stop after
// the present point, the second ends the program.
#pragma once

namespace hybray {

// While it lives, the first SIGINT or SIGTERM sets a flag and brings back the usual handling, so that the
// second of its kind ends the program. Where one is ignored, as SIGINT in a job that a shell started in the
// background, it stays so. A file that grows beyond the limit of the process is an error of the write, as on
// a full disk, and no signal that kills.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool interrupted() const;

 private:
  bool installed_[2] = {};  // for each of the two signals
};

}  // namespace hybray
