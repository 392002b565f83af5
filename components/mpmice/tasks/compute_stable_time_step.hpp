#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpmice/free_space.hpp"

namespace tushar::mpmice {

/// Returns the greatest CrossingRate [1/s] of the gas on the patch, from (|v_d| + c) / h_d along each axis.
/// Throws NumericalError where its density, or p + p_inf, is not positive.
template <int D>
double fastestRate(const Patch& patch, const euler::Gas& gas, const euler::CrossingRate<D>& crossing,
                   const GasInCells<D>& cells) {
  const Level& level = patch.level();
  double most = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    const double free = 1 / cells.free[cell], rho = cells.held.density[cell] * free, inverse = 1 / rho;
    const Vec<D>& m = cells.held.momentum[cell];
    double squared = 0, sum = 0, widths = 0, greatest = 0;
    for (int d = 0; d < D; ++d) {
      squared += (m[d] * free) * (m[d] * free);
      sum += std::abs(m[d] * free) * level.inverseSpacing(d);
      widths += level.inverseSpacing(d);
    }
    const double last = gas.last(rho, cells.held.totalEnergy[cell] * free - 0.5 * squared * inverse);
    if (!(gas.heat(rho, last) > 0)) refuseGas<D>(level, gas, cell, cells.free[cell], rho, last);
    const double c2 = gas.law ? gas.soundSpeedSquared(rho, last) : gas.gamma * (last + gas.pInfinity) * inverse;
    const double sound = std::sqrt(c2);
    for (int d = 0; d < D; ++d)
      greatest = std::max(greatest, (std::abs(m[d] * free) * inverse + sound) * level.inverseSpacing(d));
    most = std::max(most, crossing(sum * inverse + sound * widths, greatest));
  });
  return most;
}

/// Like fastestRate, for a stiffened gas, in vector registers; none if a state is impossible.
template <int D>
std::optional<double> fastestRateInRows(const Patch& patch, const euler::StiffenedGas& gas,
                                        const euler::CrossingRate<D>& crossing, const GasInCells<D>& cells) {
  std::array<double, D> perWidth;
  double widths = 0;
  Lanes::Mask isImpossible{};
  for (int d = 0; d < D; ++d) widths += perWidth[d] = patch.level().inverseSpacing(d);
  const double most = euler::greatestInRows<D>(patch.cells(), [&](const Index<D>& first, int) {
    const double *free = &cells.free[first], *held = &cells.held.density[first];
    const double *energy = &cells.held.totalEnergy[first], *momentum = cells.held.momentum[first].data();
    return [ =, &gas, &isImpossible ](const euler::LanesOfRow& row) __attribute__((always_inline)) {
      const Lanes density = row.at(held), space = row.at(free);
      const Lanes::Mask hasGas = (density > 0) & ~(space < leastFreeVolume);
      const Lanes share = 1 / space, rho = density * share, inverse = 1 / rho;
      std::array<Lanes, D> m = row.template vectorsAt<D>(momentum);
      Lanes squared = 0, sum = 0;
      for (std::size_t d = 0; d < D; ++d) {
        m[d] *= share;
        squared += m[d] * m[d];
        sum += abs(m[d]) * perWidth[d];
      }
      const Lanes stiff = gas.pressure(rho, row.at(energy) * share - 0.5 * squared * inverse) + gas.pInfinity;
      isImpossible |= hasGas & ~(stiff > 0);
      const Lanes sound = sqrt(gas.gamma * stiff * inverse);
      Lanes greatest = 0;
      for (std::size_t d = 0; d < D; ++d) greatest = max(greatest, (abs(m[d]) * inverse + sound) * perWidth[d]);
      return select(hasGas, crossing(sum * inverse + sound * widths, greatest), 0);
    };
  });
  return !any(isImpossible) ? std::optional(most) : std::nullopt;
}

/// Computes dt = cfl / r, where r is the greatest CrossingRate of the gas from (|v_d| + c) / h_d along each axis.
/// Throws NumericalError where its density, or p + p_inf, is not positive.
template <int D>
void computeStableTimeStep(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, Minimum& dt) {
  const euler::Gas& gas = settings.gas.gas;
  const euler::CrossingRate<D> crossing(settings.gas.courant);
  std::optional<double> rate;
  if (!gas.law) rate = fastestRateInRows<D>(patch, euler::lawOf<euler::StiffenedGas>(gas), crossing, cells);
  const double most = rate ? *rate : fastestRate<D>(patch, gas, crossing, cells);
  if (most > 0) dt.add(settings.gas.courant.number / most, "CFL");
}

