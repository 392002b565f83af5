#include "core/simulation/run_clock.hpp"

#include "core/base/interrupt.hpp"

namespace tushar::simulation {

void RunClock::agree(const mpi::Communicator& ranks) {
  const double time = now();
  const TriggerFiles::Found files = files_ ? files_->look(time) : TriggerFiles::Found{};
  const bool saves = tushar::takeSaveSignal() || files.output;
  double seen[] = {time, tushar::isInterrupted() ? 1.0 : 0.0, files.stop ? 1.0 : 0.0, saves ? 1.0 : 0.0,
                   failed_ ? 1.0 : 0.0};
  ranks.max(seen);
  elapsed_ = seen[0];
  interrupted_ = seen[1] > 0;
  stopped_ = stopped_ || seen[2] > 0;
  save_asked_ = save_asked_ || seen[3] > 0;
  failed_ = seen[4] > 0;
}

}  // namespace tushar::simulation
