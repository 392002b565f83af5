#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/output/run_log.hpp"
#include "core/report/report.hpp"
#include "core/simulation/checkpoints.hpp"
#include "core/simulation/level_steps.hpp"
#include "core/simulation/outputs.hpp"
#include "core/simulation/patch_cutter.hpp"
#include "core/simulation/rebalancer.hpp"
#include "core/simulation/regridder.hpp"
#include "core/simulation/run_report.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// A run: the time loop, from the scene or from a checkpoint, with its outputs, checkpoints and report. Rank 0 writes
/// and reports for all ranks.
class Simulation {
 public:
  /// Compiles the task graphs. `startedAt` is when the process started. Throws the exceptions of Phases.
  Simulation(Problem problem, const RunOptions& options, Clock::time_point startedAt);
  /// Constructs a run on one of the ranks that share the grid. All ranks construct one, and make the same calls.
  Simulation(Problem problem, const RunOptions& options, Clock::time_point startedAt, const mpi::Communicator& ranks);

  const Phases& phases() const { return run_.phases; }
  data::Warehouse& warehouse() { return run_.warehouse; }
  /// Creates the initial state, or reads the checkpoint, without a time step; returns the number of particles. Throws
  /// the exceptions that the start of a run would throw.
  long tryStart();
  /// Sets the entry of run.json for the program and its command line.
  void setRecord(output::RunRecord record) { record_ = std::move(record); }
  /// Sets a function that is called on rank 0 with messages about damaged checkpoints.
  void setWarning(const std::function<void(const std::string&)>& warn) {
    checkpoints_.setWarning(warn);
    outputs_.setWarning(warn);
  }
  /// Runs until the end of the scene, an interrupt, a file `stop_now` in the archive, or an invalid value. The report
  /// then names the invalid value, and the last complete step is saved. Throws TaskError, FileError, and NumericalError
  /// for an invalid value at the start.
  report::Report run();

 private:
  void openLog();
  void begin();
  void distributeAtStart();
  void resume();
  void initialize();
  void initializeOnce();
  /// Throws InputError if there are particles on levels on which they are not allowed.
  void refuseCoarseParticles();
  void loop();
  void step();
  /// Advances the state by one time step, which is repeated with a shorter one if a task requires it.
  void advance();
  void moveBetweenMaterials();
  /// Sets to 0 the sums over steps that have no values yet.
  void beginSums();
  /// Adds the current state to the sums over steps.
  void addToSums();
  /// The longest stable step for the current state, and the limit that determines it.
  data::Minimum stableStep();
  /// Tries a step of length `dt` [s]; if a task requires a shorter one, returns the factor.
  std::optional<data::Minimum> tryStep(double dt);
  bool hasEnded() const;
  std::string whyEnded() const;
  NumericalError advised(const NumericalError& error) const;
  /// Writes an output and a checkpoint of the last complete step (the old state), if the run has an archive.
  void saveLastGood();
  /// Wall time of outputs and checkpoints [s].
  double outputSeconds() const { return outputs_.seconds() + checkpoints_.seconds(); }
  /// Writes an output and a checkpoint between steps, at the request of a signal or a file.
  void saveNow();
  /// Writes the output and the checkpoint at the end.
  void saveEnd();
  report::Report makeReport();

  RunState run_;
  Outputs outputs_;
  Checkpoints checkpoints_;
  PatchCutter patch_cutter_;
  Rebalancer rebalancer_;
  Regridder regridder_;
  RunReport report_;
  std::optional<LevelSteps> level_steps_;  ///< steps of the levels, if finer levels take smaller ones
  std::optional<NumericalError> failure_;
  output::RunRecord record_;
  std::optional<output::RunLog> log_;  ///< entry in run.json; on rank 0, if the run has an archive
};

/// The exit code of sus after a run with this report.
ExitCode exitCodeOf(const report::Report& report);

}  // namespace tushar::simulation
