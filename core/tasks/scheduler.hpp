#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/tasks/outcome.hpp"
#include "core/tasks/particle_installer.hpp"
#include "core/tasks/relocation.hpp"
#include "core/tasks/task_graph.hpp"

namespace tushar::tasks {

/// The step in which a graph is run, and the level on which it runs.
struct StepInfo {
  int step = 0;
  double time = 0;         ///< time at the start of the step [s]
  double delT = 0;         ///< length of the step [s]; 0 if there is none
  int repeats = 0;         ///< number of repetitions of this step so far
  bool mayRepeat = false;  ///< whether a NumericalError causes a repetition of the step instead of being thrown
  int level = -1;          ///< the level on whose patches the graph runs; -1: all levels
  double part = 0;         ///< elapsed fraction of the next coarser level's step, if `level` is given
};

/// The position of an error in words: task, patch (-1: all patches together), material (-1: none), step, time.
std::string placeOf(const CompiledTask& task, int patch, int material, const StepInfo& at);

/// Runs compiled task graphs with the warehouse of this rank.
///
/// All threads work on the patches of one task at the same time; no result depends on the number of threads.
///
/// All ranks run the same graph, each on its own patches. A rank waits for others only if it needs their values: for
/// ghosts, in a relocation, and at the end of the graph, where reductions are merged and all ranks agree on the
/// outcome. A rank on which a task fails runs no further task, and neither does a rank that would read its values. A
/// task that gets all patches of a rank together is run by all ranks that have patches, or by none.
///
/// A graph whose tasks use only cells of their own level may be run on one level after the other, each with its own
/// step: the results remain on all levels until forgetNew(). commitLevel() copies those of one level to its old state,
/// and exchangeLevel() exchanges them with it.
class Scheduler {
 public:
  /// Uses up to `threads` threads, but at most one per patch of this rank and one per `cellsPerThread` cells of a rank
  /// (if that is not 0); the number of cells changes on a refined grid.
  explicit Scheduler(data::Warehouse& warehouse, int threads = 1, int cellsPerThread = 0)
      : warehouse_(&warehouse),
        most_threads_(threads),
        cells_per_thread_(cellsPerThread),
        threads_(usefulThreads()),
        exchange_(warehouse, threads_),
        relocation_(warehouse, threads_) {}

  /// Runs every task on every patch, and checks the bounds of the values written. The old generation is never changed.
  /// A body that throws, or a violated bound, ends the run of the graph: a NumericalError is rethrown on all ranks,
  /// with task, patch, material, step and time added; any other exception becomes a TaskError on the rank where it
  /// occurred. A failing task still runs on all patches; if there are several errors, that of the first cell, or patch,
  /// is thrown.
  ///
  /// If a task requests a smaller time step by recomputeTimeStep, the graph ends after this task, and its factor and
  /// reason are returned; running the graph again repeats the step. Otherwise returns nothing.
  std::optional<data::Minimum> run(TaskGraph& graph, const StepInfo& at);
  /// From now on, tasks skip materials that have no particles on any rank at the start of a graph, unless the graph
  /// makes particles. The variables of such materials have no values, and views of them are empty.
  void skipAbsentMaterials() { may_skip_ = true; }
  /// Fills the ghosts of old values of cell variables. Collective.
  void fillGhosts(const std::vector<int>& variables);
  /// Makes the results of a graph the old state of the next step.
  void commit(TaskGraph& graph);
  /// Copies the results of a graph on one level to the old state.
  void commitLevel(const TaskGraph& graph, int level);
  /// Exchanges the results of a graph on one level with the old state; a second call undoes the first.
  void exchangeLevel(const TaskGraph& graph, int level);
  /// Discards the results of a graph that was run level by level.
  void forgetNew(const TaskGraph& graph);

  /// Cost of each patch of this rank since the previous call, in seconds of wall time with all threads busy; not
  /// measured on a single rank.
  std::vector<double> takeCosts();
  /// Forgets everything that depends on the distribution of patches. Must be called when it has changed.
  void forgetLayout();

