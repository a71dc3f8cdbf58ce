#include "harness/sweep/interrupt.h"

#include <csignal>

namespace hybray {
namespace {

// A signal handler can reach nothing but a variable of static storage.
volatile std::sig_atomic_t g_interrupted = 0;

extern "C" void on_interrupt(int) {
  g_interrupted = 1;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  g_interrupted = 0;
  struct sigaction before = {}, action = {};
  sigaction(SIGINT, nullptr, &before);
  if (before.sa_handler == SIG_IGN) return;
  action.sa_handler = on_interrupt;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  installed_ = sigaction(SIGINT, &action, nullptr) == 0;
}

InterruptGuard::~InterruptGuard() {
  if (installed_) std::signal(SIGINT, SIG_DFL);
}

bool InterruptGuard::interrupted() const {
  return g_interrupted != 0;
}

}  // namespace hybray
