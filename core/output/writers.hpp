#pragma once

#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::output {

/// The ranks that take part in writing files, and the writers among them, which write the bytes. The first writer is
/// rank 0.
class Writers {
 public:
  /// A single process, which is the only writer.
  Writers() : Writers(mpi::Communicator::alone(), {0}) {}
  /// Writers with these rank indices, ascending from 0. `ranks` must outlive this object.
  Writers(const mpi::Communicator& ranks, std::vector<int> writers);
  /// Selects `count` evenly spaced ranks as writers, at most all ranks; if `count` is 0, one rank on each node. The
  /// value of `count` on rank 0 applies to all ranks. Collective.
  static Writers spread(const mpi::Communicator& ranks, int count);

  /// Returns a selection that contains rank 0 and the writers that pass `true`. Collective.
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
