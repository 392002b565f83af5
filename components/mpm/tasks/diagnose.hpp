#pragma once

#include "components/mpm/labels.hpp"
#include "components/mpm/materials/gas.hpp"

namespace tushar::mpm {

/// Mass [kg], momentum [kg m/s], kinetic and internal energy [J] of all particles.
template <int D>
void sumTotals(const Patch& patch, const Gas&, ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
               ParticleView<const double> internalEnergyPerMass, Sum& total, VectorSum& momentum, Sum& kinetic,
               Sum& internal, Sum& energy) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double m = 0, ke = 0, ie = 0;
    Vec<D> mv = Vec<D>::Zero();
    for (const int p : mass.in(cell)) {
      m += mass[p];
      mv += mass[p] * velocity[p];
      ke += 0.5 * mass[p] * velocity[p].squaredNorm();
      ie += mass[p] * internalEnergyPerMass[p];
    }
    if (mass.in(cell).empty()) return;
    total.add(m);
    momentum.add(patch.level().expandDirection<D>(mv));
    kinetic.add(ke);
    internal.add(ie);
    energy.add(ke + ie);
  });
}

/// Sum of mass times position [kg m].
template <int D>
void sumCenterOfMass(const Patch& patch, const Gas&, ParticleView<const double> mass, ParticleView<const Vec<D>> x,
                     VectorSum& centre) {
  for (int p = 0; p < mass.owned(); ++p) centre.add(mass[p] * patch.level().expandPoint<D>(x[p]));
}

/// V_p = m_p / rho_p [m³].
inline void computeVolume(const Patch&, const Gas&, ParticleView<const double> mass, ParticleView<const double> density,
                          ParticleView<double> volume) {
  for (int p = 0; p < mass.owned(); ++p) volume[p] = mass[p] / density[p];
}

}  // namespace tushar::mpm
