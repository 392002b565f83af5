#include "core/base/interrupt.hpp"

#include <csignal>

namespace tushar {

namespace {
volatile std::sig_atomic_t interrupted = 0;

extern "C" void noteInterrupt(int) {
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}
}  // namespace

void catchInterrupts() {
  interrupted = 0;
  std::signal(SIGINT, noteInterrupt);
  std::signal(SIGTERM, noteInterrupt);
}

bool isInterrupted() { return interrupted != 0; }

}  // namespace tushar
