#pragma once

#include "components/mpm/labels.hpp"
#include "components/mpm/materials/gas.hpp"

namespace tushar::mpm {

/// Mass [kg], momentum [kg m/s], kinetic and internal energy [J] of all particles.
template <int D>
void sumTotals(const Patch& patch, const Gas&, ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
               ParticleView<const double> internalEnergyPerMass, Sum& total, VectorSum& momentum, Sum& kinetic,
               Sum& internal, Sum& energy) {
  for (int p = 0; p < mass.owned(); ++p) {
    const double m = mass[p], ke = 0.5 * m * velocity[p].squaredNorm(), ie = m * internalEnergyPerMass[p];
    total.add(m);
    momentum.add(patch.level().expandDirection<D>(m * velocity[p]));
    kinetic.add(ke);
    internal.add(ie);
    energy.add(ke);
    energy.add(ie);
  }
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
