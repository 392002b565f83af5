#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/data/warehouse.hpp"
#include "core/tasks/ghost_plan.hpp"

namespace tushar::tasks {

/// A fill of ghosts, by number of variable.
struct NumberedFill {
  int variable;
  data::Generation generation, set;
  bool particles;
};

/// Fills the ghosts of every patch from the patches that own them, on this rank or another.
///
/// Before a task one message goes to each neighbouring rank, with all that it needs for that task; while messages are
/// on their way, patches fill their ghosts from one another.
class Exchange {
 public:
  explicit Exchange(data::Warehouse& warehouse) : warehouse_(&warehouse), outbox_(warehouse.ranks()) {}

  /// Fills the ghosts of node and cell variables, and of particle variables; which particles are ghosts is settled on
  /// first use of their set. All ranks run it for the same fills in the same order.
  ///
  /// A rank on which a task failed says so in place of its values (`hasStopped`). False if a rank that this one hears of
  /// has stopped: then nothing is filled, and this one is to stop, too, before it reads what is not there.
  bool run(std::span<const NumberedFill> fills, bool hasStopped);

 private:
  class Letters;

  void post(std::span<const NumberedFill> fills, bool hasStopped);
  void fillFromHere(const NumberedFill& fill);
  void fillFromElsewhere(const NumberedFill& fill, Letters& letters);
  void settleGhosts(const NumberedFill& fill, const grid::Patch& patch, Letters& letters);
  void fillParticles(const NumberedFill& fill, Letters& letters);
  void noteUnsettled(std::span<const NumberedFill> fills);
  const GhostPlan& planOf(const NumberedFill& fill);

  data::Warehouse* warehouse_;
  mpi::Outbox outbox_;
  std::map<std::pair<bool, int>, GhostPlan> plans_;  ///< by whether of nodes, and width
  std::vector<bool> settles_;                        ///< by fill: whether it settles which particles are ghosts
};

}  // namespace tushar::tasks
