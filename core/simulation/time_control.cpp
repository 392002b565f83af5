#include "core/simulation/time_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace tushar::simulation {

bool TimeControl::done() const { return time_ >= settings_.maxTime || step_ >= settings_.maxTimesteps; }

double TimeControl::fractionDone() const {
  const double time = settings_.maxTime - settings_.initTime;
  const double byTime = time > 0 ? (time_ - settings_.initTime) / time : 0;
  return std::max(byTime, static_cast<double>(step_) / std::max(settings_.maxTimesteps, 1));
}

void TimeControl::lower(double& dt, double most, const data::Reason& limit) {
  if (!(most < dt)) return;
  dt = most;
  limit_ = limit;
}

double TimeControl::next(const data::Minimum& stable, double nextOutput) {
  double dt = settings_.timestepMultiplier * stable.value;
  limit_ = stable.reason;
  repeats_ = 0;
  if (step_ > 0 && settings_.maxDeltIncrease > 0 && settings_.maxDeltIncrease < TimeSettings::unlimited)
    lower(dt, (1 + settings_.maxDeltIncrease) * del_t_, "max_delt_increase");
  if (dt < settings_.deltMin) {
    dt = settings_.deltMin;
    limit_ = "delt_min";
  }
  if (settings_.deltMax > 0) lower(dt, settings_.deltMax, "delt_max");
  if (step_ == 0 || time_ <= settings_.initialDeltRange) lower(dt, settings_.deltInit, "delt_init");
  if (dt >= TimeSettings::unlimited) lower(dt, settings_.maxTime - time_, "maxTime");  // nothing moves
  if (!(dt > 0) || !std::isfinite(dt))
    throw NumericalError(fmt::format("the time step became {:.6g} s (step {}, time {:.6g} s)", dt, step_ + 1, time_),
                         "a scene in which something moves or has a speed of sound, or a <delt_max>");
  if (time_ + dt == time_)
    throw NumericalError(fmt::format("the time step of {:.6g} s is too small to advance time from {:.6g} s (step {})",
                                     dt, time_, step_ + 1),
                         "delt_min, or a setting that keeps speeds finite");
  target_ = time_ + dt;
  if (settings_.clampTimeToOutput) lower(target_, nextOutput, "clamp_time_to_output");
  if (settings_.endAtMaxTimeExactly) lower(target_, settings_.maxTime, "end_at_max_time_exactly");
  const double rest = settings_.maxTime - target_;
  if (settings_.endAtMaxTimeExactly && rest <= std::min(timeResolution * std::abs(settings_.maxTime), 1e-3 * dt))
    target_ = settings_.maxTime;
  del_t_ = target_ == time_ + dt ? dt : target_ - time_;
  return del_t_;
}

void TimeControl::resume(int step, double time, double delT) {
  step_ = step;
  time_ = target_ = time;
  del_t_ = delT;
}

bool TimeControl::mayHalve() const {
  const double dt = 0.5 * del_t_;
  return settings_.recomputeTimeStep && repeats_ < most_repeats_ && dt >= settings_.deltMin && time_ + dt > time_;
}

double TimeControl::repeat(const data::Minimum& asked) {
  const double dt = del_t_ * std::clamp(asked.value, 0.1, 0.9);
  const std::string where = fmt::format("(step {}, time {:.6g} s)", step_ + 1, time_);
  const std::string advice =
      "a setting that keeps " + std::string(asked.reason.text()) + " within its bound, or a lower delt_min";
  if (repeats_ == most_repeats_)
    throw NumericalError(
        fmt::format("{} would still violate its bound with a time step of {:.6g} s, after {} repeats {}",
                    asked.reason.text(), del_t_, most_repeats_, where),
        advice);
  if (dt < settings_.deltMin || time_ + dt == time_)
    throw NumericalError(fmt::format("{} would violate its bound unless the time step fell to {:.6g} s, below {} {}",
                                     asked.reason.text(), dt,
                                     dt < settings_.deltMin ? fmt::format("delt_min = {:.6g} s", settings_.deltMin)
                                                            : "the smallest step that advances time",
                                     where),
                         advice);
  ++retries_;
  ++repeats_;
  limit_ = asked.reason;
  target_ = time_ + dt;
  del_t_ = dt;
  return dt;
}

void TimeControl::advance() {
  time_ = target_;
  ++step_;
  ++limits_[limit_];
}

double Milestones::next() const {
  if (interval_ <= 0) return std::numeric_limits<double>::infinity();
  return start_ + (passed_ + 1) * interval_;
}

bool Milestones::isReached(double time) const { return time >= next() - timeResolution * std::abs(next()); }

void Milestones::pass(double time) {
  if (!isReached(time)) return;
  passed_ = std::max(passed_ + 1, std::floor((time - start_) / interval_));
  if (isReached(time)) ++passed_;
}

}  // namespace tushar::simulation
