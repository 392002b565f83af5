#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/output/snapshot.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// A range of consecutive entries of an array.
struct Piece {
  std::size_t first = 0, count = 0;
};

/// Largest size of a piece [bytes]. On a single rank, a piece should fit into the processor's cache while it is
/// written. On several ranks, which wait for each other at each piece, it should be small compared with 64 MB.
std::size_t mostOfPiece(const Writers& writers);

/// Size of an entry in memory; `bytesOf`: size of all entries on all ranks [bytes].
std::size_t entryBytes(const Array& array);
std::uint64_t bytesOf(const Array& array);

/// Sends the pieces of a distributed array to the writers, one piece at a time to each writer. So a writer needs memory
/// for only one piece, and a rank for its parts of the other pieces.
class Pieces {
 public:
  /// `writers` must outlive this object.
  explicit Pieces(const Writers& writers) : writers_(&writers), outbox_(writers.ranks()) {}

  /// Sends each writer its piece of the array, which must have a source; `of[w]` is the piece of writer w. Returns the
  /// entries of this rank's own piece, stored in `into`, which is enlarged if necessary. Collective.
  std::span<std::byte> bring(const Array& array, std::span<const Piece> of, std::vector<std::byte>& into);

 private:
  const Writers* writers_;
  mpi::Outbox outbox_;
};

/// Moves the values of all arrays to rank 0; other ranks keep none. Collective.
void load(Snapshot& snapshot, const mpi::Communicator& ranks = mpi::Communicator::alone());

}  // namespace tushar::output
