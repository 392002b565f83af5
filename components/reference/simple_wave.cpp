#include "components/reference/simple_wave.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace tushar::reference {

namespace {

constexpr int kSamples = 4000;
constexpr int kMostWaveIterations = 200;
constexpr double kWaveRoundOff = 2 * std::numeric_limits<double>::epsilon();

void checkSettings(const SimpleWaveProblem& problem) {
  if (!problem.velocity) throw std::invalid_argument("A simple wave needs a velocity profile.");
  if (!(problem.gamma > 1)) {
    throw std::invalid_argument(fmt::format("The gamma of a simple wave must be above 1, not {}.", problem.gamma));
  }
  if (!(problem.density > 0) || !(problem.soundSpeed > 0)) {
    throw std::invalid_argument(
        fmt::format("A simple wave needs a positive density and sound speed, but has {} and {}.", problem.density,
                    problem.soundSpeed));
  }
  if (!(problem.upper > problem.lower)) {
    throw std::invalid_argument(
        fmt::format("The interval [{}, {}] of a simple wave is empty.", problem.lower, problem.upper));
  }
  if (problem.axis < 0 || problem.axis > 2) {
    throw std::invalid_argument(fmt::format("The axis of a simple wave must be 0, 1 or 2, not {}.", problem.axis));
  }
}

double samplePoint(const SimpleWaveProblem& problem, int k) {
  return problem.lower + (problem.upper - problem.lower) * k / kSamples;
}

/// Smallest value of `f` on [a, b], by golden-section search; `f` has one minimum there.
template <class F>
double leastValue(const F& f, double a, double b) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  for (int i = 0; i < 40; ++i) {
    const double left = b - golden * (b - a);
    const double right = a + golden * (b - a);
    f(left) < f(right) ? b = right : a = left;
  }
  return f(0.5 * (a + b));
}

}  // namespace

SimpleWave::SimpleWave(SimpleWaveProblem problem) : problem_(std::move(problem)) {
  checkSettings(problem_);
  differenceStep_ = 1e-4 * (problem_.upper - problem_.lower);
  checkProfile();
  breakingTime_ = findBreakingTime();
}

void SimpleWave::checkProfile() const {
  for (int k = 0; k <= kSamples; ++k) {
    const double x = samplePoint(problem_, k);
    const double u = problem_.velocity(x);
    if (!std::isfinite(u) || problem_.soundSpeed + 0.5 * (problem_.gamma - 1) * u <= 0) {
      throw std::invalid_argument(
          fmt::format("The velocity {} of the simple wave at x = {} does not allow a positive sound speed.", u, x));
    }
    if (!std::isfinite(stateOf(u).pressure)) {
      throw std::invalid_argument(fmt::format(
          "The velocity {} of the simple wave at x = {} gives a pressure beyond the range of a double.", u, x));
    }
  }
}

/// The signal speed u + c at the point where a characteristic starts.
double SimpleWave::signalSpeed(double start) const {
  return problem_.soundSpeed + 0.5 * (problem_.gamma + 1) * problem_.velocity(start);
}

/// The slope d(u + c)/dx, by central differences of fourth order.
double SimpleWave::signalSlope(double start) const {
  const double d = differenceStep_;
  const double near = signalSpeed(start + d) - signalSpeed(start - d);
  const double far = signalSpeed(start + 2 * d) - signalSpeed(start - 2 * d);
  return (8 * near - far) / (12 * d);
}

double SimpleWave::steepestFall() const {
  int steepest = 0;
  double slope = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kSamples; ++k) {
    const double here = signalSlope(samplePoint(problem_, k));
    if (here < slope) std::tie(steepest, slope) = std::pair(k, here);
  }
  const auto f = [this](double x) { return signalSlope(x); };
  const double a = samplePoint(problem_, std::max(0, steepest - 1));
  const double b = samplePoint(problem_, std::min(kSamples, steepest + 1));
  return std::min(slope, leastValue(f, a, b));
}

double SimpleWave::findBreakingTime() const {
  const double fall = -steepestFall();
  // Differences of a constant profile are round-off, not a wave that breaks late.
  const double noise = 8 * std::numeric_limits<double>::epsilon() * problem_.soundSpeed / differenceStep_;
  return fall > noise ? 1 / fall : std::numeric_limits<double>::infinity();
}

double SimpleWave::foot(double x, double t) const {
  const auto miss = [&](double start) { return start + signalSpeed(start) * t - x; };
  double guess = x - problem_.soundSpeed * t;
  double error = miss(guess);
  double other = guess;  // the bracket's far end: before breaking, miss increases with start
  for (double reach = -error; error != 0 && miss(other) * error > 0; reach *= 2) other = guess + reach;
  double lower = std::min(guess, other);
  double upper = std::max(guess, other);
  for (int i = 0; i < kMostWaveIterations && error != 0; ++i) {
    (error < 0 ? lower : upper) = guess;
    double next = guess - error / (1 + t * signalSlope(guess));
    if (!(next >= lower && next <= upper)) next = 0.5 * (lower + upper);
    const double moved = std::abs(next - guess);
    guess = next;
    if (moved <= kWaveRoundOff * (std::abs(x) + problem_.soundSpeed * t)) break;
    error = miss(guess);
  }
  return guess;
}

GasState SimpleWave::at(const Vec3& x, double t) const {
  if (!(t >= 0))
    throw std::invalid_argument(fmt::format("A simple wave begins at t = 0; there is no solution at t = {}.", t));
  if (t >= breakingTime_) {
    throw std::domain_error(
        fmt::format("The simple wave breaks at t = {}: it has no smooth solution at t = {}.", breakingTime_, t));
  }
  return stateOf(problem_.velocity(foot(x[problem_.axis], t)));
}

/// The state in which the velocity is `u`.
GasState SimpleWave::stateOf(double u) const {
  const double gamma = problem_.gamma;
  const double c0 = problem_.soundSpeed;
  const double ratio = 1 + 0.5 * (gamma - 1) * u / c0;
  GasState gas;
  gas.density = problem_.density * std::pow(ratio, 2 / (gamma - 1));
  gas.velocity[problem_.axis] = u;
  gas.pressure = problem_.density * c0 * c0 / gamma * std::pow(ratio, 2 * gamma / (gamma - 1));
  gas.energy = c0 * c0 * ratio * ratio / (gamma * (gamma - 1));
  return gas;
}

GasState SimpleWave::average(const Vec3& lower, const Vec3& upper, double t) const {
  return averageAlong(problem_.axis, lower, upper, t);
}

}  // namespace tushar::reference
