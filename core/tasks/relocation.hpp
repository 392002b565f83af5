#pragma once

#include <compare>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/data/warehouse.hpp"
#include "core/tasks/particle_migration.hpp"

namespace tushar::tasks {

/// Numbers of particles that a run has lost.
struct LostParticles {
  long left = 0;     ///< number that left through free faces of the grid, on this rank
  long removed = 0;  ///< number removed because they could not be advanced (`data::removed`), on all ranks

  LostParticles& operator+=(const LostParticles& other) {
    left += other.left;
    removed += other.removed;
    return *this;
  }
};

/// Assigns particles and their variables to the cells and patches of their new positions, in the order (cell, id).
///
/// Reuses its working memory in each step. Finding the moves, which may fail, is separate from making them: if no task
/// reads particles in between, the moves are made when the step is accepted, in the existing memory.
class Relocation {
 public:
  Relocation(data::Warehouse& warehouse, Threads& threads) : warehouse_(&warehouse), threads_(&threads) {}

  /// Finds the new cells of a material's particles from the new values of `position`. Particles that left through a
  /// periodic face enter at the opposite one; those that left through an open face will be dropped.
  ///
  /// All ranks call it together. Returns false if a rank has stopped before; then nothing is done on any rank.
  /// Particles at `data::vanished` are dropped, too, without being counted; those at `data::removed` are counted.
  /// Throws NumericalError, on all ranks, for a position that is not finite, lies behind a symmetry plane, or is inside
  /// coarser cells or too close to them.
  bool find(int material, int position, bool hasStopped);
  /// Builds the new particle set of a material from the old one and the moves found, and moves every carried variable
  /// to it, in generation `to`. Values that are already in that generation move within their memory. Collective.
  void apply(int material, const std::vector<Carried>& carried, data::Generation to);

  /// Discards all moves. Must be called when the distribution of patches has changed.
  void forgetLayout();

  /// Starts a step, or starts it again.
  void start() { losing_ = {}; }
  /// Adds the particles lost in the accepted step to the total.
  void commit() { lost_ += std::exchange(losing_, {}); }
  /// Number of particles lost since the start.
  const LostParticles& lost() const { return lost_; }
  /// Sets the numbers of lost particles when a run is continued; on all ranks.
  void setLost(const LostParticles& lost) { lost_ = lost; }
  /// Sets the advice to the user if a particle comes too close to coarser cells.
  void setAdviceNearCoarser(std::string advice) { advice_near_coarser_ = std::move(advice); }

 private:
  /// A particle that enters a cell, from this patch or another.
  struct Incoming {
    ParticleId id;
    int from;  ///< index among the departed particles of the patch, or -1 - its index among the arrivals
    int next;  ///< index of the incoming particle of the same cell with the next larger id, or -1
  };
  /// The origin of a particle from another patch.
  struct Arrival {
    /// Patch, and index among its departed particles; if the patch is -1, index among those from other ranks.
    int patch, place;
  };
  /// A particle that moves to a cell of another patch.
  struct Outgoing {
    ParticleId id;
    Index3 cell;
    int from, departed;  ///< previous index, and index among the departed particles
  };
  /// A particle at an invalid position; if there are several, the first by cell and by id.
  struct Escape {
    std::uint64_t cell;
    ParticleId id;
    int patch, place;

    friend auto operator<=>(const Escape&, const Escape&) = default;
  };
  /// The result that all ranks need before any of them continues.
  struct Verdict {
    bool hasStopped, hasEscape, goFar;
    int rank;  ///< rank of the particle at an invalid position
    Escape escape;
    long removed = 0;  ///< number of particles removed, on all ranks

    void merge(const Verdict& other);
  };
  /// Particles that stay in their cells and are consecutive before and after: `count` particles move from index `from`
  /// to index `to`.
  struct Run {
    int to, from, count;
  };
  /// An incoming particle, and its new index.
  struct Entry {
    int to, incoming;
  };
  struct PatchMoves {
    std::vector<double> nodes;       ///< positions of nodes along the first axis
    std::vector<int> departed;       ///< indices of the patch's particles that leave their cell, ascending
    int crossing = 0;                ///< number of those that leave their row of cells together
    std::vector<Outgoing> outgoing;  ///< those departed particles that move to other patches
    std::vector<Incoming> incoming;  ///< particles that enter a cell of the patch
    std::vector<Arrival> arrivals;
    data::RowTable<int> firstIncoming{-1};  ///< by cell: index of the first incoming particle, or -1; only rows that
                                            ///< particles enter are open
    std::vector<Run> runs;                  ///< ascending
    std::vector<Entry> entries;             ///< ascending
    std::size_t packed = 0;                 ///< index of the first departed particle among those of all patches
    bool toNewMemory = false;               ///< see Moves
    int count = 0;                          ///< number of particles in the new set
    int furthest = -1;                      ///< greatest previous index of these particles
    std::optional<Escape> escape;
    LostParticles losing;

    /// Whether the particles of the new set have the indices that they had before. No particle enters from another
    /// patch, and none leaves to one.
    bool keepsIndices() const {
      const bool isOneRun = runs.empty() || (runs.size() == 1 && runs.front().to == runs.front().from);
      return isOneRun && entries.empty() && outgoing.empty();
    }
    /// Whether all particles of the patch keep their cells and indices.
    bool staysAsItIs(data::Generation to) const {
      return to == data::Generation::old && departed.empty() && incoming.empty();
    }
  };
  /// The moves of the particles of a material.
  struct Moves {
    explicit Moves(data::Warehouse& warehouse) : migration(warehouse) {}

