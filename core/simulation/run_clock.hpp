#pragma once

#include <chrono>

#include "core/base/mpi.hpp"

namespace tushar::simulation {

using Clock = std::chrono::steady_clock;

/// Seconds that have passed.
inline double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The wall clock of a run. All ranks share its last reading, so that they end the run and write checkpoints after the
/// same step.
class RunClock {
 public:
  /// `startedAt` is when the process started.
  explicit RunClock(Clock::time_point startedAt) : started_at_(startedAt) {}

  /// Time since the process started, on this rank, s.
  double now() const { return secondsSince(started_at_); }
  /// Reads the clock, and whether any rank was interrupted. All ranks call it.
  void agree(const mpi::Communicator& ranks);
  /// Time since the process started, at the last reading of all ranks, s.
  double elapsed() const { return elapsed_; }
  /// Whether an interrupt is to end the run on all ranks.
  bool isInterrupted() const { return interrupted_; }

 private:
  Clock::time_point started_at_;
  double elapsed_ = 0;
  bool interrupted_ = false;
};

}  // namespace tushar::simulation
