#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/output/archive.hpp"
#include "core/simulation/phases.hpp"
#include "core/simulation/report.hpp"

namespace tushar::simulation {

/// Everything that a checked scene comes down to.
struct Problem {
  std::string scenePath, title, componentName;
  std::string inputXml;  ///< the scene with its overrides, for the archive
  TimeSettings time;
  ArchiveSettings archive;
  std::unique_ptr<grid::Level> level;
  std::unique_ptr<Component> component;
  std::vector<std::unique_ptr<Analysis>> analyses;
};

/// A run: it initialises, steps through time, saves what is asked for, and reports.
class Simulation {
 public:
  /// Compiles the task graphs. `startedAt` is when the process started. Throws what Phases throws.
  Simulation(Problem problem, const RunOptions& options, std::chrono::steady_clock::time_point startedAt);

  const Phases& phases() const { return phases_; }
  data::Warehouse& warehouse() { return warehouse_; }
  /// Makes the state at the start, and nothing else; the number of particles. Throws what a run would throw there.
  long tryStart();
  /// Runs to the end of the scene, or to an interrupt. Throws NumericalError, TaskError or FileError.
  Report run();

 private:
  void initialize();
  void step();
  /// Runs diagnostics on the state as it is now.
  void diagnose(tasks::TaskGraph& graph);
  void saveGlobals();
  void save();
  void saveIfDue();
  bool outputDue() const;
  double nextOutputTime() const;
  output::Snapshot snapshot();
  void addField(output::Snapshot& snapshot, const SaveRequest& save);
  std::vector<std::vector<double>> measureTotals(tasks::TaskGraph& graph);
  std::string whyEnded() const;
  bool outOfWallTime() const;
  Report makeReport(const std::vector<std::vector<double>>& before);
  void reportErrors(Report& report);
  void reportDrift(Report& report, const std::vector<std::vector<double>>& before);
  void reportTasks(Report& report);
  std::vector<double> reduction(std::string_view label) const;

  Problem problem_;
  RunOptions options_;
  std::chrono::steady_clock::time_point started_at_;
  data::VariableTable table_;
  Phases phases_;
  data::Warehouse warehouse_;
  tasks::Scheduler scheduler_;
  TimeControl time_;
  Progress progress_;
  std::unique_ptr<output::Archive> archive_;
  long outputs_ = 0;  ///< intervals of output that are done
  double particle_steps_ = 0, wall_loop_ = 0, wall_output_ = 0, wall_startup_ = 0;
};

}  // namespace tushar::simulation
