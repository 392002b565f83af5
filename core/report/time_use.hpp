#pragma once

#include "core/base/mpi.hpp"
#include "core/base/threads.hpp"

namespace tushar::report {

/// How the threads spent their time [s], summed over all threads of all ranks.
struct TimeUse {
  double task = 0;       ///< running task bodies, and moving particles to other cells
  double message = 0;    ///< packing, unpacking and copying ghosts
  double output = 0;     ///< writing output, while the other threads wait
  double wait = 0;       ///< the remaining time: waiting for others, or between loops
  double imbalance = 1;  ///< ratio of the time of all loops to the time that perfectly balanced threads would need

  TimeUse() = default;
  /// The time used since `before`, in `wall` seconds, of which `outputSeconds` were spent on output. All ranks must
  /// construct it.
  TimeUse(const Threads::Use& before, const Threads& threads, double wall, double outputSeconds,
          const mpi::Communicator& ranks);
};

}  // namespace tushar::report
