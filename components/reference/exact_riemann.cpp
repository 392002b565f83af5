#include "components/reference/exact_riemann.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tushar::reference {

namespace {

double leastStiffnessOf(const RiemannProblem& problem) {
  return std::min(problem.gas.stiffness, problem.rightGas.value_or(problem.gas).stiffness);
}

/// Solves the problem with all pressures increased by the p_inf of the softer gas, which makes that gas ideal; the
/// waves are the same.
RiemannSolution solveShifted(const RiemannProblem& problem) {
  const double shift = leastStiffnessOf(problem);
  const auto shifted = [&](RiemannState state) {
    state.pressure += shift;
    return state;
  };
  const auto softened = [&](GasLaw gas) {
    gas.stiffness -= shift;
    return gas;
  };
  return solveRiemann(shifted(problem.left), shifted(problem.right), softened(problem.gas),
                      softened(problem.rightGas.value_or(problem.gas)));
}

void checkTime(double t) {
  if (!(t >= 0))
    throw std::invalid_argument(fmt::format("A Riemann problem begins at t = 0; there is no solution at t = {}.", t));
}

}  // namespace

ExactRiemann::ExactRiemann(const RiemannProblem& problem) : problem_(problem), solution_(solveShifted(problem)) {
  if (problem.axis < 0 || problem.axis > 2) {
    throw std::invalid_argument(fmt::format("The axis of a Riemann problem must be 0, 1 or 2, not {}.", problem.axis));
  }
  if (!std::isfinite(problem.diaphragm)) {
    throw std::invalid_argument("The diaphragm of a Riemann problem is not at a finite position.");
  }
}

double ExactRiemann::leastStiffness() const { return leastStiffnessOf(problem_); }

GasState ExactRiemann::at(const Vec3& x, double t) const {
  checkTime(t);
  const double distance = x[problem_.axis] - problem_.diaphragm;
  const double infinity = std::numeric_limits<double>::infinity();
  const double xi = t > 0 ? distance / t : (distance < 0 ? -infinity : infinity);
  const RiemannState state = solution_.sample(xi);
  GasState gas;
  gas.density = state.density;
  const bool isLeft = xi < solution_.starVelocity;
  const GasLaw& law = isLeft ? problem_.gas : problem_.rightGas.value_or(problem_.gas);
  gas.pressure = state.pressure - leastStiffness();
  const double heat = (state.pressure + (law.stiffness - leastStiffness())) / (law.gamma - 1) + law.stiffness;
  gas.energy = state.density > 0 ? heat / state.density : 0;
  gas.velocity = isLeft ? problem_.leftTransverse : problem_.rightTransverse;
  gas.velocity[problem_.axis] = state.velocity;
  return gas;
}

GasState ExactRiemann::average(const Vec3& lower, const Vec3& upper, double t) const {
  return averageAlong(problem_.axis, lower, upper, t);
}

std::vector<double> ExactRiemann::breaks(int axis, double t) const {
  checkTime(t);
  if (axis != problem_.axis) return {};
  std::vector<double> positions{solution_.leftWave.head, solution_.leftWave.tail, solution_.starVelocity,
                                solution_.rightWave.tail, solution_.rightWave.head};
  for (double& position : positions) position = problem_.diaphragm + position * t;
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

}  // namespace tushar::reference
