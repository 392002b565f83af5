#include "components/mpm/conserving/diagnose.hpp"

namespace tushar::mpm::conserving {

void measureCellError(const Patch& patch, const Gas& gas, const reference::GasReference* exact,
                      const reference::Clock* clock, ParticleView<const Vec<1>> x, ParticleView<const double> length,
                      ParticleView<const double> mass, ParticleView<const Vec<1>> velocity,
                      CellView<const double> cellMass, CellView<const double> cellInternalEnergy, Norm& density,
                      Norm& u, Norm& pressure, Norm& energy) {
  const Level& level = patch.level();
  std::vector<double> momentum(patch.cells().size(), 0.0);
  forEach<1>(x.cells(), [&](const Index<1>& cell) {
    for (const int p : x.in(cell)) {
      const Extent extent(level, cell[0], x[p][0], length[p]);
      for (int k = 0; k < extent.cells; ++k)
        if (const Index<1> c{{extent.firstCell + k}}; patch.cells().contains(c))
          momentum[static_cast<std::size_t>(c[0] - patch.cells().lower[0])] +=
              extent.part[static_cast<std::size_t>(k)] * mass[p] * velocity[p][0];
    }
  });
  const double volume = level.cellVolume();
  forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    const double m = cellMass[cell], ie = cellInternalEnergy[cell];
    const auto state = exact->average(level.expandPoint<1>(Vec<1>(level.nodePosition(0, cell[0]))),
                                      level.expandPoint<1>(Vec<1>(level.nodePosition(0, cell[0] + 1))), clock->time);
    const double speed = m > 0 ? momentum[static_cast<std::size_t>(cell[0] - patch.cells().lower[0])] / m : 0;
    density.add(m / volume - state.density);
    u.add((level.expandDirection<1>(Vec<1>(speed)) - state.velocity).norm());
    pressure.add((gas.gamma - 1) * ie / volume - state.pressure);
    energy.add((m > 0 ? ie / m : 0) - state.energy);
  });
}

}  // namespace tushar::mpm::conserving
