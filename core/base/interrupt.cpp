#include "core/base/interrupt.hpp"

#include <csignal>

namespace tushar {

namespace {
volatile std::sig_atomic_t interrupted = 0, saveAsked = 0;

/// Records the first signal. The second one has its default effect; if it arrives before the first has been handled, it
/// is raised again.
extern "C" void noteInterrupt(int signal) {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (interrupted) std::raise(signal);
  interrupted = 1;
}

extern "C" void noteSaveSignal(int) { saveAsked = 1; }
}  // namespace

void catchInterrupts() {
  interrupted = 0;
  std::signal(SIGINT, noteInterrupt);
  std::signal(SIGTERM, noteInterrupt);
  std::signal(SIGUSR1, noteSaveSignal);
  std::signal(SIGXFSZ, SIG_IGN);  // so that a write beyond the limit fails with an error
}

bool isInterrupted() { return interrupted != 0; }

bool takeSaveSignal() {
  if (!saveAsked) return false;
  saveAsked = 0;
  return true;
}

}  // namespace tushar
