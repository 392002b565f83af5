#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/simulation/analysis.hpp"
#include "core/simulation/component.hpp"
#include "core/simulation/conserved.hpp"
#include "core/simulation/settings.hpp"
#include "core/tasks/scheduler.hpp"

namespace tushar::simulation {

/// The compiled task lists of a run. The variables that a list reads must be provided by an earlier list.
///
/// The diagnostics are compiled four times from one list, each time for another purpose: the totals at the start, the
/// globals saved in every step, the derived fields of an output, the totals and errors of the report.
class Phases {
 public:
  /// Collects the task lists. Throws TaskError if a task reads a variable that no task writes.
  Phases(const Component& component, const std::vector<std::unique_ptr<Analysis>>& analyses);

  /// Problems with the labels and materials that a scene saves.
  std::vector<InputProblem> problemsOf(const std::vector<SaveRequest>& saves,
                                       const std::string& path = "DataArchiver/save") const;
  /// Problems with the labels and materials that analysis modules sample.
  std::vector<InputProblem> problemsOf(const std::vector<std::unique_ptr<Analysis>>& analyses) const;
  /// Whether tasks compute a variable for each material.
  bool isOfMaterials(const std::string& label) const;
  /// Whether a variable is one value for the whole grid.
  bool isTotal(const std::string& label) const;
  /// Notes on indices of materials in `save` that do not exist.
  std::vector<std::string> remarksOn(const SaveRequest& save) const;
  /// Compiles the lists. Throws InputError if no task computes a saved or sampled label, or if a task cannot run on the
  /// levels of the grid; throws TaskError for lists that do not fit together. `smallerSteps` is the tag that requests
  /// smaller steps on finer levels, if any.
  void compile(const std::vector<std::unique_ptr<Analysis>>& analyses, const std::vector<SaveRequest>& saves,
               const grid::Grid& grid, data::VariableTable& table, const RegridSettings& regrid = {},
               const std::optional<Location>& smallerSteps = {});

  tasks::TaskGraph initialize, stableTimeStep, timeAdvance, startTotals, everyStep, everyOutput, report;
  tasks::TaskGraph carefulAdvance;  ///< steps after a particle has been removed (CarefulSteps); empty: timeAdvance
  tasks::TaskGraph nextMaterials;   ///< finds the particles that move to other materials; empty: none ever does
  tasks::TaskGraph afterStep;       ///< what analysis modules add up over steps
  tasks::TaskGraph refinement;      ///< marks cells where criteria require finer ones
  tasks::TaskGraph refined;         ///< corrects the values of newly refined cells
  tasks::TaskGraph refluxing;       ///< refluxing on a level, after the smaller steps of the next finer level

  /// Sorted names of the variables of the previous step that a step and the totals need: the state of a run,
  /// independent of what else is saved and measured.
  const std::vector<std::string>& state() const { return state_; }
  /// Names of the variables in the fingerprint: the state or, if no step needs variables of the previous step, the
  /// saved and measured variables.
  const std::vector<std::string>& fingerprinted() const { return state_.empty() ? lasting_ : state_; }
  /// Names of saved and measured variables that outlive a step, but are not in the fingerprint: no later step and no
  /// total needs them.
  std::vector<std::string> savedBesides() const;
  /// Sorted names of the variables that a restart must find: the state, and what else steps continue from their
  /// previous value because it is saved or measured.
  const std::vector<std::string>& neededAtRestart() const { return needed_at_restart_; }
  /// Sorted names of the variables that outlive a step: the state, and other saved variables.
  const std::vector<std::string>& lasting() const { return lasting_; }
  /// Saved variables of particles, nodes and cells.
  const std::vector<SaveRequest>& savedFields() const { return saved_fields_; }
  /// Names of the saved reductions.
  const std::vector<std::string>& savedGlobals() const { return saved_globals_; }
  const std::vector<std::string>& materials() const { return materials_; }
  /// Totals whose drift the report can show.
  const std::vector<ConservedTotal>& totals() const { return totals_; }
  /// What the steps of carefulAdvance do differently.
  const std::string& aboutCarefulSteps() const { return about_careful_steps_; }
  /// Numbers of the whole run that the report shows.
  const std::vector<Reported>& reported() const { return reported_; }

  void printSchedule(std::ostream& out) const;
  void printDot(std::ostream& out) const;
  /// Names of the variables that can be saved.
  tasks::Names saveable() const;

 private:
  void printLevels(std::ostream& out) const;
  struct Lists {
    tasks::TaskList initialize, stableTimeStep, timeAdvance, carefulAdvance, nextMaterials, diagnostics, afterStep,
        errorEstimate, refine, reflux, afterRefluxing;
  };
  /// Collects the tasks of the analysis modules, and what they add up over steps.
  void addAnalyses(const std::vector<std::unique_ptr<Analysis>>& analyses);
  /// Sorts what is saved. Throws InputError if no task computes a saved or sampled label, or if it cannot be saved on
  /// several levels.
  void takeSaves(const std::vector<SaveRequest>& saves, const std::vector<std::unique_ptr<Analysis>>& analyses,
                 int levels);
  /// Names of the variables that exist after the start and after each step.
  tasks::Names namesOfSteps() const;
  /// The tasks for those sums over steps that are read `always` or `atEnd`; adds what they need to `atEnd`.
  tasks::Pruned addSums(const tasks::Names& always, tasks::Names& atEnd) const;
  /// Stores the number of levels and how they step, and adds the tasks and joints that several levels need.
  void prepareLevels(int levels, bool refluxes, bool bySmallerSteps, data::VariableTable& table);
  /// Adds the tasks that keep totals constant across levels (refluxing).
  void addRefluxing(bool bySmallerSteps);
  void validateAll() const;
  void noteMaterials();
  bool isMaterial(const std::string& name) const;
  /// Replaces indices of materials in requests by their names. As in Uintah, the index after the last one means all
  /// materials, and higher indices mean none.
  std::vector<SaveRequest> named(const std::vector<SaveRequest>& saves) const;
  /// The diagnostics, followed by the task that marks cells to refine; empty if the grid does not change. Throws
  /// InputError for a criterion whose variable is not a cell variable.
  tasks::TaskList refinementTasks(const RegridSettings& regrid) const;
  /// For grids of several levels: throws InputError for node variables that are saved, or sampled in parts of the grid.
  void refuseSavedNodes(const std::vector<std::unique_ptr<Analysis>>& analyses) const;
  /// The saved and sampled variables: diagnostics needed in every step, diagnostics needed at outputs, and the state.
  struct Wants {
    tasks::Names everyStep, everyOutput, ofState;
  };
  Wants wantsOf(const std::vector<SaveRequest>& samples, const tasks::Names& stepped) const;
  void sortSaves(const std::vector<SaveRequest>& saves);

  Lists lists_;
  std::vector<std::shared_ptr<const data::JointInterpolation>> joints_;
  std::string about_careful_steps_;
  std::vector<std::string> state_, lasting_, needed_at_restart_, saved_globals_, materials_;
  tasks::Names summed_;  ///< the variables that analysis modules add up over steps
  std::vector<SaveRequest> saved_fields_;
  std::vector<ConservedTotal> totals_;
  std::vector<Reported> reported_;
  int levels_ = 1;
  bool smaller_steps_ = false;  ///< whether finer levels take smaller steps
};

}  // namespace tushar::simulation
