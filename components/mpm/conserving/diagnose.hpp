#pragma once

#include "components/mpm/conserving/footprint.hpp"
#include "components/mpm/conserving/labels.hpp"
#include "components/mpm/materials/gas.hpp"
#include "components/reference/gas_solution.hpp"

namespace tushar::mpm::conserving {

/// Kinetic (the motion about the mean included), internal and total energy of all particles [J].
template <int D>
void sumEnergy(const Patch& patch, const Gas&, ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
               ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy, Sum& kinetic,
               Sum& internal, Sum& total) {
  WideSum kineticSum(kinetic), internalSum(internal), totalSum(total);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
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

/// Cross-section of the grid: the extent along the axes that the scene leaves out, m^(3-D).
template <int D>
double crossSection(const Level& level) {
  double area = level.cellVolume();
  for (int d = 0; d < D; ++d) area *= level.inverseSpacing(d);
  return area;
}

/// V = the product of the edges and the cross-section of the grid, rho = m / V, p = (gamma - 1) rho e.
template <int D>
void computeDensity(const Patch& patch, const Gas& gas, ParticleView<const double> mass,
                    ParticleView<const Vec<D>> edges, ParticleView<const double> internalEnergy,
                    ParticleView<double> density, ParticleView<double> pressure, ParticleView<double> volume) {
  const double area = crossSection<D>(patch.level());
  for (int p = 0; p < mass.owned(); ++p) {
    volume[p] = edges[p].prod() * area;
    density[p] = mass[p] / volume[p];
    pressure[p] = gas.pressure(density[p], internalEnergy[p]);
  }
}

/// Momentum over mass of the parts of particles in each cell; 0 where there are none.
template <int D>
void computeCellVelocity(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> edges,
                         ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
                         ParticleView<const Modes<D>> modes, CellView<const double> cellMass,
                         CellView<Vec<D>> cellVelocity) {
  const Level& level = patch.level();
  cellVelocity.fill(Vec<D>::Zero());
  forEach<D>(x.cells(), [&](const Index<D>& cell) {
    for (const int p : x.in(cell)) {
      const Footprint<D> footprint(level, cell, x[p], edges[p]);
      footprint.forEachCell(patch.cells(), [&](const Index<D>& c, double part) {
        Vec<D> u = velocity[p];
        for (int d = 0; d < D; ++d) {
          const auto& span = footprint.along[static_cast<std::size_t>(d)];
          const double lower = std::max(span.lower, level.nodePosition(d, c[d]));
          const double upper = std::min(span.upper, level.nodePosition(d, c[d] + 1));
          u += (0.5 * (lower + upper) - x[p][d]) * modes[p].col(gradientColumn(d));
        }
        cellVelocity[c] += part * mass[p] * u;
      });
    }
  });
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cellMass[cell] > 0) cellVelocity[cell] /= cellMass[cell];
  });
}

/// M_c / V_c [kg/m³].
template <int D>
void computeCellDensity(const Patch& patch, const Gas&, CellView<const double> mass, CellView<double> density) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { density[cell] = mass[cell] / patch.level().cellVolume(); });
}

/// Errors of M_c / V_c, momentum over mass, (gamma - 1) IE_c / V_c and IE_c / M_c against exact cell means.
template <int D>
void measureCellError(const Patch& patch, const Gas& gas, const reference::GasReference* exact,
                      const reference::Clock* clock, CellView<const double> mass, CellView<const Vec<D>> velocity,
                      CellView<const double> internalEnergy, Norm& density, Norm& u, Norm& pressure, Norm& energy) {
  const Level& level = patch.level();
  const double volume = level.cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!exact->covers(level.expandPoint<D>(level.cellCentre<D>(cell)), clock->time)) return;
    const double m = mass[cell], ie = internalEnergy[cell];
    Vec<D> lower, upper;
    for (int d = 0; d < D; ++d) {
      lower[d] = level.nodePosition(d, cell[d]);
      upper[d] = level.nodePosition(d, cell[d] + 1);
    }
    const auto state = exact->average(level.expandPoint<D>(lower), level.expandPoint<D>(upper), clock->time);
    density.add(m / volume - state.density);
    u.add((level.expandDirection<D>(velocity[cell]) - state.velocity).norm());
    pressure.add((gas.gamma - 1) * ie / volume - state.pressure);
    energy.add((m > 0 ? ie / m : 0) - state.energy);
  });
}

}  // namespace tushar::mpm::conserving
