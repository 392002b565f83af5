#pragma once

namespace tushar {

/// Number of processes that the launcher (mpirun, srun) has started; 1 without a launcher. Read from the environment
/// that launchers set, so that MPI is not needed for it.
int launchedRanks();

/// Index of this process among them, from 0; 0 without a launcher.
int launchedRank();

/// Number of these processes on this machine.
int ranksOnThisMachine();

/// Number of cores that the launcher gave to each process; the largest int if it is unknown.
int launchedCoresPerRank();

}  // namespace tushar
