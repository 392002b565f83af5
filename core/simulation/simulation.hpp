#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/base/mpi.hpp"
#include "core/report/report.hpp"
#include "core/simulation/checkpoints.hpp"
#include "core/simulation/outputs.hpp"
#include "core/simulation/rebalancer.hpp"
#include "core/simulation/run_report.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// The time loop of a run, which starts from the scene or from a checkpoint, over its outputs, checkpoints and report.
/// Rank 0 writes and reports for all ranks.
class Simulation {
 public:
  /// Compiles the task graphs. `startedAt` is when the process started. Throws what Phases throws.
  Simulation(Problem problem, const RunOptions& options, Clock::time_point startedAt);
  /// Runs on one of the ranks that share the grid. All ranks make one, and make the same calls.
  Simulation(Problem problem, const RunOptions& options, Clock::time_point startedAt, const mpi::Communicator& ranks);

  const Phases& phases() const { return run_.phases; }
  data::Warehouse& warehouse() { return run_.warehouse; }
  /// Makes the state at the start (or reads the checkpoint), and nothing else; the number of particles. Throws what a
  /// run would throw there.
  long tryStart();
  /// Runs to the end of the scene, to an interrupt, or to a value that is not finite or out of its bounds, which the
  /// report then names: the last whole step is saved. Throws TaskError, FileError, and NumericalError for such a value
  /// at the start.
  report::Report run();

 private:
  void begin();
  void resume();
  void initialize();
  void loop();
  void step();
  /// Advances the state by a time step, which is repeated with a shorter one if a task asks for it.
  void advance();
  bool hasEnded() const;
  std::string whyEnded() const;
  NumericalError advised(const NumericalError& error) const;
  /// Writes an output and a checkpoint of the old state, that of the last whole step, if the run has an archive.
  void saveLastGood();
  /// Wall time of outputs and checkpoints, s.
  double outputSeconds() const { return outputs_.seconds() + checkpoints_.seconds(); }
  report::Report makeReport();

  RunState run_;
  Outputs outputs_;
  Checkpoints checkpoints_;
  Rebalancer rebalancer_;
  RunReport report_;
  std::optional<NumericalError> failure_;
};

}  // namespace tushar::simulation
