#include "components/reference/riemann_solution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace tushar::reference {

namespace {

constexpr double kRoundOff = 2 * std::numeric_limits<double>::epsilon();
constexpr int kMostIterations = 500;

/// One side of the problem, oriented so that its wave runs to the left; the right side is mirrored, u -> -u. The
/// pressure of the side includes the stiffness; pressures passed to its functions do not.
struct Side {
  double density, velocity, pressure, gamma, stiffness;

  Side(const RiemannState& state, double mirror, const GasLaw& gas)
      : density(state.density),
        velocity(mirror * state.velocity),
        pressure(state.pressure + gas.stiffness),
        gamma(gas.gamma),
        stiffness(gas.stiffness) {}

  double soundSpeed() const { return density > 0 ? std::sqrt(gamma * pressure / density) : 0; }
  /// Speed at which the gas expands into vacuum, Toro (4.77).
  double front() const {
    return stiffness > 0 ? velocity - velocityChange(0) : velocity + 2 * soundSpeed() / (gamma - 1);
  }
  /// The exponent (gamma - 1) / (2 gamma): c ~ p^exponent along an isentrope.
  double exponent() const { return (gamma - 1) / (2 * gamma); }
  /// The constants A and B of Toro (4.8).
  double a() const { return 2 / ((gamma + 1) * density); }
  double b() const { return (gamma - 1) / (gamma + 1) * pressure; }

  /// Decrease of the velocity between this side and a state of pressure `outside`, Toro (4.6)-(4.7).
  double velocityChange(double outside) const {
    const double p = outside + stiffness;
    if (p > pressure) return (p - pressure) * std::sqrt(a() / (p + b()));
    if (pressure == 0) return 0;
    return 2 * soundSpeed() / (gamma - 1) * std::expm1(exponent() * std::log(p / pressure));
  }

  /// The derivative of velocityChange with respect to the pressure, Toro (4.37), for p > 0.
  double slope(double outside) const {
    const double p = outside + stiffness;
    if (p > pressure) return std::sqrt(a() / (p + b())) * (1 - 0.5 * (p - pressure) / (p + b()));
    return std::pow(p / pressure, exponent() - 1) * soundSpeed() / (gamma * pressure);
  }

  /// The density between the wave and the contact, Toro (4.50) and (4.53).
  double starDensity(double outside) const {
    const double p = outside + stiffness;
    if (p <= pressure) return pressure > 0 ? density * std::pow(p / pressure, 1 / gamma) : density;
    const double ratio = (gamma - 1) / (gamma + 1);
    return density * (p + ratio * pressure) / (ratio * p + pressure);
  }

  /// The wave to a state of pressure `outside` and velocity `u`, Toro (4.52), (4.54)-(4.55).
  RiemannWave wave(double outside, double u) const {
    const double p = outside + stiffness;
    if (p > pressure) {
      const double speed = velocity - std::sqrt((p + b()) / a()) / density;
      return {WaveKind::shock, speed, speed};
    }
    const double head = velocity - soundSpeed();
    const double starSound = pressure > 0 ? soundSpeed() * std::pow(p / pressure, exponent()) : 0;
    return {WaveKind::rarefaction, head, std::clamp(u - starSound, head, std::max(head, u))};
  }

  RiemannWave waveIntoVacuum() const { return {WaveKind::rarefaction, velocity - soundSpeed(), front()}; }

