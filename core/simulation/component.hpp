#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/data/joint_interpolation.hpp"
#include "core/simulation/reported.hpp"
#include "core/simulation/settings.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::simulation {

/// A simulation method for some physics: it declares tasks, and the framework runs them.
///
/// A component does not change after construction: all that changes is in the warehouse. Therefore restarts and threads
/// need no special care. A component is constructed from a checked scene, and keeps a copy of everything that it needs
/// later.
class Component {
 public:
  virtual ~Component() = default;

  /// Adds the tasks that create the state at the start of a run: `computes` and `newParticles`.
  virtual void scheduleInitialize(tasks::TaskList& tasks) const = 0;
  /// Adds tasks that limit `delT` for the next step, from the old state. A method that is stable with any step adds no
  /// task: then `Time` alone limits the steps.
  virtual void scheduleComputeStableTimeStep(tasks::TaskList&) const {}
  /// Adds the tasks of one step, from the old state to a new one.
  virtual void scheduleTimeAdvance(tasks::TaskList& tasks) const = 0;
  /// Advice for the user when a value violates its bound; continues a sentence after the word `try`.
  virtual std::string advice() const { return "a smaller time step (timestep_multiplier in <Time>)"; }
  /// Whether a step with an invalid value is repeated with half the time step even if the scene does not request this.
  virtual bool mayRepeatStep() const { return false; }
  /// Names of variables that Uintah's component of this kind computes, even if this component does not.
  virtual std::vector<std::string> foreignLabels() const { return {}; }
  /// Pairs of names, Uintah's and Tushar's, for variables that have another name in Uintah.
  virtual OtherNames otherNames() const { return {}; }
  /// Notes on parts of the scene that have no effect on the grid in use.
  virtual std::vector<InputProblem> notes() const { return {}; }
  /// The names of the gases, if their variables do not belong to materials. In the scene they are the last materials,
  /// in this order.
  virtual std::vector<std::string> gasNames() const { return {}; }
  /// The reason why this component cannot run on several levels in this scene, although its kind can; empty if it can.
  /// Messages put `needs a grid of one level:` in front of it.
  virtual std::string whyOneLevel() const { return ""; }
  /// The reason why this component cannot run on a level of several boxes in this scene; empty if it can. Messages put
  /// `needs a grid of one box:` in front of it.
  virtual std::string whyOneBox() const { return "it takes the cells between the boxes for cells of the grid"; }
  /// Criteria for refinement, used if the scene refines the grid without giving criteria.
  virtual std::vector<Criterion> criteria() const { return {}; }
  /// Adds tasks that mark cells to be refined, from the old state and diagnostics: `perPatch` tasks with `marks()`.
  /// They run in addition to the criteria of the scene, before each regridding of an adaptive grid.
  virtual void scheduleErrorEstimate(tasks::TaskList&) const {}
  /// Adds tasks that correct the interpolated values of newly refined cells: they modify cell variables on all patches;
  /// `newCells()` are the cells of the patch that were coarser before. At the start of a run, cells of all levels are
  /// initialised instead.
  virtual void scheduleRefine(tasks::TaskList&) const {}
  /// Adds tasks that check or correct what refluxing has made of coarser cells: they modify cell variables of a step,
  /// in the cells `besideFiner()`. Each runs after the refluxing of all variables that it accesses.
  virtual void scheduleAfterRefluxing(tasks::TaskList&) const {}
  /// Cell variables that are interpolated together where cells become finer, and for ghosts in coarser cells. A
  /// variable must not be in two of them.
  virtual std::vector<std::shared_ptr<const data::JointInterpolation>> jointInterpolations() const { return {}; }
  /// Adds tasks that compute diagnostics of the old state: totals, derived fields. Tasks whose results are not needed
  /// are omitted.
  virtual void scheduleDiagnostics(tasks::TaskList&) const {}
  /// Numbers of the whole run that the report shows, in this order. Their tasks are kept in every run, unless they are
  /// `onlyIfSaved`.
  virtual std::vector<Reported> reported() const { return {}; }
};

}  // namespace tushar::simulation
