#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// Computes dt = cfl / max(sum_d (|v_d| + c) / h_d) of the gas.
/// Throws NumericalError where its density, or p + p_inf, is not positive.
template <int D>
void computeStableTimeStep(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, Minimum& dt) {
  const euler::Gas& gas = settings.gas.gas;
  const Level& level = patch.level();
  double widths = 0, most = 0;
  for (int d = 0; d < D; ++d) widths += level.inverseSpacing(d);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    const double free = 1 / cells.free[cell], rho = cells.held.density[cell] * free, inverse = 1 / rho;
    const Vec<D>& m = cells.held.momentum[cell];
    double squared = 0, sum = 0;
    for (int d = 0; d < D; ++d) {
      squared += (m[d] * free) * (m[d] * free);
      sum += std::abs(m[d] * free) * level.inverseSpacing(d);
    }
    const double last = gas.last(rho, cells.held.totalEnergy[cell] * free - 0.5 * squared * inverse);
    if (!(gas.heat(rho, last) > 0)) refuseGas<D>(level, gas, cell, cells.free[cell], rho, last);
    const double c2 = gas.law ? gas.soundSpeedSquared(rho, last) : gas.gamma * (last + gas.pInfinity) * inverse;
    const double rate = sum * inverse + std::sqrt(c2) * widths;
    most = rate > most ? rate : most;
  });
  if (most > 0) dt.add(settings.gas.cfl / most, "CFL");
}

/// Computes the stable time step of several gases, like computeStableTimeStep.
template <int D>
void limitStepOfGases(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, Minimum& dt) {
  const Level& level = patch.level();
  double most = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    const euler::Gas gas = lawAt<D>(settings, cells.held, cells.free[cell], cell);
    const euler::State<D> w = cells.primitive(gas, cell);
    const double rho = w[euler::kDensity], p = w[euler::kPressure<D>];
    if (!(gas.heat(rho, p) > 0)) refuseGas<D>(level, gas, cell, cells.free[cell], rho, p);
    const double c = std::sqrt(gas.soundSpeedSquared(rho, p));
    double rate = 0;
    for (int d = 0; d < D; ++d) rate += (std::abs(w[euler::kVelocity(d)]) + c) * level.inverseSpacing(d);
    most = std::max(most, rate);
  });
  if (most > 0) dt.add(settings.gas.cfl / most, "CFL");
}

/// Computes dt = cfl times the time in which the fastest wave of a body crosses a cell. This limit is needed because
/// bodies move only once per step of the gas.
inline void limitStepOfBodies(const Patch&, double cfl, double stableTimeStep, Minimum& dt) {
  dt.add(cfl * stableTimeStep, "wave speed of bodies");
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