/// Computes the stable time step of several gases, like computeStableTimeStep.
template <int D>
void limitStepOfGases(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, Minimum& dt) {
  const Level& level = patch.level();
  const euler::CrossingRate<D> crossing(settings.gas.courant);
  double most = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    const euler::Gas gas = lawAt<D>(settings, cells.held, cells.free[cell], cell);
    const euler::State<D> w = cells.primitive(gas, cell);
    const double rho = w[euler::kDensity], p = w[euler::kPressure<D>];
    if (!(gas.heat(rho, p) > 0)) refuseGas<D>(level, gas, cell, cells.free[cell], rho, p);
    const double c = std::sqrt(gas.soundSpeedSquared(rho, p));
    const double rate =
        crossing.ofAxes([&](int d) { return (std::abs(w[euler::kVelocity(d)]) + c) * level.inverseSpacing(d); });
    most = std::max(most, rate);
  });
  if (most > 0) dt.add(settings.gas.courant.number / most, "CFL");
}

/// Computes dt = cfl times the time in which the fastest wave of a body crosses a cell. This limit is needed because
/// bodies move only once per step of the gas.
inline void limitStepOfBodies(const Patch&, double cfl, double stableTimeStep, Minimum& dt) {
  dt.add(cfl * stableTimeStep, "wave speed of bodies");
}

/// The greatest density of the gas itself on the patch; 0 without gas.
template <int D>
double densestGas(const Patch& patch, const GasInCells<D>& cells) {
  return euler::greatestInRows<D>(patch.cells(), [&](const Index<D>& first, int) {
    const double *free = &cells.free[first], *held = &cells.held.density[first];
    return [=](const euler::LanesOfRow& row) {
      const Lanes space = row.at(free);
      return select(space < leastFreeVolume, 0, row.at(held) / space);
    };
  });
}

/// Computes dt = (rho_b / rho) h / c where gas of the density rho is beside bodies, of which the lightest has the
/// density rho_b. In a step, the pressure of the gas, which rises by rho c per unit of the speed at which a wall
/// approaches, must not turn the motion of the wall around. Only bodies lighter than cfl rho get shorter steps.
/// (Measured: a layer of foam in water is stable up to a dt between 2 and 2.7 times as long, a disc up to 2.5 to 3.3
/// times.)
template <int D>
void limitStepOfLightBodies(const Patch& patch, const std::vector<mpm::solid::Material>& materials,
                            const Settings& settings, const GasInCells<D>& cells, Minimum& dt) {
  double lightest = std::numeric_limits<double>::infinity();
  for (const mpm::solid::Material& material : materials) lightest = std::min(lightest, material.density);
  if (settings.gas.courant.number * densestGas<D>(patch, cells) <= lightest) return;
  const Level& level = patch.level();
  const auto isPartlyFull = [&](const Index<D>& cell) {
    return cells.free[nearestOnGrid(level, cell)] < wholeFreeVolume;
  };
  double perWidth = 0, most = 0;
  for (int d = 0; d < D; ++d) perWidth = std::max(perWidth, level.inverseSpacing(d));
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    bool isBeside = isPartlyFull(cell);
    for (int d = 0; d < D && !isBeside; ++d)
      isBeside = isPartlyFull(cell - Index<D>::unit(d)) || isPartlyFull(cell + Index<D>::unit(d));
    if (!isBeside) return;
    const euler::Gas law = lawAt<D>(settings, cells.held, cells.free[cell], cell);
    const euler::State<D> w = cells.primitive(law, cell);
    const double rho = w[euler::kDensity];
    most = std::max(most, rho * std::sqrt(law.soundSpeedSquared(rho, w[euler::kPressure<D>])) * perWidth);
  });
  if (most > 0) dt.add(lightest / most, "light bodies");
}

/// Computes dt for bodies that keep their velocities: cfl times the shorter of the time in which the fastest particle
/// crosses a cell, and 1 / (2 a sum_d 1/h_d²), up to which explicit conduction of heat with the diffusivity a is
/// stable. There are no waves in such bodies.
template <int D>
void limitStepOfRigidBodies(const Patch& patch, const mpm::solid::Material& material, double cfl,
                            ParticleView<const Vec<D>> velocity, Minimum& dt) {
  const Level& level = patch.level();
  double fastest = 0, squares = 0;
  for (int d = 0; d < D; ++d) {
    const double perWidth = level.inverseSpacing(d);
    squares += perWidth * perWidth;
    for (int p = 0; p < velocity.owned(); ++p) fastest = std::max(fastest, std::abs(velocity[p][d]) * perWidth);
  }
  if (fastest > 0) dt.add(cfl / fastest, "speed of bodies");
  if (velocity.owned() == 0 || !(material.thermalConductivity > 0)) return;
  const double diffusivity = material.thermalConductivity / (material.density * material.specificHeat);
  dt.add(cfl / (2 * diffusivity * squares), "conduction in bodies");
}

}  // namespace tushar::mpmice
