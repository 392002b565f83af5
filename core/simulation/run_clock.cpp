#include "core/simulation/run_clock.hpp"

#include "core/base/interrupt.hpp"

namespace tushar::simulation {

void RunClock::agree(const mpi::Communicator& ranks) {
  double seen[] = {now(), tushar::isInterrupted() ? 1.0 : 0.0};
  ranks.max(seen);
  elapsed_ = seen[0];
  interrupted_ = seen[1] > 0;
}

}  // namespace tushar::simulation
