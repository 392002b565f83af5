#include "core/simulation/checkpoint_control.hpp"

#include <cmath>

namespace tushar::simulation {

namespace {

/// Converts a time that is given in seconds or in hours to [s]; infinity if it is not given.
double seconds(const std::optional<double>& given, const std::optional<double>& hours) {
  constexpr double hour = 3600;
  return given ? *given : hours ? *hours * hour : std::numeric_limits<double>::infinity();
}

}  // namespace

void addWallTimeInterval(std::optional<CheckpointSettings>& settings, double interval) {
  if (!settings) settings.emplace();
  settings->walltimeInterval = interval;
  settings->walltimeStart = settings->walltimeStartHours = settings->walltimeIntervalHours = std::nullopt;
}

CheckpointControl::CheckpointControl(const CheckpointSettings& settings, double initTime)
    : every_(settings.timestepInterval.value_or(0)),
      times_(initTime, settings.interval.value_or(0)),
      wall_interval_(seconds(settings.walltimeInterval, settings.walltimeIntervalHours)),
      next_wall_(seconds(settings.walltimeStart, settings.walltimeStartHours)) {
  if (!std::isfinite(next_wall_)) next_wall_ = wall_interval_;
}

bool CheckpointControl::isDue(int step, double time, double wall) const {
  return (every_ > 0 && step % every_ == 0) || times_.isReached(time) || wall >= next_wall_;
}

void CheckpointControl::note(double time, double wall) {
  times_.pass(time);
  if (wall >= next_wall_) next_wall_ = wall + wall_interval_;
}

}  // namespace tushar::simulation
