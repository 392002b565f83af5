#include "core/base/launcher.hpp"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <limits>

namespace tushar {

namespace {

int numberFrom(std::initializer_list<const char*> names, int otherwise) {
  for (const char* name : names)
    if (const char* value = std::getenv(name)) return std::atoi(value);
  return otherwise;
}

}  // namespace

int launchedRanks() { return numberFrom({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"}, 1); }

int launchedRank() { return numberFrom({"OMPI_COMM_WORLD_RANK", "PMI_RANK", "MV2_COMM_WORLD_RANK"}, 0); }

int ranksOnThisMachine() {
  return std::max(1, numberFrom({"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "MV2_COMM_WORLD_LOCAL_SIZE"}, 1));
}

int launchedCoresPerRank() {
  const int cores = numberFrom({"SLURM_CPUS_PER_TASK"}, 0);
  return cores > 0 ? cores : std::numeric_limits<int>::max();
}

}  // namespace tushar
