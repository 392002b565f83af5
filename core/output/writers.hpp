#pragma once

#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::output {

/// Ranks that write files together, and those among them that write the bytes. The first of these is rank 0.
class Writers {
 public:
  /// One process on its own.
  Writers() : Writers(mpi::Communicator::alone(), {0}) {}
  /// Ranks of these numbers, ascending from 0. `ranks` must outlive it.
  Writers(const mpi::Communicator& ranks, std::vector<int> writers);
  /// `count` of the ranks, as rank 0 says, evenly spread; 0: one on each node. No more than there are. Collective.
  static Writers spread(const mpi::Communicator& ranks, int count);

  /// The ranks that pass `true`, and rank 0. Collective.
  Writers only(bool mine) const;

  const mpi::Communicator& ranks() const { return *ranks_; }
  int count() const { return static_cast<int>(writers_.size()); }
  int rankOf(int writer) const { return writers_[writer]; }
  /// Which of the writers this rank is; -1: none.
  int mine() const { return mine_; }

 private:
  const mpi::Communicator* ranks_;
  std::vector<int> writers_;
  int mine_;
};

}  // namespace tushar::output
