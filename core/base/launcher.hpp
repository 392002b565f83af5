#pragma once

namespace tushar {

/// How many processes the launcher (mpirun, srun) has started this program as; 1 without a launcher.
/// Read from the environment that launchers set, so that MPI is not needed for it.
int launchedRanks();

/// The number of this process among them, from 0; 0 without a launcher.
int launchedRank();

/// How many of them are on this machine.
int ranksOnThisMachine();

/// Cores that the launcher gave to each process; the greatest int if that is unknown.
int launchedCoresPerRank();

}  // namespace tushar
