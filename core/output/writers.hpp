#pragma once

#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::output {

/// Ranks that write files together, and the writers among them, which write the bytes. The first of these is rank 0.
class Writers {
 public:
  /// A single process.
  Writers() : Writers(mpi::Communicator::alone(), {0}) {}
  /// The ranks with these numbers, ascending from 0. `ranks` must outlive it.
  Writers(const mpi::Communicator& ranks, std::vector<int> writers);
  /// `count` evenly spread ranks, as given on rank 0; 0: one on each node. No more than there are. Collective.
  static Writers spread(const mpi::Communicator& ranks, int count);

  /// The ranks that pass `true`, and rank 0. Collective.
  Writers only(bool mine) const;

  const mpi::Communicator& ranks() const { return *ranks_; }
  int count() const { return static_cast<int>(writers_.size()); }
  int rankOf(int writer) const { return writers_[writer]; }
  /// Index of this rank among the writers; -1 if it is not a writer.
  int mine() const { return mine_; }

 private:
  const mpi::Communicator* ranks_;
  std::vector<int> writers_;
  int mine_;
};

}  // namespace tushar::output
