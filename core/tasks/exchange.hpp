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

/// The values that a ghost fill copies, on the patches of this rank; found once for many copies.
class FilledValues {
 public:
  FilledValues(data::Warehouse& warehouse, const BoundGhostFill& fill)
      : label(*warehouse.table()[fill.variable].label),
        memory_(warehouse.memory(fill.generation, fill.variable)),
        slots_(warehouse.slots(fill.generation, fill.variable).get()),
        first_patch_(warehouse.grid().firstPatch()) {}

  CellValues on(int patch) const {
    const std::size_t place = patch - first_patch_;
    return {memory_ + slots_->first[place] * label.bytes, slots_->stored.empty() ? grid::Box{} : slots_->stored[place]};
  }

  const data::Label& label;

 private:
  std::byte* memory_;
  const data::Slots* slots_;
  int first_patch_;
};

/// Fills the ghosts of every patch from the patches that own them, on this rank or another.
///
/// Before a task that needs ghosts, each rank sends one message to each neighbouring rank, with all values that this
/// neighbour needs for the task. The messages are sent as soon as the last of these values has been computed; other
/// tasks run meanwhile. Just before the task, the patches of a rank fill their ghosts from one another. Patches that
/// need nothing from other ranks may then run while messages are still on their way.
///
/// An exchange has three parts: send(), begin() and finish(). All ranks call them for the same fills in the same order,
/// and complete one exchange before they begin the next. The first fill that needs ghost particles determines which
/// particles are ghosts.
class Exchange {
 public:
  Exchange(data::Warehouse& warehouse, Threads& threads)
      : warehouse_(&warehouse), threads_(&threads), outbox_(warehouse.ranks()), near_(warehouse, threads) {}

  /// Restricts later exchanges to ghosts of the patches of `level`; values in coarser cells are interpolated in time to
  /// the fraction `part` of the coarser step. -1: patches of all levels get ghosts, from old values.
  void setLevel(int level, double part) {
    level_ = level;
    part_ = part;
  }
  /// Sends this rank's messages. If a task has failed on this rank (`hasStopped`), they contain a notice of this
  /// instead of values.
  void send(std::span<const BoundGhostFill> fills, bool hasStopped);
  /// Determines from which ranks messages are awaited and, unless a task has failed, fills the ghosts that need no
  /// messages.
  void begin(bool hasStopped);
  /// Waits for the messages of other ranks, and fills the remaining ghosts. Returns false if another rank has stopped;
  /// then nothing more is filled, and this rank must stop too, before it reads missing values.
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
  /// Forgets which nodes are near particles. Must be called when a task list begins, and after tasks that change
  /// particles.
  void forgetParticles() { near_.forget(); }
  /// Forgets all plans. Must be called when the distribution of patches has changed.
  void forgetLayout() {
    plans_.forget();
    faces_.clear();
    near_.forget();
  }

 private:
  void post(bool hasStopped);
  /// Makes the copies between patches of this rank.
  void fillFromHere();
  void fillFromElsewhere(const BoundGhostFill& fill, bool resolves, ReceivedMessages& messages);
  void copyGrid(const BoundGhostFill& fill, const GhostCopy& copy, const FilledValues& values);
  void copyNear(const BoundGhostFill& fill, const GhostCopy& copy);
  CellValues targetOf(const FilledValues& values, const GhostCopy& copy) const;
  void copyGridTo(const BoundGhostFill& fill, const GhostCopy& copy, const FilledValues& values, const CellValues& to);
  void fillFromCoarser(const BoundGhostFill& fill, std::size_t place, ReceivedMessages* messages);
  void gatherCoarse(const BoundGhostFill& fill, std::size_t place, ReceivedMessages* messages, mpi::Bytes& coarse);
  /// Fills of all variables of a joint, by their indices.
  struct JointFill {
    const data::VariableTable::Joint* joint;
    std::vector<std::size_t> fills;
  };
  void findJoints();
  /// The joint to which a fill belongs; null if its variable is interpolated by itself.
  const JointFill* jointOf(const BoundGhostFill& fill) const {
    const int joint = joint_of_[&fill - fills_.data()];
    return joint < 0 ? nullptr : &joints_[joint];
  }
  bool isLocal(const JointFill& joint, std::size_t place) const;
  void fillTogether(const JointFill& joint, std::size_t place);
  void fillTogether(const JointFill& together, std::size_t place, const std::vector<mpi::Bytes*>& coarse);
  void fillTogetherFromElsewhere();
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
  /// Calls `work(patch, index of the patch)` on several threads in parallel.
  template <class Work>
  void forEach(const Work& work);
  void findPlans();
  /// The plan of one of the fills that are under way.
  const GhostPlan& planOf(const BoundGhostFill& fill) const { return *plans_of_fills_[&fill - fills_.data()]; }

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
  std::vector<const GhostPlan*> plans_of_fills_;
  bool has_stopped_ = false;
  std::vector<JointFill> joints_;
  std::vector<int> joint_of_;                        ///< for each fill: index of its joint, or -1
  std::vector<std::vector<mpi::Bytes>> of_coarser_;  ///< for each fill of a joint, and place: values of coarser cells
  std::set<int> senders_;                            ///< ranks whose messages are awaited
  std::vector<bool> resolves_;  ///< for each fill: whether it determines which particles are ghosts
};

}  // namespace tushar::tasks
