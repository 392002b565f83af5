#pragma once

namespace tushar {

/// How many processes the launcher (mpirun, srun) has started this program as; 1 without a launcher.
/// Read from the environment that launchers set, so that MPI is not needed to know.
int launchedRanks();

}  // namespace tushar
