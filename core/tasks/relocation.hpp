#pragma once

#include <compare>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/threads.hpp"
#include "core/data/warehouse.hpp"
#include "core/tasks/emigration.hpp"

namespace tushar::tasks {

/// Brings particles to the cell and patch where they are now, in the order (cell, id), and their variables with them.
///
/// Keeps its working memory from step to step.
class Relocation {
 public:
  Relocation(data::Warehouse& warehouse, Threads& threads)
      : warehouse_(&warehouse), threads_(&threads), emigration_(warehouse) {}

  /// Builds the new particle set of a material from the old one and the new values of `position`; afterwards every
  /// carried variable is new and follows the new set. Particles that left through a periodic face come in at the opposite
  /// one; those that left through a free face are dropped.
  ///
  /// All ranks run it together. False if one of them has stopped before: then nothing is done on any.
  /// Throws NumericalError, on all ranks, for a position that is not finite or lies behind a symmetry plane.
  bool run(int material, int position, const std::vector<Carried>& carried, bool hasStopped);

  /// This rank has other patches from now on.
  void forgetLayout();

  /// A step begins, perhaps for the second time.
  void start() { leaving_ = 0; }
  /// The step counts.
  void commit() { dropped_ += std::exchange(leaving_, 0); }
  /// Particles that have left the grid from this rank since the start.
  long dropped() const { return dropped_; }
  /// Goes on counting from what another run had dropped.
  void setDropped(long dropped) { dropped_ = dropped; }

 private:
  /// A particle that comes into a cell, from this patch or another.
  struct Incoming {
    ParticleId id;
    int patch, place;  ///< where it was; patch -1: on another rank, place among those that came from there
    int next;          ///< the incoming particle of the same cell with the next greater id, or -1
  };
  /// A particle that goes to a cell of another patch.
  struct Outgoing {
    Index3 cell;
    Incoming particle;
  };
  /// A particle that went where none can be; of several the first by cell and id.
  struct Escape {
    std::uint64_t cell;
    ParticleId id;
    int patch, place;

    friend auto operator<=>(const Escape&, const Escape&) = default;
  };
  /// What all ranks must know before any goes on.
  struct Verdict {
    bool hasStopped, hasEscape, goFar;
    int rank;  ///< of the escape
    Escape escape;

    void merge(const Verdict& other);
  };
  /// Consecutive places of the new set: a copy of consecutive places before from `from` on, or (-1) gathered by
  /// `source`.
  struct Piece {
    int to, count, from;
  };
  struct PatchMoves {
    std::vector<int> departed;       ///< places of the patch's particles that leave their cell, ascending
    std::vector<Outgoing> outgoing;  ///< of these, the ones that go to other patches
    std::vector<Incoming> incoming;  ///< particles that come into a cell of the patch
    std::vector<int> firstIncoming;  ///< by cell, or -1
    std::vector<char> isEntered;     ///< by row of cells along the first axis: whether particles come in
    std::vector<Piece> pieces;
    /// For each gathered particle of the new set its place before (0 if it comes from another patch).
    std::vector<int> source;
    int count = 0;                             ///< of the new set
    std::vector<std::pair<int, int>> foreign;  ///< new place and index in `incoming` of those from other patches
    std::optional<Escape> escape;
    long leaving = 0;  ///< through free faces of the grid
  };

  template <class Work>
  void forEachPatch(const Work& work);
  template <int D>
  void findMoves(int material, int position, int id);
  template <int D>
  void findMoves(const grid::Patch& patch, const data::ParticleSet& set, Vec<D>* x, const ParticleId* ids);
  template <int D>
  void move(const grid::Patch& from, const Index<D>& cell, Vec<D>& x, ParticleId id, int place);
  PatchMoves& movesOf(const grid::Patch& patch) {
    return moves_[static_cast<std::size_t>(patch.id() - warehouse_->level().firstPatch())];
  }
  /// Sorts out what left its patch: who escaped first, how many left the grid, who goes to another rank.
  Verdict gatherMoves(bool hasStopped);
  [[noreturn]] void refuseEscape(int position, const Verdict& verdict) const;
  template <int D>
  std::string sentence(int position, const Escape& escape) const;
  /// Hands out those who come into a cell of another patch.
  void receiveAll();
  void receive(const grid::Patch& patch, const Index3& cell, const Incoming& particle);
  void rebuild(const grid::Patch& patch, int material, int id);
  static void keepCell(PatchMoves& moves, const data::ParticleRange& before);
  static void mergeCell(int patch, PatchMoves& moves, const data::ParticleRange& before, int firstIncoming,
                        const ParticleId* ids, std::size_t& nextDeparted);
  static void gatherShortCopies(PatchMoves& moves);
  /// `place` is that of the variable among all that are carried.
  void carry(const Carried& variable, std::size_t place);
  void carry(const Carried& variable, std::size_t place, const grid::Patch& patch);

  data::Warehouse* warehouse_;
  Threads* threads_;
  Emigration emigration_;
  std::vector<PatchMoves> moves_;
  std::vector<data::Variable> spare_;
  long leaving_ = 0;  ///< in the step in progress
  long dropped_ = 0;
};

}  // namespace tushar::tasks
