#pragma once

#include <limits>
#include <map>

#include "core/data/reduction.hpp"

namespace tushar::simulation {

/// The `Time` section.
struct TimeSettings {
  double maxTime = 0;                                    ///< s
  double initTime = 0;                                   ///< s
  double deltMin = 0;                                    ///< s
  double deltMax = std::numeric_limits<double>::max();   ///< s
  double deltInit = std::numeric_limits<double>::max();  ///< greatest first time step, s
  double initialDeltRange = 0;  ///< time up to which deltInit holds, the first step at least, s
  double maxDeltIncrease = std::numeric_limits<double>::max();  ///< longest step is 1 + this times the one before; no
                                                                ///< limit where not positive
  double timestepMultiplier = 1;
  int maxTimesteps = std::numeric_limits<int>::max();
  double maxWallTime = std::numeric_limits<double>::max();  ///< s
  bool endAtMaxTimeExactly = false;
  bool clampTimeToOutput = false;
  bool recomputeTimeStep = false;  ///< whether the step is repeated if a value breaks its bound
};

/// Where a run is in time, and how far the next step may go.
class TimeControl {
 public:
  explicit TimeControl(const TimeSettings& settings) : settings_(settings), time_(settings.initTime) {}

  double time() const { return time_; }   ///< s
  double delT() const { return del_t_; }  ///< of the last step, s
  int step() const { return step_; }
  /// Whether maxTime or max_Timesteps has been reached.
  bool done() const;

  /// The next time step [s] from what the physics allows: timestep_multiplier times `stable`, within max_delt_increase,
  /// delt_min and delt_max; at the start no longer than delt_init, even if that is below delt_min; and (where the scene
  /// requests it) up to maxTime or the next output exactly. A rest up to maxTime that rounding alone would leave is
  /// part of the step. Throws NumericalError for a step that is not positive or too small to move time on.
  double next(const data::Minimum& stable, double nextOutput);
  /// A shorter time step [s] from where `next` started: times the factor `asked`, but at least 0.1 and at most 0.9.
  /// Throws NumericalError for the 21st time in a step, for less than delt_min, and for a step too small to move time
  /// on.
  double repeat(const data::Minimum& asked);
  /// Goes on from where another run was: after `step` steps, the last of `delT` [s], at `time` [s].
  void resume(int step, double time, double delT);
  /// Moves time on by the step that `next` or `repeat` gave.
  void advance();

  /// Whether a value that breaks its bound may have the step repeated with half the time step: where the scene requests
  /// it, and `repeat` would not throw.
  bool mayHalve() const;
  /// How often the step in progress was repeated.
  int repeats() const { return repeats_; }
  /// Steps that were undone and repeated so far.
  int retries() const { return retries_; }
  /// How many steps each limit has determined: the reason of the stable step, a tag of the Time section, or the bound
  /// that made the step be repeated.
  const std::map<data::Reason, int>& limits() const { return limits_; }

 private:
  static constexpr int most_repeats_ = 20;  ///< of a step

  void lower(double& dt, double most, const data::Reason& limit);

  TimeSettings settings_;
  double time_;
  double del_t_ = 0;
  double target_ = 0;  ///< where the step ends
  int step_ = 0;
  int retries_ = 0, repeats_ = 0;
  data::Reason limit_;  ///< that rules the step
  std::map<data::Reason, int> limits_;
};

/// Times that differ by less than this, relative to their size, count as the same.
inline constexpr double timeResolution = 1e-12;

/// The times start + k interval, k = 1, 2, …, that a run passes one after the other.
class Milestones {
 public:
  /// An interval of 0 [s] means none.
  Milestones(double start, double interval) : start_(start), interval_(interval) {}

  /// The first that has not been passed, s; infinity if there are none.
  double next() const;
  bool isReached(double time) const;
  /// Passes those up to `time` [s].
  void pass(double time);

 private:
  double start_, interval_;
  double passed_ = 0;  ///< how many: a whole number
};

}  // namespace tushar::simulation
