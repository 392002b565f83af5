#pragma once

#include <limits>
#include <map>

#include "core/data/reduction.hpp"

namespace tushar::simulation {

/// The `Time` section.
struct TimeSettings {
  static constexpr double unlimited = std::numeric_limits<double>::max();

  double maxTime = 0;           ///< end of the run [s]
  double initTime = 0;          ///< start of the run [s]
  double deltMin = 0;           ///< smallest time step [s]
  double deltMax = unlimited;   ///< largest time step [s]
  double deltInit = unlimited;  ///< largest first time step [s]
  double initialDeltRange = 0;  ///< time until which deltInit limits the steps [s]; it always limits the first step
  double maxDeltIncrease = unlimited;  ///< at most (1 + this) times the previous step;
                                       ///< no limit if not positive
  double timestepMultiplier = 1;
  int maxTimesteps = std::numeric_limits<int>::max();
  double maxWallTime = unlimited;  ///< largest wall time [s]
  bool endAtMaxTimeExactly = false;
  bool clampTimeToOutput = false;
  bool recomputeTimeStep = false;  ///< whether the step is repeated if a value violates its bound
};

/// The current time of a run, and the length of its next step.
class TimeControl {
 public:
  explicit TimeControl(const TimeSettings& settings) : settings_(settings), time_(settings.initTime) {}

  double time() const { return time_; }   ///< Current time [s].
  double delT() const { return del_t_; }  ///< The length of the latest step [s].
  int step() const { return step_; }
  /// Whether maxTime or max_Timesteps has been reached.
  bool done() const;
  /// The fraction of the run that is done, by time or by steps, whichever is larger.
  double fractionDone() const;

  /// The next time step [s]: timestep_multiplier times `stable`, limited by max_delt_increase, delt_min and delt_max;
  /// at the start no longer than delt_init, even if that is below delt_min; and, if the scene requests it, such that
  /// the step ends exactly at maxTime or the next output. If only a remainder due to rounding would be left before
  /// maxTime, the step includes it. Throws NumericalError if the step is not positive or too small to advance time.
  double next(const data::Minimum& stable, double nextOutput);
  /// A shorter time step [s] from the same time: the previous one times the factor `asked`, which is limited to the
  /// range from 0.1 to 0.9. Throws NumericalError if the step has already been repeated 20 times, or if the shorter
  /// step is below delt_min or too small to advance time.
  double repeat(const data::Minimum& asked);
  /// Continues another run after `step` steps, the last of length `delT` [s], at `time` [s].
  void resume(int step, double time, double delT);
  /// Advances time by the step of `next` or `repeat`.
  void advance();

  /// Whether a step may be repeated with half the time step because of an invalid value: if the scene requests this,
  /// and `repeat` would not throw.
  bool mayHalve() const;
  /// Number of repetitions of the step in progress.
  int repeats() const { return repeats_; }
  /// Number of steps that have been undone and repeated so far.
  int retries() const { return retries_; }
  /// Number of steps determined by each limit: the reason of the stable step, a tag of the Time section, or the bound
  /// because of which the step was repeated.
  const std::map<data::Reason, int>& limits() const { return limits_; }

 private:
  static constexpr int most_repeats_ = 20;  ///< largest number of repetitions of a step

  void lower(double& dt, double most, const data::Reason& limit);

  TimeSettings settings_;
  double time_;
  double del_t_ = 0;
  double target_ = 0;  ///< time at the end of the step [s]
  int step_ = 0;
  int retries_ = 0, repeats_ = 0;
  data::Reason limit_;  ///< the limit that determines the step
  std::map<data::Reason, int> limits_;
};

/// Times whose difference, relative to their size, is smaller than this are considered equal.
inline constexpr double timeResolution = 1e-12;

/// The times start + k interval, k = 1, 2, …, which a run passes in turn.
class Milestones {
 public:
  /// An interval of 0 s means that there are no such times.
  Milestones(double start, double interval) : start_(start), interval_(interval) {}

  /// The next of these times [s]; infinity if there are none.
  double next() const;
  bool isReached(double time) const;
  /// Passes all of these times up to `time` [s].
  void pass(double time);

 private:
  double start_, interval_;
  double passed_ = 0;  ///< number of times passed, an integer
};

}  // namespace tushar::simulation
