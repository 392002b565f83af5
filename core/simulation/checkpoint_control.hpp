#pragma once

#include "core/simulation/settings.hpp"
#include "core/simulation/time_control.hpp"

namespace tushar::simulation {

/// If the scene has checkpoints, adds a checkpoint every `interval` [s] of wall time. This replaces the scene's own
/// interval of wall time; its intervals of steps or simulated time remain.
void addWallTimeInterval(std::optional<CheckpointSettings>& settings, double interval);

/// Decides when checkpoints are due. Checkpoints never change a run: no time step is shortened for them.
class CheckpointControl {
 public:
  CheckpointControl(const CheckpointSettings& settings, double initTime);

  /// Whether a checkpoint is due after a step that ended at time `time` [s], `wall` [s] after the process started.
  bool isDue(int step, double time, double wall) const;
  /// Records that a checkpoint has been written, or that a run starts or continues here.
  void note(double time, double wall);

 private:
  int every_;  ///< number of steps between checkpoints; 0: none
  Milestones times_;
  double wall_interval_, next_wall_;
};

}  // namespace tushar::simulation
