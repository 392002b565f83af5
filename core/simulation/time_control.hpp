#pragma once

#include <limits>

namespace tushar::simulation {

/// The `Time` section.
struct TimeSettings {
  double maxTime = 0;                  ///< s
  double initTime = 0;                 ///< s
  double deltMin = 0;                  ///< s
  double deltMax = std::numeric_limits<double>::max();   ///< s
  double deltInit = std::numeric_limits<double>::max();  ///< greatest first time step, s
  double maxDeltIncrease = std::numeric_limits<double>::max();  ///< greatest ratio of a step to the one before
  double timestepMultiplier = 1;
  int maxTimesteps = std::numeric_limits<int>::max();
  double maxWallTime = std::numeric_limits<double>::max();  ///< s
  bool endAtMaxTimeExactly = false;
  bool clampTimeToOutput = false;
};

/// Where a run is in time, and how far the next step may go.
class TimeControl {
 public:
  explicit TimeControl(const TimeSettings& settings) : settings_(settings), time_(settings.initTime) {}

  double time() const { return time_; }  ///< s
  double delT() const { return del_t_; }  ///< of the last step, s
  int step() const { return step_; }
  /// Whether maxTime or max_Timesteps has been reached.
  bool done() const;

  /// The next time step [s] from what the physics allow: timestep_multiplier times `stable`, within delt_min and
  /// delt_max, max_delt_increase, and (where the scene asks) up to maxTime or the next output exactly.
  /// Throws NumericalError for a step that is not positive or too small to move time on.
  double next(double stable, double nextOutput);
  /// Goes on from where another run was: after `step` steps, the last of `delT` [s], at `time` [s].
  void resume(int step, double time, double delT);
  /// Moves time on by the step that `next` gave.
  void advance();

 private:
  TimeSettings settings_;
  double time_;
  double del_t_ = 0;
  double target_ = 0;  ///< where the step ends
  int step_ = 0;
};

/// The times start + k interval, k = 1, 2, …, that a run passes one after the other.
class Milestones {
 public:
  /// An interval of 0 [s] means none.
  Milestones(double start, double interval) : start_(start), interval_(interval) {}

  /// The first that has not been passed, s; infinity where there are none.
  double next() const;
  bool isReached(double time) const;
  /// Passes those up to `time` [s].
  void pass(double time);

 private:
  double start_, interval_;
  long passed_ = 0;
};

}  // namespace tushar::simulation
