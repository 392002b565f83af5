#pragma once

#include "core/base/missing.hpp"
#include "core/base/threads.hpp"
#include "core/report/report.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// Measures a run in progress, and its state at the end. All ranks make the same calls. `outputSeconds` is the wall
/// time spent on outputs since the process started [s].
class RunReport {
 public:
  explicit RunReport(RunState& run) : run_(run) {}

  /// Records that the start-up is over. The time to build missing modules does not count.
  void noteStartUp(double outputSeconds) { start_up_ = run_.clock.now() - outputSeconds - secondsOfBuilds(); }
  void beginLoop(double outputSeconds);
  /// Records a step, and the number of steps of each level in it; empty: one step of each level.
  void noteStep(const std::vector<int>& stepsOfLevels = {});
  void endLoop(double outputSeconds);

  /// Makes the report, except for the end of the run, its outputs, and the patches that changed ranks. `fileMemory` is
  /// the increase of this rank's peak memory caused by outputs and checkpoints [bytes].
  report::Report make(double fileMemory = 0);

 private:
  void noteLevels(const std::vector<int>& steps);
  std::vector<long> cellsOfLevels() const;
  double stepsOfFinest() const;
  void addMemory(report::Report& report, double fileMemory);
  void addLayout(report::Report& report);
  void addProgress(report::Report& report);
  void addTasks(report::Report& report);
  void addDrifts(report::Report& report);
  void addReported(report::Report& report);
  void addErrors(report::Report& report);

  RunState& run_;
  Clock::time_point loop_started_;
  Threads::Use use_before_;
  double output_before_ = 0;
  double start_up_ = 0, loop_ = 0;  ///< wall time of the start-up and of the time loop, without outputs [s]
  report::TimeUse use_;
  long particle_steps_ = 0;            ///< number of updates of this rank's particles
  double updates_ = 0;                 ///< number of cell updates, on all ranks
  double uniform_updates_ = 0;         ///< number of cell updates if all cells were on the finest level
  std::vector<double> level_updates_;  ///< number of cell updates of each level, if finer levels take smaller steps
};

}  // namespace tushar::simulation
