#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/base/progress.hpp"
#include "core/data/warehouse.hpp"
#include "core/output/writers.hpp"
#include "core/simulation/phases.hpp"
#include "core/simulation/problem.hpp"
#include "core/simulation/run_clock.hpp"
#include "core/tasks/patch_migration.hpp"
#include "core/tasks/scheduler.hpp"

namespace tushar::simulation {

/// The totals of mass, momentum and energy over the whole grid, in the order of Phases::totals(), each with its
/// components.
using Totals = std::vector<std::vector<double>>;

/// The state that the parts of a run share: the problem, its compiled tasks and variables, and its progress.
struct RunState {
  /// Compiles the task graphs. Throws the exceptions of Phases.
  RunState(Problem problem, const RunOptions& options, Clock::time_point startedAt, const mpi::Communicator& ranks);
  RunState(const RunState&) = delete;
  RunState& operator=(const RunState&) = delete;

  /// Number of materials.
  int materials() const { return static_cast<int>(phases.materials().size()); }
  /// Passes the current time to the analysis modules.
  void setTimeOfAnalyses();
  /// Runs diagnostics on the current state.
  void diagnose(tasks::TaskGraph& graph);
  /// The values of a reduction; empty if it has no value yet, or if no task computes it.
  std::vector<double> reduction(std::string_view label) const;
  /// The totals of the current state, computed by the given graph.
  Totals measureTotals(tasks::TaskGraph& graph);

  /// Takes account of the last step in the numbers of the report.
  void addStepToReported();

  /// Number of particles that all ranks have lost since the start. Collective.
  tasks::LostParticles lostParticles();

  /// The variables that outlive a step.
  tasks::MigratedVariables migratedVariables() const;

  Problem problem;
  const mpi::Communicator& ranks;
  /// Communicator of the same ranks, for messages about files, separate from messages of tasks.
  mpi::Communicator files;
  output::Writers writers;  ///< the ranks that write files
  std::optional<std::size_t>
      mostBehind;  ///< largest size of an output that a writer may keep in memory [bytes]; by default a suitable amount
  data::VariableTable table;
  Phases phases;
  data::Warehouse warehouse;
  tasks::Scheduler scheduler;
  TimeControl time;
  RunClock clock;
  Progress progress;
  int delT;                                  ///< index of the variable delT
  Totals totalsAtStart;                      ///< totals at the start of the run, or of the run that it continues
  std::vector<ReportedSoFar> reportedSoFar;  ///< in the order of Phases::reported()
};

}  // namespace tushar::simulation
