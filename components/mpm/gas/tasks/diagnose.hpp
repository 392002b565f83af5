#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"

namespace tushar::mpm::gas {

/// Computes the mass of all particles [kg].
template <int D>
void sumMass(const Patch& patch, const Gas&, ParticleView<const double> mass, Sum& total) {
  WideSum sum(total);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double m = 0;
    for (const int p : mass.in(cell)) m += mass[p];
    sum.add(m);
  });
}

/// Computes the momentum of all particles [kg m/s].
template <int D>
void sumMomentum(const Patch& patch, const Gas&, ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
                 VectorSum& total) {
  WideSum x(total.x), y(total.y), z(total.z);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    Vec<D> momentum = Vec<D>::Zero();
    for (const int p : mass.in(cell)) momentum += mass[p] * velocity[p];
    const Vec3 wide = patch.level().expandDirection<D>(momentum);
    x.add(wide[0]);
    y.add(wide[1]);
    z.add(wide[2]);
  });
}

/// Computes the kinetic, internal and total energy of all particles [J].
template <int D>
void sumEnergy(const Patch& patch, const Gas&, ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
               ParticleView<const double> internalEnergy, Sum& kinetic, Sum& internal, Sum& total) {
  WideSum kineticSum(kinetic), internalSum(internal), totalSum(total);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double ke = 0, ie = 0;
    for (const int p : mass.in(cell)) {
      ke += 0.5 * mass[p] * velocity[p].squaredNorm();
      ie += mass[p] * internalEnergy[p];
    }
    kineticSum.add(ke);
    internalSum.add(ie);
    totalSum.add(ke + ie);
  });
}

/// Computes the sum of mass times position [kg m].
template <int D>
void sumCenterOfMass(const Patch& patch, const Gas&, ParticleView<const double> mass, ParticleView<const Vec<D>> x,
                     VectorSum& centre) {
  for (int p = 0; p < mass.owned(); ++p) centre.add(mass[p] * patch.level().expandPoint<D>(x[p]));
}

/// Computes the smallest density [kg/m³] and internal energy [J/kg] of any particle.
inline void findLeast(const Patch&, const Gas&, ParticleView<const double> density,
                      ParticleView<const double> internalEnergy, Minimum& leastDensity, Minimum& leastEnergy) {
  for (int p = 0; p < density.owned(); ++p) {
    leastDensity.add(density[p]);
    leastEnergy.add(internalEnergy[p]);
  }
}

/// Computes the sum of m (ln epsilon - (gamma - 1) ln rho) [kg]: entropy over c_v, up to a constant that depends on
/// units.
template <int D>
void sumEntropy(const Patch& patch, const Gas& gas, ParticleView<const double> mass, ParticleView<const double> density,
                ParticleView<const double> internalEnergy, Sum& entropy) {
  WideSum sum(entropy);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double s = 0;
    for (const int p : mass.in(cell))
      s += mass[p] * (std::log(gas.heat(density[p], internalEnergy[p])) - (gas.gamma - 1) * std::log(density[p]));
    sum.add(s);
  });
}

/// Computes V_p = m_p / rho_p [m³].
inline void computeVolume(const Patch&, const Gas&, ParticleView<const double> mass, ParticleView<const double> density,
                          ParticleView<double> volume) {
  for (int p = 0; p < mass.owned(); ++p) volume[p] = mass[p] / density[p];
}

}  // namespace tushar::mpm::gas
