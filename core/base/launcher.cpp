#include "core/base/launcher.hpp"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <limits>

namespace tushar {

namespace {

int numberFrom(std::initializer_list<const char*> names, int otherwise) {
  for (const char* name : names)
    if (const char* value = std::getenv(name)) return static_cast<int>(std::strtol(value, nullptr, 10));
  return otherwise;
}

/// The value of a variable of Slurm, if srun has started processes that connect by PMIx; otherwise `otherwise`. Slurm's
/// other variables do not imply several ranks: a program that is started without srun in an allocation of many cores
/// has them, too.
int fromSlurm(const char* name, int otherwise) {
  return std::getenv("PMIX_RANK") ? numberFrom({name}, otherwise) : otherwise;
}

}  // namespace

int launchedRanks() {
  return numberFrom({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"}, fromSlurm("SLURM_STEP_NUM_TASKS", 1));
}

int launchedRank() {
  return numberFrom({"OMPI_COMM_WORLD_RANK", "PMI_RANK", "MV2_COMM_WORLD_RANK"}, fromSlurm("SLURM_PROCID", 0));
}

int ranksOnThisMachine() {
  return std::max(1, numberFrom({"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "MV2_COMM_WORLD_LOCAL_SIZE"},
                                fromSlurm("SLURM_STEP_TASKS_PER_NODE", 1)));
}

int launchedCoresPerRank() {
  const int cores = numberFrom({"SLURM_CPUS_PER_TASK"}, 0);
  return cores > 0 ? cores : std::numeric_limits<int>::max();
}

}  // namespace tushar
