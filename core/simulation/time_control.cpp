#include "core/simulation/time_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace tushar::simulation {

bool TimeControl::done() const { return time_ >= settings_.maxTime || step_ >= settings_.maxTimesteps; }

double TimeControl::next(double stable, double nextOutput) {
  double dt = settings_.timestepMultiplier * stable;
  if (step_ == 0)
    dt = std::min(dt, settings_.deltInit);
  else
    dt = std::min(dt, settings_.maxDeltIncrease * del_t_);
  dt = std::min(std::max(dt, settings_.deltMin), settings_.deltMax);
  if (!(dt > 0) || !std::isfinite(dt))
    throw NumericalError(fmt::format("the time step became {:.6g} s (step {}, time {:.6g} s)", dt, step_ + 1, time_),
                         "a scene in which something moves or has a speed of sound, or <delt_max>");
  if (time_ + dt == time_)
    throw NumericalError(fmt::format("the time step of {:.6g} s is too small to move time on from {:.6g} s (step {})",
                                     dt, time_, step_ + 1),
                         "delt_min, or whatever keeps speeds finite");
  target_ = time_ + dt;
  if (settings_.clampTimeToOutput && nextOutput < target_) target_ = nextOutput;
  if (settings_.endAtMaxTimeExactly && settings_.maxTime < target_) target_ = settings_.maxTime;
  del_t_ = target_ == time_ + dt ? dt : target_ - time_;
  return del_t_;
}

void TimeControl::resume(int step, double time, double delT) {
  step_ = step;
  time_ = target_ = time;
  del_t_ = delT;
}

void TimeControl::advance() {
  time_ = target_;
  ++step_;
}

double Milestones::next() const {
  if (interval_ <= 0) return std::numeric_limits<double>::infinity();
  return start_ + static_cast<double>(passed_ + 1) * interval_;
}

bool Milestones::isReached(double time) const { return time >= next() - 1e-12 * std::abs(next()); }

void Milestones::pass(double time) {
  while (isReached(time)) ++passed_;
}

}  // namespace tushar::simulation
