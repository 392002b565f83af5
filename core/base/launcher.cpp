#include "core/base/launcher.hpp"

#include <cstdlib>
#include <initializer_list>

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

}  // namespace tushar
