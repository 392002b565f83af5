#include "components/mpm/solid/grains/form_clusters.hpp"

#include <cstring>

namespace tushar::mpm::solid {

std::vector<GrainBox> gatheredBoxes(std::vector<GrainBox> mine, const mpi::Communicator& ranks) {
  if (!ranks.isAlone()) {
    mpi::Bytes bytes;
    mpi::append(bytes, mine.data(), mine.size() * sizeof(GrainBox));
    mine.clear();
    for (int rank = 0; rank < ranks.size(); ++rank) {
      const mpi::Bytes theirs = ranks.broadcast(rank == ranks.rank() ? bytes : mpi::Bytes(), rank);
      const std::size_t before = mine.size();
      mine.resize(before + theirs.size() / sizeof(GrainBox));
      if (!theirs.empty()) std::memcpy(mine.data() + before, theirs.data(), theirs.size());
    }
  }
  std::sort(mine.begin(), mine.end());
  return mine;
}

}  // namespace tushar::mpm::solid
