#include "harness/sweep/interrupt.h"

#include <csignal>

#include <gtest/gtest.h>
#include <unistd.h>

namespace hybray {
namespace {

// Each in a process of its own: what a signal does is the process's.
enum Exit { kAsExpected = 0, kNotInterrupted = 1, kStillThere = 2 };

TEST(InterruptGuard, NotesTheFirstSignalAndLetsTheSecondEndTheProgram) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          const InterruptGuard guard;
          std::raise(signal);
          if (!guard.interrupted()) _exit(kNotInterrupted);
          std::raise(signal);
          _exit(kStillThere);
        },
        testing::KilledBySignal(signal), "");
  }
}

TEST(InterruptGuard, LeavesASignalAloneThatIsIgnored) {
  EXPECT_EXIT(
      {
        std::signal(SIGINT, SIG_IGN);
        const InterruptGuard guard;
        std::raise(SIGINT);
        _exit(guard.interrupted() ? kStillThere : kAsExpected);
      },
      testing::ExitedWithCode(kAsExpected), "");
}

TEST(InterruptGuard, BringsTheUsualHandlingBackWhenItEnds) {
  EXPECT_EXIT(
      {
        { const InterruptGuard guard; }
        std::raise(SIGTERM);
        _exit(kStillThere);
      },
      testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace hybray
