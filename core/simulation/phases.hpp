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

/// The task lists of a run, compiled against each other: an earlier one must provide what a later one reads.
///
/// The diagnostics are compiled four times from one list, each time for another purpose: the totals at the start, the
/// globals saved in every step, the derived fields of an output, the totals and errors of the report.
class Phases {
 public:
  /// Collects the task lists. Throws TaskError for one that reads what no task writes.
  Phases(const Component& component, const std::vector<std::unique_ptr<Analysis>>& analyses);

  /// The problems of the labels and materials that a scene saves.
  std::vector<InputProblem> problemsOf(const std::vector<SaveRequest>& saves,
                                       const std::string& path = "DataArchiver/save") const;
  /// The problems of the labels and materials that analysis modules sample.
  std::vector<InputProblem> problemsOf(const std::vector<std::unique_ptr<Analysis>>& analyses) const;
  /// Whether tasks compute a variable for each material.
  bool isOfMaterials(const std::string& label) const;
  /// Notes on saved material numbers that are not those of a material.
  std::vector<std::string> remarksOn(const SaveRequest& save) const;
  /// Compiles the lists. Throws InputError for a saved or sampled label that no task computes, and for a task that
  /// cannot run on the levels of the grid; TaskError for lists that do not fit together. `smallerSteps`: the tag that
  /// has finer levels take smaller steps, if they do.
  void compile(const std::vector<std::unique_ptr<Analysis>>& analyses, const std::vector<SaveRequest>& saves,
               const grid::Grid& grid, data::VariableTable& table, const RegridSettings& regrid = {},
               const std::optional<Location>& smallerSteps = {});

  tasks::TaskGraph initialize, stableTimeStep, timeAdvance, startTotals, everyStep, everyOutput, report;
  tasks::TaskGraph refinement;  ///< where criteria require finer cells
  tasks::TaskGraph refined;     ///< what a component computes in cells that have become finer
  tasks::TaskGraph refluxing;   ///< on a level after the smaller steps of the next finer one, where it takes some

  /// Names of the variables that a step and the totals need of the step before, sorted: the state of a run, whatever
  /// is saved and measured besides.
  const std::vector<std::string>& state() const { return state_; }
  /// Names of the variables that the fingerprint covers: the state or, where no step needs anything of the one before,
  /// what is saved and measured.
  const std::vector<std::string>& fingerprinted() const { return state_.empty() ? lasting_ : state_; }
  /// Names of the variables that outlive a step, sorted: the state, and what is saved besides.
  const std::vector<std::string>& lasting() const { return lasting_; }
  /// Saved variables of particles, nodes and cells.
  const std::vector<SaveRequest>& savedFields() const { return saved_fields_; }
  /// Saved reductions.
  const std::vector<std::string>& savedGlobals() const { return saved_globals_; }
  const std::vector<std::string>& materials() const { return materials_; }
  /// Totals whose drift the component can report.
  const std::vector<ConservedTotal>& totals() const { return totals_; }

  void printSchedule(std::ostream& out) const;
  void printDot(std::ostream& out) const;
  /// Names of what can be saved.
  tasks::Names saveable() const;

 private:
  struct Lists {
    tasks::TaskList initialize, stableTimeStep, timeAdvance, diagnostics, errorEstimate, refine, reflux;
  };
  /// Adds the tasks that keep totals constant between levels.
  void addRefluxing(bool bySmallerSteps);
  void validateAll() const;
  void noteMaterials();
  bool isMaterial(const std::string& name) const;
  /// The requests with the names of materials in place of their numbers; the number after the last means all, as in
  /// Uintah, and higher ones mean none.
  std::vector<SaveRequest> named(const std::vector<SaveRequest>& saves) const;
  /// The diagnostics, followed by the task that marks cells to refine; nothing if the grid does not change. Throws
  /// InputError for a criterion whose variable is not one of cells.
  tasks::TaskList refinementTasks(const RegridSettings& regrid) const;
  /// Throws InputError for node variables that are saved, or sampled in parts of the grid.
  void refuseSavedNodes(const std::vector<std::unique_ptr<Analysis>>& analyses) const;
  /// The saved and sampled variables: of diagnostics in every step and at outputs, and of the state.
  struct Wants {
    tasks::Names everyStep, everyOutput, ofState;
  };
  Wants wantsOf(const std::vector<SaveRequest>& samples, const tasks::Names& stepped) const;
  void sortSaves(const std::vector<SaveRequest>& saves);

  Lists lists_;
  std::vector<std::string> state_, lasting_, saved_globals_, materials_;
  std::vector<SaveRequest> saved_fields_;
  std::vector<ConservedTotal> totals_;
};

}  // namespace tushar::simulation
