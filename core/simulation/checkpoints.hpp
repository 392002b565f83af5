#pragma once

#include <optional>

#include "core/simulation/checkpoint_control.hpp"
#include "core/simulation/outputs.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// The checkpoints of a run, in the folder of its archive: when they are due, and which was the last. Every rank calls
/// what it calls on them.
class Checkpoints {
 public:
  Checkpoints(RunState& run, Outputs& outputs);

  /// Makes the checkpoint that the run goes on from its state. Throws InputError for one that does not fit the scene.
  void resume();
  /// The one at the start, where the scene asks for checkpoints.
  void writeFirst();
  /// The one at the end: where the scene asks for checkpoints, or the run was cut short and has an archive.
  void writeLast();
  /// Whether one is due after the last step.
  bool isDue() const;
  /// Writes one, unless this step has one.
  void write();

  /// Wall time spent writing, s.
  double seconds() const { return seconds_; }

 private:
  RunState& run_;
  Outputs& outputs_;
  std::optional<CheckpointControl> control_;  ///< none where the scene asks for none
  int last_ = -1;                             ///< step of the last that was written or read
  double seconds_ = 0;
};

}  // namespace tushar::simulation
