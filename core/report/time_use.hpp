#pragma once

#include "core/base/mpi.hpp"
#include "core/base/threads.hpp"

namespace tushar::report {

/// Use of the threads' time, s, summed over all threads of all ranks.
struct TimeUse {
  double task = 0;       ///< in the bodies of tasks, and moving particles to other cells
  double message = 0;    ///< packing, unpacking and copying ghosts
  double output = 0;     ///< writing; the other threads wait meanwhile
  double wait = 0;       ///< the rest: waiting for others, or between loops
  double imbalance = 1;  ///< time of all loops over the time if each thread worked throughout

  TimeUse() = default;
  /// The difference to the times `before`, over `wall` seconds, of which `outputSeconds` were spent on output. Every
  /// rank makes it.
  TimeUse(const Threads::Use& before, const Threads& threads, double wall, double outputSeconds,
          const mpi::Communicator& ranks);
};

}  // namespace tushar::report
