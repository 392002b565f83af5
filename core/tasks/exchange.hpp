#pragma once

#include <set>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/base/threads.hpp"
#include "core/data/warehouse.hpp"
#include "core/tasks/ghost_messages.hpp"
#include "core/tasks/ghost_plan.hpp"
#include "core/tasks/near_rows.hpp"

namespace tushar::tasks {

GhostReach reachOf(const data::VariableTable& table, const BoundGhostFill& fill);

/// Fills the ghosts of every patch from the patches that own them, on this rank or another.
///
/// For a task one message goes to each neighbouring rank, with all that it needs for that task, as soon as the last of
/// that has been computed; other tasks run meanwhile. Before the task patches fill their ghosts from one another, and
/// those that need nothing of other ranks may be worked on while messages are still on their way.
class Exchange {
 public:
  Exchange(data::Warehouse& warehouse, Threads& threads)
      : warehouse_(&warehouse), threads_(&threads), outbox_(warehouse.ranks()), near_(warehouse, threads) {}

  /// Fills the ghosts of variables in three parts; the set of ghost particles is determined on its first use. All ranks
  /// run them for the same fills in the same order, all three of one before the next.
  ///
  /// From now on only patches of a level get ghosts, from coarser cells as they are at a part of their step; -1: those
  /// of all levels, from old values.
  void setLevel(int level, double part) {
    level_ = level;
    part_ = part;
  }
  /// Posts messages. A rank on which a task has failed sends a notice of this instead of its values (`hasStopped`).
  void send(std::span<const BoundGhostFill> fills, bool hasStopped);
  /// Sends messages, and fills the ghosts that need no messages from other ranks, unless a task has failed.
  void begin(bool hasStopped);
  /// Waits for the messages of other ranks, and fills the remaining ghosts. False if another rank has stopped; then
  /// nothing more is filled, and this rank must stop too, before it reads values that are missing.
  bool finish();
  /// Whether no patch has ghosts at all, so that there is nothing to exchange.
  bool movesNothing() const;
  /// Between begin and finish: whether messages are still awaited.
  bool isUnderWay() const { return !senders_.empty(); }
  /// Between begin and finish: whether the patch with this index on the rank has received all its ghosts.
  bool isReady(std::size_t place);
  /// Copies the new values of a node variable between patches of this rank, from owners to patches that share the node;
  /// `set` contains the particles near which the values are defined, if this matters.
  void shareFaces(int variable, data::Generation set);
  /// Must be called when a task list begins, and after tasks that change particles.
  void forgetParticles() { near_.forget(); }
  /// Must be called when the distribution of patches has changed.
  void forgetLayout() {
    plans_.forget();
    faces_.clear();
    near_.forget();
  }

 private:
  void post(bool hasStopped);
  /// The copies between patches of this rank.
  void fillFromHere();
  void fillFromElsewhere(const BoundGhostFill& fill, bool resolves, ReceivedMessages& messages);
  void copyGrid(const BoundGhostFill& fill, const GhostCopy& copy);
  void copyNear(const BoundGhostFill& fill, const GhostCopy& copy);
  CellValues valuesAt(const BoundGhostFill& fill, const GhostCopy& copy);
  void copyGridTo(const BoundGhostFill& fill, const GhostCopy& copy, const CellValues& to);
  void fillFromCoarser(const BoundGhostFill& fill, std::size_t place, ReceivedMessages* messages);
  /// Whether patches exchange only rows of nodes near particles.
  bool isNear(const BoundGhostFill& fill) const {
    return fill.generation == data::Generation::fresh && near_.concern(fill.variable);
  }
  void settleNear();
  const data::TouchedRows& nearRows(const BoundGhostFill& fill, int patch) const {
    return near_.of(fill.set, warehouse_->table()[fill.variable].material, patch);
  }
  void linkLocalGhosts(const BoundGhostFill& fill);
  void placeGhostCopies(const BoundGhostFill& fill, ReceivedMessages* messages);
  void reserveCopies(const BoundGhostFill& fill);
  void fillCopies(const BoundGhostFill& fill, const grid::Patch& patch, ReceivedMessages* messages);
  bool isHere(const GhostCopy& copy) const { return copy.rank == warehouse_->ranks().rank(); }
  void noteUnresolved();
  /// Calls `work(fill, patch, index of the patch)` on several threads at once.
  template <class Work>
  void forEach(const Work& work);
  const GhostPlan& planOf(const BoundGhostFill& fill) {
    GhostReach reach = reachOf(warehouse_->table(), fill);
    reach.level = level_;
    return plans_.of(warehouse_->grid(), reach);
  }

  data::Warehouse* warehouse_;
  Threads* threads_;
  mpi::Outbox outbox_;
  NearRows near_;
  GhostPlans plans_;
  std::vector<std::vector<GhostCopy>> faces_;  ///< copies for each patch of this rank; planned on first use
  int level_ = -1;
  double part_ = 0;
  // The exchange that was sent:
  std::span<const BoundGhostFill> fills_;
  bool has_stopped_ = false;
  std::set<int> senders_;       ///< ranks whose messages are awaited
  std::vector<bool> resolves_;  ///< for each fill: whether it determines which particles are ghosts
};

}  // namespace tushar::tasks
