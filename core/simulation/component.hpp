#pragma once

#include <string>
#include <vector>

#include "core/simulation/settings.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::simulation {

/// A physics code: it declares tasks, which the framework runs.
///
/// A component does not change after construction: all that changes lives in the warehouse, so restart and threads are
/// right by construction. Construct it from a checked scene; it keeps a copy of everything that it needs later.
class Component {
 public:
  virtual ~Component() = default;

  /// The state at the start of a run: `computes` and `newParticles` tasks.
  virtual void scheduleInitialize(tasks::TaskList& tasks) const = 0;
  /// Limits `delT` for the next step, from the old state. A method that is stable with any step adds no task: then
  /// `Time` alone limits the steps.
  virtual void scheduleComputeStableTimeStep(tasks::TaskList&) const {}
  /// One step, from the old state to a new one.
  virtual void scheduleTimeAdvance(tasks::TaskList& tasks) const = 0;
  /// Advice for a user if a value violates its bound; continues `try `.
  virtual std::string advice() const { return "a smaller time step (timestep_multiplier in <Time>)"; }
  /// Whether a step with an invalid value is repeated with half the time step even if the scene does not request it.
  virtual bool mayRepeatStep() const { return false; }
  /// Variables that Uintah's component of this kind computes, even if this one does not.
  virtual std::vector<std::string> foreignLabels() const { return {}; }
  /// Variables with another name in Uintah's component of this kind.
  virtual OtherNames otherNames() const { return {}; }
  /// Notes on parts of the scene that have no effect on its grid.
  virtual std::vector<InputProblem> notes() const { return {}; }
  /// The names of the gases, if their variables belong to no material. In the scene they are the last materials, in
  /// this order.
  virtual std::vector<std::string> gasNames() const { return {}; }
  /// Why it cannot run on several levels, although its kind can; empty if it can. Continues `needs a grid of one level:
  /// `.
  virtual std::string whyOneLevel() const { return ""; }
  /// Criteria for finer cells, for scenes that refine the grid without criteria.
  virtual std::vector<Criterion> criteria() const { return {}; }
  /// Tasks that mark cells where finer cells are needed, from the old state and diagnostics: `perPatch` tasks with
  /// `marks()`. They run beside the criteria of the scene before each regridding of an adaptive grid.
  virtual void scheduleErrorEstimate(tasks::TaskList&) const {}
  /// Tasks that change the interpolated values of cells that regridding has refined: they modify cell variables on all
  /// patches; `newCells()` are the cells of the patch that were coarser before. At the start of a run cells of all
  /// levels are initialised instead.
  virtual void scheduleRefine(tasks::TaskList&) const {}
  /// Diagnostics of the old state: totals, derived fields. Only those that are needed run.
  virtual void scheduleDiagnostics(tasks::TaskList&) const {}
};

}  // namespace tushar::simulation
