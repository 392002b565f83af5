#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/base/mpi.hpp"
#include "core/simulation/trigger_files.hpp"

namespace tushar::simulation {

using Clock = std::chrono::steady_clock;

/// Seconds since a point in time.
inline double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The wall clock of a run, and external requests by signals and files. All ranks share the last reading, so that they
/// end the run, save the state and write checkpoints after the same step.
class RunClock {
 public:
  /// `startedAt` is when the process started.
  explicit RunClock(Clock::time_point startedAt) : started_at_(startedAt) {}

  /// Time since the process started, on this rank [s].
  double now() const { return secondsSince(started_at_); }
  /// From now on, checks for request files in the folder of the archive. Only on rank 0.
  void watch(const std::filesystem::path& folder) { files_.emplace(folder); }
  /// Reads the clock, and the requests received by any rank. Collective.
  void agree(const mpi::Communicator& ranks);
  /// Time from the start of the process to the latest moment at which all ranks read the clock [s].
  double elapsed() const { return elapsed_; }
  /// Whether an interrupt must end the run on all ranks.
  bool isInterrupted() const { return interrupted_; }
  /// Whether a request file must end the run.
  bool isStopped() const { return stopped_; }
  /// Records a failure on this rank; the others are informed.
  void noteFailure() { failed_ = true; }
  /// Whether any rank had reported a failure at the last synchronisation.
  bool hasFailed() const { return failed_; }
  /// Whether the state must be saved now; returns true once for each request.
  bool takeSaveRequest() { return std::exchange(save_asked_, false); }

 private:
  Clock::time_point started_at_;
  double elapsed_ = 0;
  bool interrupted_ = false, stopped_ = false, save_asked_ = false, failed_ = false;
  std::optional<TriggerFiles> files_;
};

}  // namespace tushar::simulation
