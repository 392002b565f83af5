#include "core/base/interrupt.hpp"

#include <csignal>

namespace tushar {

namespace {
volatile std::sig_atomic_t interrupted = 0;

/// A second signal finds the default; where both came before the first was noted, it is raised again for that.
extern "C" void noteInterrupt(int signal) {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (interrupted) std::raise(signal);
  interrupted = 1;
}
}  // namespace

void catchInterrupts() {
  interrupted = 0;
  std::signal(SIGINT, noteInterrupt);
  std::signal(SIGTERM, noteInterrupt);
}

bool isInterrupted() { return interrupted != 0; }

}  // namespace tushar