    std::vector<PatchMoves> patches;
    ParticleMigration migration;
    bool goFar = false;
    /// Whether values move to new memory, because that is faster: if many particles change their rows together, in long
    /// runs. (Single ones would make as many runs, which take more memory than they save time.)
    bool toNewMemory = false;
    int id = -1;             ///< index of the variable that contains the ids, once it is known
    std::size_t packed = 0;  ///< number of particles whose values are packed, on all patches
  };
  /// A variable being moved: its memory before and after on each patch, and the values of departed particles, which are
  /// packed only if they could be overwritten before they are moved.
  struct Move {
    std::size_t bytes;
    const std::byte* from;
    std::byte* to;
    const data::Slots *before, *after;
    const std::byte* migrants;
    std::byte* packed;

    const std::byte* ofPatch(std::size_t place) const { return from + before->first[place] * bytes; }
  };

  template <class Work>
  void forEachPatch(const Work& work) {
    const std::vector<grid::Patch>& patches = warehouse_->grid().patches();
    threads_->forEach(static_cast<int>(patches.size()), [&](int k) {
      const grid::Patch& patch = patches[k];
      const trace::Span span(trace::Kind::task, "relocate", patch.id());
      work(patch);
    });
  }
  Moves& movesOf(int material);
  /// The index of the variable with the ids of a material.
  int idOf(int material);
  PatchMoves& of(Moves& moves, int patch) { return moves.patches[patch - warehouse_->grid().firstPatch()]; }
  static void forgetIncoming(const grid::Patch& patch, PatchMoves& moves);
  template <int D>
  void findMoves(int material, int position, int id);
  template <int D>
  void findMoves(const grid::Patch& patch, const data::ParticleSet& set, Vec<D>* x, const ParticleId* ids,
                 PatchMoves& moves);
  /// The cells from which and to which a particle moves.
  template <int D>
  struct Step {
    Index<D> from, to;
  };
  /// Records the destination of the particle that departed last.
  template <int D>
  void move(const grid::Patch& from, const Step<D>& step, Vec<D>& x, ParticleId id, PatchMoves& moves);
  /// Consecutive particles, from the index `first` on, and the ids of the patch.
  struct Column {
    int first;
    const ParticleId* ids;
  };
  /// Records the moves of one particle from each of as many cells as there are lanes, from `cell` on, which all make
  /// the same `step`; returns false, and does nothing, unless all cells that they enter belong to the patch.
  template <int D>
  static bool enterTogether(const grid::Patch& patch, const Index<D>& cell, const Index<D>& step,
                            const Column& particles, PatchMoves& moves);
  /// Records the cell of the grid that the particle enters that departed last.
  static void enter(const grid::Patch& from, const Index3& cell, ParticleId id, PatchMoves& moves);
  /// Sorts the particles that left their patch into those at an invalid position, those outside the grid, and those
  /// that migrate to another rank.
  Verdict gather(Moves& moves, bool hasStopped);
  [[noreturn]] void refuseEscape(int position, const Verdict& verdict) const;
  /// The error for a particle at an invalid position.
  template <int D>
  NumericalError refusal(int position, const Escape& escape) const;
  /// Adds incoming particles to the patches that they enter.
  void receiveAll(Moves& moves);
  static void receive(const grid::Patch& patch, const Index3& cell, const Incoming& particle, PatchMoves& moves);
  /// Inserts a particle into the list of those that enter its cell, which are ordered by id; `first` is the index of
  /// the first of them.
  static void link(int* first, const Incoming& particle, PatchMoves& moves);
  bool isFasterInNewMemory(int material, const Moves& moves) const;
  void rebuild(const grid::Patch& patch, int material, PatchMoves& moves);
  static void keepAll(PatchMoves& moves, int count);
  static void keep(PatchMoves& moves, int first, int count);
  /// Appends the cells from `from` up to the first cell that particles leave or enter, but not beyond `end`; records
  /// the indices in `to`, and returns the number of cells.
  static int keepCells(PatchMoves& moves, std::span<const data::ParticleRange> from, const int* firstIncoming,
                       std::size_t nextDeparted, data::ParticleRange* to);
  static void letIn(PatchMoves& moves, int incoming);
  static void mergeCell(PatchMoves& moves, const data::ParticleRange& before, int firstIncoming, const ParticleId* ids,
                        std::size_t& nextDeparted);
  void carry(const Carried& carried, std::size_t place, data::Generation to, int material, Moves& moves);
  /// Stores the values of departing particles.
  static void pack(const Move& move, std::size_t place, const PatchMoves& moves);
  /// Moves the particles that stay to their new indices, and inserts those that arrive.
  void moveOn(const Move& move, std::size_t place, Moves& moves);

  /// Whether a cell of the finest level is too close to coarser cells for a particle that enters it from a given patch.
  bool isNearCoarser(const grid::Patch& from, const Index3& cell) const {
    return warehouse_->grid().levels() > 1 && isInOrNearCoarser(from, cell);
  }
  bool isInOrNearCoarser(const grid::Patch& from, const Index3& cell) const;

  data::Warehouse* warehouse_;
  int margin_ = 0;  ///< number of cells of the finest level that are required around particles
  Threads* threads_;
  std::deque<Moves> moves_;  ///< moves of the particles of each material
  LostParticles losing_;     ///< particles lost in the current step
  LostParticles lost_;
  std::string advice_near_coarser_;
};

}  // namespace tushar::tasks
