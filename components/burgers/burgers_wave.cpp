#include "components/burgers/burgers_wave.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "components/reference/gas_fields.hpp"

namespace tushar::burgers {

using reference::kGauss5;

namespace {

constexpr long kSteps = 8192;
constexpr double kFar = 40;  ///< argument beyond which exp(-kFar) is negligible

}  // namespace

BurgersWave::BurgersWave(BurgersProblem problem) : problem_(std::move(problem)) {
  if (!(problem_.viscosity >= 0 && problem_.upper > problem_.lower))
    throw std::invalid_argument(
        fmt::format("A wave of Burgers' equation needs a viscosity of at least 0 and an interval that is not empty, "
                    "but has {} and [{}, {}].",
                    problem_.viscosity, problem_.lower, problem_.upper));
  step_ = (problem_.upper - problem_.lower) / kSteps;
  least_ = greatest_ = problem_.velocity(problem_.lower);
  integrals_.push_back(0);
  for (long k = 0; k < kSteps; ++k) {
    double sum = 0;
    for (const auto& point : kGauss5) {
      const double u = problem_.velocity(place(k) + point.at * step_);
      sum += point.weight * u;
      least_ = std::min(least_, u);
      greatest_ = std::max(greatest_, u);
    }
    if (!std::isfinite(sum))
      throw std::invalid_argument(fmt::format("The profile of a wave is not finite near x = {:g}.", place(k)));
    integrals_.push_back(integrals_.back() + step_ * sum);
  }
}

bool BurgersWave::holdsAt(double t) const {
  return t == 0 || (t > 0 && (problem_.viscosity == 0 || std::sqrt(2 * problem_.viscosity * t) >= 2 * step_));
}

void BurgersWave::checkTime(double t) const {
  if (!holdsAt(t)) throw std::domain_error(fmt::format("The wave has no value at t = {:g} s.", t));
}

double BurgersWave::profile(double y) const {
  const double length = problem_.upper - problem_.lower;
  if (problem_.periodic) return problem_.velocity(y - length * std::floor((y - problem_.lower) / length));
  return problem_.velocity(std::clamp(y, problem_.lower, problem_.upper));
}

/// The value of U at any node, also outside the table.
double BurgersWave::integralAt(long node) const {
  if (problem_.periodic) {
    const long turns = node >= 0 ? node / kSteps : -((kSteps - 1 - node) / kSteps);
    return static_cast<double>(turns) * integrals_.back() + integrals_[node - turns * kSteps];
  }
  const long inside = std::clamp(node, 0L, kSteps);
  return integrals_[inside] + static_cast<double>(node - inside) * step_ * profile(place(node));
}

long BurgersWave::nodeBelow(double y) const { return static_cast<long>(std::floor((y - problem_.lower) / step_)); }

double BurgersWave::integral(double y) const {
  const long node = nodeBelow(y);
  const double from = place(node);
  double sum = 0;
  for (const auto& point : kGauss5) sum += point.weight * profile(from + point.at * (y - from));
  return integralAt(node) + (y - from) * sum;
}

BurgersWave::Least BurgersWave::leastOfNodes(double x, double t, long first, long last) const {
  Least best{place(first), std::numeric_limits<double>::infinity()};
  for (long k = first; k <= last; ++k) {
    const double away = x - place(k), value = integralAt(k) + away * away / (2 * t);
    if (value < best.value) best = {place(k), value};
  }
  return best;
}

/// Finds the minimum of U(y) + (x-y)²/2t, where y + t u(y) = x. It searches only as far as the profile can have
/// travelled.
BurgersWave::Least BurgersWave::least(double x, double t) const {
  const Least node = leastOfNodes(x, t, nodeBelow(x - greatest_ * t), nodeBelow(x - least_ * t) + 1);
  double lower = node.place - step_, upper = node.place + step_;
  const auto rises = [&](double y) { return profile(y) > (x - y) / t; };
  if (rises(lower) || !rises(upper)) return node;
  while (true) {
    const double middle = 0.5 * (lower + upper);
    if (middle <= lower || middle >= upper) break;
    (rises(middle) ? upper : lower) = middle;
  }
  const double away = x - lower;
  return {lower, integral(lower) + away * away / (2 * t)};
}

/// Computes the sum over the nodes of f(y) exp(-(U(y) + (x-y)²/2t - least) / 2 nu) times the step. It omits the nodes
/// that are so far from the possible origins of the profile that they are negligible: at a distance w from these
/// origins, the exponent is at least w² / (4 nu t).
template <class F>
double BurgersWave::sum(double x, double t, double least, const F& f) const {
  const double width = std::sqrt(4 * kFar * problem_.viscosity * t);
  double total = 0;
  for (long k = nodeBelow(x - greatest_ * t - width), last = nodeBelow(x - least_ * t + width) + 1; k <= last; ++k) {
    const double y = place(k), away = x - y;
    total += f(y) * std::exp(-(integralAt(k) + away * away / (2 * t) - least) / (2 * problem_.viscosity));
  }
  return total * step_;
}

double BurgersWave::potential(double x, double t) const {
  const double viscosity = problem_.viscosity;
  if (t == 0) return integral(x);
  if (viscosity == 0) return least(x, t).value;
  const double value = leastOfNodes(x, t, nodeBelow(x - greatest_ * t), nodeBelow(x - least_ * t) + 1).value;
  const double weight = sum(x, t, value, [](double) { return 1.0; });
  return value - 2 * viscosity * std::log(weight / std::sqrt(4 * M_PI * viscosity * t));
}

double BurgersWave::at(double x, double t) const {
  checkTime(t);
  if (t == 0) return profile(x);
  const Least nearest = least(x, t);
  if (problem_.viscosity == 0) return (x - nearest.place) / t;
  const double weight = sum(x, t, nearest.value, [](double) { return 1.0; });
  return sum(x, t, nearest.value, [&](double y) { return (x - y) / t; }) / weight;
}

double BurgersWave::average(double lower, double upper, double t) const {
  checkTime(t);
  if (!(upper > lower)) return at(lower, t);
  return (potential(upper, t) - potential(lower, t)) / (upper - lower);
}

}  // namespace tushar::burgers
