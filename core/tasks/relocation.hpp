#pragma once

#include <compare>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/data/warehouse.hpp"
#include "core/tasks/emigration.hpp"

namespace tushar::tasks {

/// Brings particles to the cell and patch where they are now, in the order (cell, id), and their variables with them.
///
/// Keeps its working memory from step to step.
class Relocation {
 public:
  explicit Relocation(data::Warehouse& warehouse) : warehouse_(&warehouse), emigration_(warehouse) {}

  /// Builds the new particle set of a material from the old one and the new values of `position`; afterwards every
  /// carried variable is new and follows the new set. Particles that left through a periodic face come in at the opposite
  /// one; those that left through a free face are dropped.
  ///
  /// All ranks run it together. False if one of them says that it has stopped before: then nothing is done on any.
  /// Throws NumericalError, on all ranks, for a position that is not finite or lies behind a symmetry plane.
  bool run(int material, int position, const std::vector<Carried>& carried, bool hasStopped);

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
    Escape escape;
    int rank;  ///< of the escape
  };
  /// Consecutive places of the new set: a copy of consecutive places before from `from` on, or (-1) gathered by
  /// `source`.
  struct Piece {
    int to, count, from;
  };
  struct PatchMoves {
    std::vector<int> departed;       ///< places of the patch's particles that leave their cell, ascending
    std::vector<Incoming> incoming;  ///< particles that come into a cell of the patch
    std::vector<int> firstIncoming;  ///< by cell, or -1
    std::vector<Piece> pieces;
    /// For each gathered particle of the new set its place before (0 if it comes from another patch).
    std::vector<int> source;
    int count = 0;                             ///< of the new set
    std::vector<std::pair<int, int>> foreign;  ///< new place and index in `incoming` of those from other patches
  };

  PatchMoves& movesOf(int patch) {
    return moves_[static_cast<std::size_t>(patch - warehouse_->level().firstPatch())];
  }
  Verdict agreed(bool hasStopped) const;
  template <int D>
  void findMoves(int material, int position);
  template <int D>
  void move(const grid::Patch& from, const Index<D>& cell, Vec<D>& x, ParticleId id, int place);
  [[noreturn]] void refuseEscape(int position, const Verdict& verdict) const;
  template <int D>
  std::string sentence(int position, const Escape& escape) const;
  void receive(const grid::Patch& patch, const Index3& cell, const Incoming& particle);
  void rebuild(const grid::Patch& patch, int material);
  static void keepCell(PatchMoves& moves, const data::ParticleRange& before);
  static void mergeCell(int patch, PatchMoves& moves, const data::ParticleRange& before, int firstIncoming,
                        const ParticleId* ids, std::size_t& nextDeparted);
  static void gatherShortCopies(PatchMoves& moves);
  void carry(const Carried& variable, std::size_t place);

  data::Warehouse* warehouse_;
  Emigration emigration_;
  std::vector<PatchMoves> moves_;
  std::vector<data::Variable> spare_;
  std::optional<Escape> escape_;
  long leaving_ = 0;  ///< in the step in progress
  long dropped_ = 0;
};

}  // namespace tushar::tasks
