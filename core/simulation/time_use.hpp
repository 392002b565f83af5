#pragma once

#include "core/base/threads.hpp"

namespace tushar::simulation {

/// Where the time of the threads went, s of all threads together.
struct TimeUse {
  double task = 0;       ///< in the bodies of tasks, and moving particles to other cells
  double message = 0;    ///< filling ghosts
  double output = 0;     ///< writing; the other threads wait meanwhile
  double wait = 0;       ///< the rest: for others, or in between
  double imbalance = 1;  ///< time of all loops over what it would be if each thread worked all the time

  TimeUse() = default;
  /// From what the threads had done before, over `wall` seconds with `output` seconds of output among them.
  TimeUse(const Threads::Use& before, const Threads& threads, double wall, double output);
};

}  // namespace tushar::simulation