  Relocation& relocation() { return relocation_; }
  const Threads& threads() const { return threads_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// While this object exists, a single rank with one thread reads the clock once per task, not in each loop.
  class OneClock {
   public:
    OneClock(Threads& threads, const mpi::Communicator& ranks) : threads_(threads) {
      threads_.countOutside(ranks.isAlone());
    }
    ~OneClock() { threads_.countOutside(false); }
    OneClock(const OneClock&) = delete;
    OneClock& operator=(const OneClock&) = delete;

   private:
    Threads& threads_;
  };
  /// Time since the previous call, or since the start of the graph [s].
  double lap(trace::Kind kind);
  int usefulThreads() const;
  bool hasStopped() const { return !outcome_.isNone() || heard_stop_; }
  /// Whether the graph runs on the patch with this index on this rank.
  bool isOfLevel(std::size_t place) const;
  /// Calls `work(new values, old values)` for each result of a graph on each patch of a level.
  template <class Work>
  void forEachResult(const TaskGraph& graph, int level, const Work& work);
  bool mayRunTogether();
  const mpi::Communicator& ranksWithPatches();
  /// Starts a run of the first `end` tasks.
  void start(const TaskGraph& graph, int end, const StepInfo& at);
  void distributeOverThreads();
  void findAbsent(const TaskGraph& graph);
  /// What a task accesses on a patch, for a material (-1: none). Materials without particles share one context.
  TaskContext contextOf(const CompiledTask& task, const grid::Patch& patch, int material, const StepInfo& at);
  /// Whether tasks run for a material (-1: no material).
  bool isPresent(int material) const { return !skips_ || material < 0 || is_present_[material]; }
  /// Those of the fills whose materials are present; valid until the next call.
  std::span<const BoundGhostFill> presentOf(const std::vector<BoundGhostFill>& fills);
  void runTask(TaskGraph& graph, int number, const StepInfo& at);
  void runWork(CompiledTask& task, const StepInfo& at);
  /// Completes node variables of which each patch has written only its own nodes.
  void shareFaces(const CompiledTask& task);
  void relocate(const CompiledTask& task, const StepInfo& at);
  template <class Work>
  void forEachPatch(CompiledTask& task, const Work& work);
  template <class Work>
  void workOn(std::size_t place, const CompiledTask& task, const Work& work);
  bool finishExchange(CompiledTask& task);
  void divideReductions(const CompiledTask& task);
  void gatherReductions(const CompiledTask& task);
  void runOnPatches(CompiledTask& task, int material, const StepInfo& at);
  void runOnRank(CompiledTask& task, const StepInfo& at);
  void runAcrossMaterials(CompiledTask& task, const grid::Patch& patch, const StepInfo& at);
  /// Installs the particles that a task has made on all patches as those of its material.
  void install(const CompiledTask& task, int material, const StepInfo& at);
  void runPlaced(CompiledTask& task, const grid::Patch& patch, int material, const StepInfo& at);
  void allocateOutputs(const MaterialBinding& binding);
  void free(const CompiledTask& task);
  /// Carries out the moves found by the last task of a graph, if this task is a relocation.
  void apply(CompiledTask& last);

  std::optional<data::Minimum> factorOf(const CompiledTask& task);
  void note(const CompiledTask& task, int material, const NumericalError& error);
  /// Records the first violated bound for the materials `first` up to `end`, if any.
  void noteBroken(const CompiledTask& task, int first, int end);
  void agree(const TaskGraph& graph);
  NumericalError whatBroke(TaskGraph& graph, const StepInfo& at);

  data::Warehouse* warehouse_;
  int most_threads_, cells_per_thread_;
  Threads threads_;
  Exchange exchange_;
  Relocation relocation_;
  std::vector<ParticleMaker> makers_;    ///< makers of each patch, while a task makes particles
  Outcome outcome_;                      ///< outcome of the current run
  std::optional<NumericalError> error_;  ///< the error that caused it, on the rank on which a body threw it
  std::vector<double> costs_;            ///< for each patch: time of the threads that worked on it [s]
  bool may_skip_ = false;                ///< whether graphs skip materials without particles
  bool skips_ = false;                   ///< whether the current graph skips materials
  std::vector<char> is_present_;         ///< for each material: whether it has particles
  int first_absent_ = 0;                 ///< the first material without particles
  std::vector<BoundGhostFill> present_fills_;
  bool heard_stop_ = false;  ///< whether a rank from which this one receives values has stopped
  int level_ = -1;           ///< the level on whose patches the graph runs; -1: all
  int runs_ = 0;             ///< number of runs of a graph so far
  int running_ = 0;          ///< index in the graph of the task that is running
  int end_ = 0;              ///< end of the range of tasks to run
  Clock::time_point lap_started_;
  std::optional<mpi::Communicator> with_patches_;
};

}  // namespace tushar::tasks
