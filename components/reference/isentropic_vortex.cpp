#include "components/reference/isentropic_vortex.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace tushar::reference {

IsentropicVortex::IsentropicVortex(const IsentropicVortexProblem& problem)
    : problem_(problem), temperature_(problem.pressure / problem.density) {
  problem.requireGas("A vortex");
  const double limit = 2 * M_PI * std::sqrt(2 * problem.gamma * temperature_ / ((problem.gamma - 1) * M_E));
  if (!(std::abs(problem.strength) < limit))
    throw std::invalid_argument(
        fmt::format("A vortex of strength {:g} m/s leaves no gas at its centre; the strength must be below {:g} m/s.",
                    problem.strength, limit));
}

GasState IsentropicVortex::at(const Vec3& x, double t) const {
  const double gamma = problem_.gamma;
  const int a = (problem_.axis + 1) % 3, b = (problem_.axis + 2) % 3;
  const Vec3 s = problem_.frame.offset(x, t) / problem_.radius;
  const double f = problem_.strength / (2 * M_PI) * std::exp(0.5 * (1 - s[a] * s[a] - s[b] * s[b]));
  const double ratio = 1 - (gamma - 1) / (2 * gamma) * f * f / temperature_;
  GasState gas;
  gas.density = problem_.density * std::pow(ratio, 1 / (gamma - 1));
  gas.velocity = problem_.frame.velocity;
  gas.velocity[a] -= f * s[b];
  gas.velocity[b] += f * s[a];
  gas.pressure = gas.density * temperature_ * ratio;
  gas.energy = temperature_ * ratio / (gamma - 1);
  return gas;
}

GasState IsentropicVortex::average(const Vec3& lower, const Vec3& upper, double t) const {
  Vec3 end = upper;
  end[problem_.axis] = lower[problem_.axis];
  std::vector<Plane> seams;
  for (int d = 0; d < 3; ++d)
    if (d != problem_.axis)
      for (const Plane& seam : problem_.frame.seams(d, lower, end, t)) seams.push_back(seam);
  return piecewiseMean(*this, seams, lower, end, t);
}

}  // namespace tushar::reference
