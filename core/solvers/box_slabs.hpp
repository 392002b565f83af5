#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/base/threads.hpp"

namespace tushar::solvers {

/// Who works on which part of a box of cells. Each rank of a communicator has a slab of the box: consecutive planes,
/// that is cells with the same place along the last axis. The threads of a rank share its planes. Results are bitwise
/// equal for any ranks and threads, since sums are those of planes, added in the order of the planes.
class BoxSlabs {
 public:
  /// All planes are on this rank. `threads` must outlive all that is made with it; null: this thread alone.
  explicit BoxSlabs(int planes, Threads* threads = nullptr);
  /// The planes are divided among the ranks, of which there must be no more than mostRanks(planes).
  BoxSlabs(int planes, const mpi::Communicator& ranks, Threads* threads = nullptr);

  /// The largest number of ranks that can share so many planes: each gets at least four, so that it can coarsen them.
  static int mostRanks(int planes) { return std::max(1, planes / 4); }

  /// The first planes of the slabs of so many ranks, and the number of planes.
  static std::vector<int> borders(int planes, int ranks);

  const mpi::Communicator& ranks() const { return *ranks_; }
  bool isWhole() const { return ranks_->isAlone(); }
  /// Number of planes of the box, the first one of this rank, and the number of those that it has.
  int planes() const { return borders_.back(); }
  int first() const { return borders_[ranks_->rank()]; }
  int own() const { return borders_[ranks_->rank() + 1] - first(); }
  /// Whether each slab begins at an even plane, so that two planes that become one are on the same rank.
  bool isEven() const;
  /// The same ranks after `ratio` planes have become one; slabs must begin at multiples of it.
  BoxSlabs coarser(int ratio) const;
  /// All planes on each of the ranks, which do the same work.
  BoxSlabs whole() const { return BoxSlabs(planes(), threads_); }

  /// Calls work(z) for each of the rank's planes, which have so many cells, possibly on several threads.
  template <class Work>
  void forEachPlane(std::size_t cells, const Work& work) const {
    const int parts = partsOf(cells);
    if (parts == 1) return workOn(0, own(), work);
    threads_->forEach(parts, [&](int k) { workOn(own() * k / parts, own() * (k + 1) / parts, work); });
  }
  /// Given a number for each plane of the box, of which this rank knows those of its own planes, returns the sum.
  double sum(std::span<double> ofPlanes) const;
  /// Given values of all planes of the box, of which this rank has those of its own planes, gets those of others.
  template <class Value>
  void complete(std::span<Value> ofPlanes) const {
    completeBytes(std::as_writable_bytes(ofPlanes));
  }
  /// Given values of the rank's planes and of a layer of one plane on both sides, fills that layer: from other ranks,
  /// and along a periodic axis from the other end of the box; or only the part below the first plane.
  template <class Value>
  void fillLayers(std::span<Value> values, bool isPeriodic, bool alsoAbove) const {
    fillLayerBytes(std::as_writable_bytes(values), isPeriodic, alsoAbove);
  }

 private:
  template <class Work>
  static void workOn(int from, int to, const Work& work) {
    for (int z = from; z < to; ++z) work(z);
  }
  /// The number of parts into which a loop over planes is divided.
  int partsOf(std::size_t cells) const {
    constexpr std::size_t worthwhile = 8192;  // cells of a part; starting threads takes as long as some thousand cells
    if (!threads_ || threads_->count() == 1) return 1;
    const std::size_t most = cells * static_cast<std::size_t>(own()) / worthwhile;
    return std::clamp(static_cast<int>(most), 1, std::max(1, std::min(own(), threads_->count())));
  }
  void completeBytes(std::span<std::byte> ofPlanes) const;
  void fillLayerBytes(std::span<std::byte> values, bool isPeriodic, bool alsoAbove) const;

  const mpi::Communicator* ranks_ = &mpi::Communicator::alone();
  Threads* threads_ = nullptr;
  std::vector<int> borders_;  ///< the first plane of each rank, and the number of planes
};

}  // namespace tushar::solvers
