#include "components/reference/radial_reference.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "components/reference/piecewise_mean.hpp"

namespace tushar::reference {

RadialReference::RadialReference(const Vec3& centre, const Vec3& round) : centre_(centre), round_(round) {
  const bool known = ((round.array() == 0) || (round.array() == 1)).all();
  if (!known || round.sum() == 0)
    throw std::invalid_argument(
        fmt::format("The axes of a radial flow must be 0 or 1, not [{}, {}, {}].", round[0], round[1], round[2]));
}

GasState RadialReference::at(const Vec3& x, double t) const {
  if (!(t >= 0)) throw std::invalid_argument(fmt::format("A flow that begins at t = 0 has no solution at t = {}.", t));
  const Vec3 away = (x - centre_).cwiseProduct(round_);
  const double r = away.norm();
  const RadialState state = atRadius(r, t);
  const Vec3 outwards = r > 0 ? Vec3(away / r) : Vec3(Vec3::Zero());
  return {state.density, state.velocity * outwards, state.pressure, state.energy};
}

GasState RadialReference::average(const Vec3& lower, const Vec3& upper, double t) const {
  const Vec3 end = lower + (upper - lower).cwiseProduct(round_);
  return piecewiseMean(*this, std::vector{Sphere{centre_, shockRadius(t), round_}}, lower, end, t);
}

void requireRadialFlow(const char* problem, double density, const char* amount, double value, double pressure,
                       double gamma) {
  if (density > 0 && value > 0 && pressure >= 0 && gamma > 1) return;
  throw std::invalid_argument(fmt::format(
      "{} needs a positive density and {}, a pressure of at least 0 and a gamma above 1, but has {}, {}, {} and {}.",
      problem, amount, density, value, pressure, gamma));
}

}  // namespace tushar::reference
