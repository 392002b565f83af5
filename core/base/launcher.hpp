#pragma once

namespace tushar {

/// How many processes the launcher (mpirun, srun) has started this program as; 1 without a launcher.
/// Read from the environment that launchers set, so that MPI is not needed for it.
int launchedRanks();

/// The number of this process among them, from 0; 0 without a launcher.
int launchedRank();

/// How many of these processes are on this machine.
int ranksOnThisMachine();

/// Number of cores that the launcher gave to each process; the largest int if it is unknown.
int launchedCoresPerRank();

}  // namespace tushar
