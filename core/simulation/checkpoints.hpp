#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "core/output/checkpoint_store.hpp"
#include "core/simulation/checkpoint_control.hpp"
#include "core/simulation/outputs.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// Writes and reads the checkpoints of a run, in the folder of its archive. All ranks make the same calls.
class Checkpoints {
 public:
  Checkpoints(RunState& run, Outputs& outputs);

  /// Sets a function that is called on rank 0 with messages about damaged checkpoints.
  void setWarning(std::function<void(const std::string&)> warn) { warn_ = std::move(warn); }
  /// Reads the checkpoint from which the run continues or, if it is damaged, the previous one. Throws InputError if
  /// there is no checkpoint, or if it does not match the scene.
  void resume();
  /// Writes a checkpoint at the start, if the scene has checkpoints.
  void writeFirst();
  /// Writes a checkpoint at the end, if the scene has checkpoints, or if the run has an archive and was cut short.
  void writeLast();
  /// Whether a checkpoint is due after the step that has just ended.
  bool isDue() const;
  /// Writes a checkpoint, unless this step has one. Of several checkpoints within seconds, only the first waits for the
  /// disk.
  void write();
  /// Waits until the last checkpoint is on the disk.
  void settle();

  /// Wall time spent writing [s].
  double seconds() const { return seconds_; }
  /// Increase of this rank's peak memory caused by writing [bytes].
  double memory() const { return memory_; }

 private:
  /// Reads the checkpoint; returns false if it is damaged, so that the previous one must be read.
  bool read();
  output::CheckpointStore store() const;
  /// Records that the last checkpoint is on the disk; writing it began at `started`.
  void noteOnDisk(Clock::time_point started);

  RunState& run_;
  Outputs& outputs_;
  std::optional<CheckpointControl> control_;  ///< when checkpoints are due; empty if the scene has none
  int last_ = -1;                             ///< step of the checkpoint that was last written or read
  int on_disk_ = -1;                          ///< step of the last checkpoint that is known to be on the disk
  Clock::time_point next_wait_;               ///< from then on, writing a checkpoint ends only when it is on the disk
  double seconds_ = 0, memory_ = 0;
  std::function<void(const std::string&)> warn_;
};

}  // namespace tushar::simulation
