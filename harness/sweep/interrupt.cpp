#include "harness/sweep/interrupt.h"

#include <csignal>
#include <iterator>

namespace hybray {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM};

// A signal handler can reach nothing but a variable of static storage.
volatile std::sig_atomic_t g_interrupted = 0;

extern "C" void on_interrupt(int) {
  g_interrupted = 1;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  g_interrupted = 0;
  std::signal(SIGXFSZ, SIG_IGN);
  for (size_t i = 0; i < std::size(kSignals); ++i) {
    struct sigaction before = {}, action = {};
    sigaction(kSignals[i], nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;
    action.sa_handler = on_interrupt;
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    installed_[i] = sigaction(kSignals[i], &action, nullptr) == 0;
  }
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGXFSZ, SIG_DFL);
  for (size_t i = 0; i < std::size(kSignals); ++i) {
    if (installed_[i]) std::signal(kSignals[i], SIG_DFL);
  }
}

bool InterruptGuard::interrupted() const {
  return g_interrupted != 0;
}

}  // namespace hybray
