#include "components/reference/exact_riemann.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tushar::reference {

namespace {

/// A stiffened gas as the ideal gas with the same waves.
RiemannState stiffened(RiemannState state, double pInfinity) {
  state.pressure += pInfinity;
  return state;
}

void checkTime(double t) {
  if (!(t >= 0)) throw std::invalid_argument(fmt::format("A Riemann problem begins at t = 0 and has no t = {}.", t));
}

}  // namespace

ExactRiemann::ExactRiemann(const RiemannProblem& problem)
    : problem_(problem),
      solution_(solveRiemann(stiffened(problem.left, problem.pInfinity), stiffened(problem.right, problem.pInfinity),
                             problem.gamma)) {
  if (problem.axis < 0 || problem.axis > 2) {
    throw std::invalid_argument(fmt::format("The axis of a Riemann problem is 0, 1 or 2, not {}.", problem.axis));
  }
  if (!std::isfinite(problem.diaphragm)) {
    throw std::invalid_argument("The diaphragm of a Riemann problem must stand at a finite position.");
  }
}

GasState ExactRiemann::at(const Vec3& x, double t) const {
  checkTime(t);
  const double distance = x[problem_.axis] - problem_.diaphragm;
  const double infinity = std::numeric_limits<double>::infinity();
  const double xi = t > 0 ? distance / t : (distance < 0 ? -infinity : infinity);
  const RiemannState state = solution_.sample(xi);
  GasState gas;
  gas.density = state.density;
  gas.pressure = state.pressure - problem_.pInfinity;
  const double heat = state.pressure / (problem_.gamma - 1) + problem_.pInfinity;
  gas.energy = state.density > 0 ? heat / state.density : 0;
  gas.velocity = xi < solution_.starVelocity ? problem_.leftTransverse : problem_.rightTransverse;
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
