#include "core/simulation/time_use.hpp"

#include <algorithm>

namespace tushar::simulation {

TimeUse::TimeUse(const Threads::Use& before, const Threads& threads, double wall, double outputSeconds)
    : task(threads.use().task - before.task),
      message(threads.use().message - before.message),
      output(outputSeconds),
      wait(std::max(0.0, threads.count() * wall - task - message - output)) {
  const double loops = threads.count() * (threads.use().loops - before.loops);
  if (task + message > 0) imbalance = loops / (task + message);
}

}  // namespace tushar::simulation