  /// The state inside the rarefaction, Toro (4.56).
  RiemannState inFan(double xi) const {
    const double sound = soundSpeed();
    const double ratio = 2 / (gamma + 1) * (1 + 0.5 * (gamma - 1) * (velocity - xi) / sound);
    const double u = 2 / (gamma + 1) * (sound + 0.5 * (gamma - 1) * velocity + xi);
    const double relative = std::max(0.0, ratio);
    return {density * std::pow(relative, 2 / (gamma - 1)), u,
            pressure * std::pow(relative, 2 * gamma / (gamma - 1)) - stiffness};
  }
};

RiemannWave mirrored(const RiemannWave& wave) { return {wave.kind, -wave.head, -wave.tail}; }

RiemannState mirrored(const RiemannState& state) { return {state.density, -state.velocity, state.pressure}; }

void checkSide(std::string_view name, const RiemannState& state) {
  const auto fail = [&](std::string_view reason) {
    throw std::invalid_argument(
        fmt::format("The {} side of the Riemann problem (density {}, velocity {}, pressure {}) {}.", name,
                    state.density, state.velocity, state.pressure, reason));
  };
  if (!std::isfinite(state.density) || !std::isfinite(state.velocity) || !std::isfinite(state.pressure)) {
    fail("has a value that is not finite");
  }
  if (state.density < 0) fail("has a negative density");
  if (state.pressure < 0) fail("has a negative pressure");
  if (state.density == 0 && state.pressure > 0) fail("is vacuum and cannot have a pressure");
}

void checkGas(const GasLaw& gas) {
  if (!(gas.gamma > 1) || !std::isfinite(gas.gamma))
    throw std::invalid_argument(
        fmt::format("The gamma of a Riemann problem must be above 1 and finite, not {}.", gas.gamma));
  if (!(gas.stiffness >= 0) || !std::isfinite(gas.stiffness))
    throw std::invalid_argument(fmt::format(
        "The stiffness of a gas in a Riemann problem must be 0 or more and finite, not {}.", gas.stiffness));
}

void checkProblem(const RiemannState& left, const RiemannState& right, const GasLaw& leftGas, const GasLaw& rightGas) {
  checkGas(leftGas);
  checkGas(rightGas);
  checkSide("left", left);
  checkSide("right", right);
  if (left.density == 0 && right.density == 0) {
    throw std::invalid_argument("Both sides of the Riemann problem are vacuum: there is no gas.");
  }
}

/// Solves for the pressure at which both sides have the same velocity, by Newton's method within a bracket.
class StarPressure {
 public:
  StarPressure(const Side& left, const Side& right) : left_(left), right_(right) {}

  double solve() {
    const double least = std::min(left_.pressure - left_.stiffness, right_.pressure - right_.stiffness);
    const double excess = least > 0 ? mismatch(least) : -1;
    if (excess == 0) return least;
    if (excess < 0) return search(least, upperBound());
    return isOneIdealGas() ? betweenRarefactions() : search(0, least);
  }

 private:
  bool isOneIdealGas() const { return left_.gamma == right_.gamma && left_.stiffness == 0 && right_.stiffness == 0; }
  /// The difference of the velocities that both sides have at the pressure p, Toro (4.5); it is increasing and concave
  /// in p.
  double mismatch(double p) const {
    return left_.velocityChange(p) + right_.velocityChange(p) - (right_.velocity + left_.velocity);
  }

  /// The exact pressure between two rarefactions, Toro (4.46).
  double betweenRarefactions() const {
    const double z = left_.exponent();
    const double closing = 0.5 * (left_.gamma - 1) * (left_.velocity + right_.velocity);
    const double cl = left_.soundSpeed();
    const double cr = right_.soundSpeed();
    const double scale = cl + cr * std::pow(left_.pressure / right_.pressure, z);
    return left_.pressure * std::pow((cl + cr + closing) / scale, 1 / z);
  }

  /// An upper bound on p*: the ram pressure of the lighter gas, increased until the two gases stop approaching each
  /// other.
  double upperBound() const {
    const double most = std::max(left_.pressure, right_.pressure);
    const double closing = std::max(0.0, left_.velocity + right_.velocity);
    double p = std::max(most, std::min(left_.density, right_.density) * closing * closing);
    while (mismatch(p) < 0) p *= 4;
    return p;
  }

  double search(double lower, double upper) {
    lower_ = lower;
    upper_ = upper;
    double p = upper_;
    double previousStep = upper_ - lower_;
    for (int i = 0; i < kMostIterations; ++i) {
      const double next = step(p, previousStep);
      previousStep = std::abs(next - p);
      p = next;
      if (previousStep <= kRoundOff * p) break;
    }
    return p;
  }

