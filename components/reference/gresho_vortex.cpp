#include "components/reference/gresho_vortex.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace tushar::reference {

GreshoVortex::GreshoVortex(const GreshoProblem& problem) : problem_(problem) {
  problem.requireGas("A Gresho vortex");
  for (int d = 0; d < 3; ++d) {
    const double period = problem.frame.periods[d];
    if (d != problem.axis && period > 0 && period < 4 * problem.radius)
      throw std::invalid_argument(
          fmt::format("A Gresho vortex of radius {:g} m is {:g} m wide and does not fit into a period of {:g} m.",
                      problem.radius, 4 * problem.radius, period));
  }
}

GasState GreshoVortex::at(const Vec3& x, double t) const {
  const int a = (problem_.axis + 1) % 3, b = (problem_.axis + 2) % 3;
  const Vec3 away = problem_.frame.offset(x, t) / problem_.radius;
  const double s = std::hypot(away[a], away[b]);
  double turn = 0;  // velocity around the axis over speed * s
  double rise = 4 * M_LN2 - 2;
  if (s < 1) {
    turn = 1;
    rise = 0.5 * s * s;
  } else if (s < 2) {
    turn = 2 / s - 1;
    rise = 0.5 * s * s + 4 * (std::log(s) + 1 - s);
  }
  GasState gas;
  gas.density = problem_.density;
  gas.velocity = problem_.frame.velocity;
  gas.velocity[a] -= problem_.speed * turn * away[b];
  gas.velocity[b] += problem_.speed * turn * away[a];
  gas.pressure = problem_.pressure + problem_.density * problem_.speed * problem_.speed * rise;
  gas.energy = gas.pressure / ((problem_.gamma - 1) * gas.density);
  return gas;
}

GasState GreshoVortex::average(const Vec3& lower, const Vec3& upper, double t) const {
  Vec3 end = upper;
  end[problem_.axis] = lower[problem_.axis];
  const Vec3 middle = 0.5 * (lower + end);
  const Vec3 centre = middle - problem_.frame.offset(middle, t), round = Vec3::Ones() - Vec3::Unit(problem_.axis);
  const std::vector<Sphere> rings{{centre, problem_.radius, round}, {centre, 2 * problem_.radius, round}};
  return piecewiseMean(*this, rings, lower, end, t);
}

}  // namespace tushar::reference
