#include "components/reference/noh.hpp"

#include <cmath>

namespace tushar::reference {

Noh::Noh(const NohProblem& problem) : RadialReference(problem.centre, problem.round), problem_(problem) {
  requireRadialFlow("Noh's problem", problem.density, "speed", problem.speed, problem.pressure, problem.gamma);
  const double gamma = problem.gamma;
  behind_.density = problem.density * std::pow((gamma + 1) / (gamma - 1), dimension());
  behind_.energy = 0.5 * problem.speed * problem.speed;
  behind_.pressure = (gamma - 1) * behind_.density * behind_.energy;
}

RadialState Noh::atRadius(double r, double t) const {
  if (r < shockRadius(t)) return behind_;
  const double squeezed = t > 0 ? std::pow(1 + problem_.speed * t / r, dimension() - 1) : 1;
  RadialState state;
  state.density = problem_.density * squeezed;
  state.velocity = -problem_.speed;
  state.pressure = problem_.pressure > 0 ? problem_.pressure * std::pow(squeezed, problem_.gamma) : 0;
  state.energy = state.pressure / ((problem_.gamma - 1) * state.density);
  return state;
}

}  // namespace tushar::reference