  /// Newton's step, or the middle of the bracket if Newton's step leaves the bracket or is longer than half of the
  /// previous step.
  double step(double p, double previousStep) {
    const double f = mismatch(p);
    if (f == 0) return p;
    (f < 0 ? lower_ : upper_) = p;
    const double newton = p - f / (left_.slope(p) + right_.slope(p));
    const bool good = newton > lower_ && newton < upper_ && 2 * std::abs(newton - p) <= previousStep;
    const bool settled = std::abs(newton - p) <= kRoundOff * p;
    return good || settled ? newton : middle();
  }

  double middle() const { return lower_ > 0 ? std::sqrt(lower_) * std::sqrt(upper_) : 1e-3 * upper_; }

  Side left_, right_;  // both with their wave running to the left
  double lower_ = 0;
  double upper_ = 0;
};

void fillVacuum(RiemannSolution& s, const Side& left, const Side& right) {
  s.leftWave = left.waveIntoVacuum();
  s.rightWave = mirrored(right.waveIntoVacuum());
  if (left.density == 0) s.leftWave = {WaveKind::rarefaction, s.rightWave.tail, s.rightWave.tail};
  if (right.density == 0) s.rightWave = {WaveKind::rarefaction, s.leftWave.tail, s.leftWave.tail};
  s.starVelocity = 0.5 * (s.leftWave.tail + s.rightWave.tail);
}

void fillStar(RiemannSolution& s, const Side& left, const Side& right) {
  const double p = StarPressure(left, right).solve();
  s.starPressure = p;
  s.starVelocity =
      0.5 * (s.left.velocity + s.right.velocity) + 0.5 * (right.velocityChange(p) - left.velocityChange(p));
  s.starDensityLeft = left.starDensity(p);
  s.starDensityRight = right.starDensity(p);
  s.leftWave = left.wave(p, s.starVelocity);
  s.rightWave = mirrored(right.wave(p, -s.starVelocity));
}

/// The state between the undisturbed gas of a side and the contact, at `xi` as seen from this side.
RiemannState behindHead(const Side& side, const RiemannWave& wave, double xi, const RiemannState& star) {
  const bool fan = side.density > 0 && wave.kind == WaveKind::rarefaction && xi < wave.tail;
  return fan ? side.inFan(xi) : star;
}

}  // namespace

bool RiemannSolution::hasVacuum() const { return starPressure == 0; }

RiemannState RiemannSolution::sample(double xi) const {
  if (xi < leftWave.head && left.density > 0) return left;
  if (xi >= rightWave.head && right.density > 0) return right;
  if (xi < starVelocity) {
    const RiemannState star{starDensityLeft, hasVacuum() ? leftWave.tail : starVelocity, starPressure};
    return behindHead(Side(left, 1, leftGas), leftWave, xi, star);
  }
  const RiemannState star{starDensityRight, hasVacuum() ? -rightWave.tail : -starVelocity, starPressure};
  return mirrored(behindHead(Side(right, -1, rightGas), mirrored(rightWave), -xi, star));
}

RiemannSolution solveRiemann(const RiemannState& left, const RiemannState& right, double gamma) {
  return solveRiemann(left, right, {gamma, 0}, {gamma, 0});
}

RiemannSolution solveRiemann(const RiemannState& left, const RiemannState& right, const GasLaw& leftGas,
                             const GasLaw& rightGas) {
  checkProblem(left, right, leftGas, rightGas);
  RiemannSolution solution;
  solution.left = left;
  solution.right = right;
  solution.leftGas = leftGas;
  solution.rightGas = rightGas;
  const Side leftSide(left, 1, leftGas);
  const Side rightSide(right, -1, rightGas);
  const bool vacuum = left.density == 0 || right.density == 0 || leftSide.front() <= -rightSide.front();
  if (vacuum && (leftGas.gamma != rightGas.gamma || leftGas.stiffness > 0 || rightGas.stiffness > 0))
    throw std::invalid_argument(
        "The two gases separate and leave a vacuum between them: the solution is available only if both have the same "
        "gamma and no stiffness.");
  vacuum ? fillVacuum(solution, leftSide, rightSide) : fillStar(solution, leftSide, rightSide);
  return solution;
}

}  // namespace tushar::reference
