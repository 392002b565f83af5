#pragma once

#include "components/mpm/conserving/extent.hpp"
#include "components/mpm/conserving/labels.hpp"
#include "components/mpm/materials/gas.hpp"
#include "components/reference/gas_solution.hpp"

namespace tushar::mpm::conserving {

/// Cells beyond a patch whose particles reach its nodes.
inline constexpr int reach = Extent::reach;

/// Kinetic (the motion about the mean included), internal and total energy of all particles [J].
inline void sumEnergy(const Patch& patch, const Gas&, ParticleView<const double> mass,
                      ParticleView<const Vec<1>> velocity, ParticleView<const double> internalEnergy,
                      ParticleView<const double> affineEnergy, Sum& kinetic, Sum& internal, Sum& total) {
  WideSum kineticSum(kinetic), internalSum(internal), totalSum(total);
  forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    double ke = 0, ie = 0;
    for (const int p : mass.in(cell)) {
      ke += mass[p] * (0.5 * velocity[p].squaredNorm() + affineEnergy[p]);
      ie += mass[p] * internalEnergy[p];
    }
    kineticSum.add(ke);
    internalSum.add(ie);
    totalSum.add(ke + ie);
  });
}

/// V = L A with A the cross-section of the grid, rho = m / V, p = (gamma - 1) rho e.
inline void computeDensity(const Patch& patch, const Gas& gas, ParticleView<const double> mass,
                           ParticleView<const double> length, ParticleView<const double> internalEnergy,
                           ParticleView<double> density, ParticleView<double> pressure, ParticleView<double> volume) {
  const double area = patch.level().cellVolume() / patch.level().spacing(0);
  for (int p = 0; p < mass.owned(); ++p) {
    volume[p] = length[p] * area;
    density[p] = mass[p] / volume[p];
    pressure[p] = gas.pressure(density[p], internalEnergy[p]);
  }
}

/// Errors of M_c / V_c, momentum over mass, (gamma - 1) IE_c / V_c and IE_c / M_c against exact cell means.
void measureCellError(const Patch& patch, const Gas& gas, const reference::GasReference* exact,
                      const reference::Clock* clock, ParticleView<const Vec<1>> x, ParticleView<const double> length,
                      ParticleView<const double> mass, ParticleView<const Vec<1>> velocity,
                      CellView<const double> cellMass, CellView<const double> cellInternalEnergy, Norm& density,
                      Norm& u, Norm& pressure, Norm& energy);

}  // namespace tushar::mpm::conserving
