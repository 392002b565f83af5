#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/tasks/broken_value.hpp"
#include "core/tasks/connect.hpp"
#include "core/tasks/context.hpp"
#include "core/tasks/exchange.hpp"
#include "core/tasks/particle_migration.hpp"
#include "core/tasks/place.hpp"
#include "core/tasks/plan.hpp"
#include "core/tasks/prune.hpp"

namespace tushar::tasks {

/// A variable that a task writes, to be allocated before it runs.
struct Output {
  int variable;
  data::Generation set;
  bool cleared = false;  ///< 0 where the task writes nothing: a saved variable with values near particles only
};

/// The part of a kept task that depends on the material.
struct MaterialBinding {
  std::vector<BoundAccess> accesses;
  std::vector<Output> outputs;
  std::vector<Carried> carried;  ///< particle variables moved by a relocation
  std::vector<Bounded> bounded;  ///< variables with bounds that the task writes
  std::vector<int> freed;        ///< variables whose memory is freed after the task
  std::vector<Output> shared;  ///< variables of which patches write only their own nodes, and then exchange the others
};

/// A kept task, with all look-ups resolved in advance for the time loop.
struct CompiledTask {
  Task task;
  /// One binding per material; a single one for a task that does not run over materials.
  std::vector<MaterialBinding> materials;
  std::vector<BoundGhostFill> fills;            ///< ghost exchanges before it runs
  int sends = -1;                               ///< task whose ghosts are sent before this one runs; -1: none
  std::vector<int> reductions, readReductions;  ///< reductions that it computes, and reductions that it reads
  bool mayStartEarly = false;  ///< whether patches whose ghosts are complete may run while others still wait
  bool isLast = false;         ///< whether it is the last task of its graph
  /// Index of the reduction recomputeTimeStep, if the task may request a repetition of the step.
  int recomputeTimeStep = -1;
  double seconds = 0;          ///< time spent in it so far [s]
  double exchangeSeconds = 0;  ///< part of it spent on filling ghosts before the task [s]

  /// The binding of a material (-1 for a task that does not run over materials).
  const MaterialBinding& of(int material) const {
    return materials[task.perMaterial() ? static_cast<std::size_t>(material) : 0];
  }
};

/// A compiled task list.
///
/// prune → connect → place → plan → lifetimes, each a function of its own; here their results are bound to the
/// variables of a run. Compile every list of a run before the warehouse first allocates memory, because all lists
/// together determine the ghost widths.
class TaskGraph {
 public:
  TaskGraph() = default;
  /// Throws TaskError if a list makes particles without all variables that later tasks need.
  TaskGraph(std::string name, Pruned pruned, const grid::Grid& grid, data::VariableTable& table);

  const std::string& name() const { return name_; }
  std::vector<CompiledTask>& tasks() { return tasks_; }
  const std::vector<CompiledTask>& tasks() const { return tasks_; }
  const std::vector<LeftOut>& leftOut() const { return pruned_.leftOut; }
  const std::vector<Dependency>& dependencies() const { return dependencies_; }
  const std::vector<Placement>& placements() const { return placements_; }
  /// Variables that are new at the end of the graph and become old at the end of the step.
  const std::vector<int>& results() const { return results_; }
  /// Reductions that the graph's tasks compute.
  const std::vector<int>& reductions() const { return reductions_; }
  /// Materials that have a new particle set at the end.
  const std::vector<int>& changedSets() const { return changed_sets_; }
  /// Largest number of materials in any task.
  int materials() const { return materials_; }

  /// Prints the tasks in order, with the variables that each reads and writes.
  void print(std::ostream& out) const;
  /// Prints the tasks that were left out, and why.
  void printLeftOut(std::ostream& out) const;
  /// Prints the tasks and dependencies in Graphviz's language.
  void printDot(std::ostream& out) const;

 private:
  void bind(std::size_t t, data::VariableTable& table);
  bool isCleared(const data::Label& label) const;
  MaterialBinding bindMaterial(std::size_t t, int material, data::VariableTable& table);
  std::vector<Carried> carriedBy(std::size_t t, int material, data::VariableTable& table) const;
  void checkCreated(std::size_t t, const data::VariableTable& table) const;
  void noteResults(data::VariableTable& table);

  std::string name_;
  Pruned pruned_;
  std::vector<Dependency> dependencies_;
  std::vector<Placement> placements_;
  std::vector<data::Generation> sets_;
  std::vector<std::vector<std::string>> lifetimes_;
  std::vector<CompiledTask> tasks_;
  std::vector<int> results_, changed_sets_, reductions_;
  int materials_ = 0;
};

}  // namespace tushar::tasks
