#pragma once

namespace tushar {

/// Number of processes started by the launcher (mpirun, srun); 1 without a launcher. Reads environment variables that
/// launchers set, so MPI need not be initialised.
int launchedRanks();

/// Index of this process among those started by the launcher, from 0; 0 without a launcher.
int launchedRank();

/// Number of processes started by the launcher on this machine.
int ranksOnThisMachine();

/// Number of cores that the launcher assigned to each process; the largest int if it is unknown.
int launchedCoresPerRank();

}  // namespace tushar
