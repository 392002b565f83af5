#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/base/progress.hpp"
#include "core/output/archive.hpp"
#include "core/output/checkpoint_store.hpp"
#include "core/output/folder_lock.hpp"
#include "core/simulation/balance.hpp"
#include "core/simulation/checkpoint_control.hpp"
#include "core/simulation/gather.hpp"
#include "core/simulation/phases.hpp"
#include "core/simulation/report.hpp"
#include "core/simulation/restart.hpp"
#include "core/simulation/stored_state.hpp"
#include "core/tasks/patch_migration.hpp"

namespace tushar::simulation {

/// Everything that a checked scene comes down to.
struct Problem {
  std::string scenePath, title, componentName;
  std::string inputXml;             ///< the scene with its overrides, for the archive
  std::vector<InputProblem> notes;  ///< what of the scene does nothing
  TimeSettings time;
  ArchiveSettings archive;
  std::unique_ptr<grid::Level> level;
  int threads = 1;
  std::unique_ptr<Component> component;
  std::vector<std::unique_ptr<Analysis>> analyses;
  std::optional<Restart> restart;  ///< where the run goes on; none where it starts
};

/// A run: it initialises or goes on from a checkpoint, steps through time, saves what is asked for, and reports. Where
/// several ranks share it, the first writes and reports for all.
class Simulation {
 public:
  /// Compiles the task graphs. `startedAt` is when the process started. Throws what Phases throws.
  Simulation(Problem problem, const RunOptions& options, std::chrono::steady_clock::time_point startedAt);
  /// The same on one of the ranks that share the grid. Every rank makes one, and calls what it calls on it.
  Simulation(Problem problem, const RunOptions& options, std::chrono::steady_clock::time_point startedAt,
             const mpi::Communicator& ranks);

  const Phases& phases() const { return phases_; }
  data::Warehouse& warehouse() { return warehouse_; }
  /// Makes the state at the start (or reads the checkpoint), and nothing else; the number of particles. Throws what a
  /// run would throw there.
  long tryStart();
  /// Runs to the end of the scene, to an interrupt, or to a value that cannot be, which the report then tells: the last
  /// whole step is saved. Throws TaskError, FileError, and NumericalError for a start that cannot be.
  Report run();

 private:
  using Clock = std::chrono::steady_clock;
  using Totals = std::vector<std::vector<double>>;

  /// Seconds that have passed.
  static double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

  void begin();
  void initialize();
  void openArchive();
  void makeArchive(const output::ArchiveOptions& how);
  void reopenArchive(const output::ArchiveOptions& how);
  void agreeOnClock();
  long ownParticles();
  NumericalError advised(const NumericalError& error) const;
  /// The old state is that of the last whole step: writes it and a checkpoint, where the scene saves anything.
  void saveLastGood();
  void step();
  /// Runs diagnostics on the state as it is now.
  void diagnose(tasks::TaskGraph& graph);
  void balanceAtStart();
  void balanceIfDue();
  void balance(const std::vector<double>& costs);
  tasks::MigratedVariables migratedVariables() const;
  bool hasEnded() const;
  void saveGlobals();
  /// Whether some analysis looks at particles while the run goes on.
  bool samples() const;
  void sample(Analysis& analysis);
  void save();
  void saveIfDue();
  bool outputDue() const;
  /// The particles of every material, with p.x alone.
  output::Snapshot positions(Gather& gather);
  output::Snapshot snapshot();
  void addField(output::Snapshot& snapshot, const SaveRequest& save, Gather& gather);
  void resume();
  void checkScene(const output::Hdf5Input& file) const;
  output::CheckpointStore checkpointStore() const;
  StateNames stateNames() const;
  void checkpointIfDue();
  void checkpointAtEnd();
  void checkpoint();
  void writeCheckpoint(const std::filesystem::path& file, const output::ArchivePoint& point, long dropped);
  Totals measureTotals(tasks::TaskGraph& graph);
  std::string whyEnded() const;
  bool outOfWallTime() const;
  Report makeReport();
  void reportErrors(Report& report);
  void reportDrift(Report& report);
  void reportTasks(Report& report);
  std::vector<double> reduction(std::string_view label) const;

  Problem problem_;
  RunOptions options_;
  const mpi::Communicator* ranks_;
  std::chrono::steady_clock::time_point started_at_;
  data::VariableTable table_;
  Phases phases_;
  data::Warehouse warehouse_;
  tasks::Scheduler scheduler_;
  TimeControl time_;
  Balance balance_;
  Progress progress_;
  std::optional<output::FolderLock> lock_;    ///< on the archive's folder
  std::unique_ptr<output::Archive> archive_;  ///< of the first rank
  std::string folder_;                        ///< of the archive; empty where there is none
  int last_output_ = -1;                      ///< step of the last that was written
  bool saves_ = false;                        ///< whether the scene asks for outputs or globals
  Milestones outputs_;
  std::optional<CheckpointControl> checkpoints_;  ///< none where the scene asks for none
  int last_checkpoint_ = -1;                      ///< step of the last that was written or read
  Totals totals_at_start_;
  std::optional<NumericalError> failure_;
  TimeUse time_use_;
  double elapsed_ = 0;        ///< s since the process started, as all ranks see it
  bool interrupted_ = false;  ///< whether all ranks are to end the run
  long particle_steps_ = 0;   ///< of this rank
  double wall_loop_ = 0, wall_output_ = 0, wall_startup_ = 0;
};

}  // namespace tushar::simulation
