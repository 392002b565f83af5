#pragma once

#include "components/mpm/gas/conserving/batch.hpp"
#include "components/mpm/gas/conserving/box_sums.hpp"
#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/tasks/measure_error.hpp"

namespace tushar::mpm::gas::conserving {

/// A Sum in each lane.
class LanesSum {
 public:
  void mergeInto(Sum& sum) const {
    for (int lane = 0; lane < Lanes::count; ++lane) sum.merge({value_[lane], error_[lane], rest_[lane]});
  }
  void add(Lanes x) {
    data::addExactly(value_, x);
    data::addExactly(error_, x);
    rest_ += x;
  }

 private:
  Lanes value_ = 0, error_ = 0, rest_ = 0;
};

/// Computes the kinetic (including the motion about the mean), internal and total energy of all particles [J].
template <int D>
void sumEnergy(const Patch&, const Gas&, ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
               ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy, Sum& kinetic,
               Sum& internal, Sum& total) {
  LanesSum moving, warm;
  Sum ofMotion, ofHeat;
  int p = 0;
  for (; p + Lanes::count <= mass.owned(); p += Lanes::count) {
    const Lanes m = Lanes::at(&mass[p]);
    const LanesVec<D> v = matrixOf<D, 1>(unpack<D>(velocity[p].data()));
    moving.add(m * (0.5 * v.squaredNorm() + Lanes::at(&affineEnergy[p])));
    warm.add(m * Lanes::at(&internalEnergy[p]));
  }
  for (; p < mass.owned(); ++p) {
    ofMotion.add(mass[p] * (0.5 * velocity[p].squaredNorm() + affineEnergy[p]));
    ofHeat.add(mass[p] * internalEnergy[p]);
  }
  moving.mergeInto(ofMotion);
  warm.mergeInto(ofHeat);
  kinetic.merge(ofMotion);
  internal.merge(ofHeat);
  total.merge(ofMotion);
  total.merge(ofHeat);
}

/// Cross-section of the grid, the product of its extents along the axes that the scene does not use [m^(3-D)].
template <int D>
double crossSection(const Level& level) {
  double area = level.cellVolume();
  for (int d = 0; d < D; ++d) area *= level.inverseSpacing(d);
  return area;
}

/// Computes the volume V of each particle, which is the product of its edges and of the grid's cross-section, the
/// density m / V and the pressure.
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

/// Computes the mean velocity in each cell: the momentum of the parts of particles in it, divided by their mass; 0 in
/// empty cells.
template <int D>
void computeCellVelocity(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> edges,
                         ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
                         ParticleView<const Modes<D>> modes, CellView<const double> cellMass,
                         CellView<Vec<D>> cellVelocity) {
  const CellsOf<D> grid(patch.level());
  const RowsAround<D> around(patch, x.cells(), 0);
  BoxSums<D, D, 0> momentum(around.rows, around.blocks);
  const auto visit = [&](const Batch<D>& batch) {
    const LanesVec<D> centre = load(x, batch), v = load(velocity, batch);
    const LanesModes<D> u = load(modes, batch);
    const Footprint<D> footprint(grid, batch, centre, load(edges, batch));
    const Lanes m = batch.only(load(mass, batch));
    const std::size_t first = momentum.firstOf(footprint);
    footprint.forEachRowOfCells([&](Index<D> k, const Lanes& part) {
      std::array<typename BoxSums<D, D, 0>::Terms, D> terms{};
      for (std::size_t c = 0; k[0] < footprint.along[0].cells; ++k[0], ++c) {
        LanesVec<D> there = v;
        for (std::size_t d = 0; d < D; ++d) {
          const int axis = static_cast<int>(d);
          there += (footprint.along[d].middle(k[axis]) - centre[axis]) * u.col(gradientColumn(axis));
        }
        const Lanes share = part * footprint.along[0].part[c] * m;
        for (std::size_t d = 0; d < D; ++d) terms[d][first + c] = share * there[static_cast<int>(d)];
      }
      momentum.add(footprint, k, [&](std::size_t d) { return terms[d]; });
    });
  };
  const auto finish = [&](const Index<D>& row) {
    forEachPartOfRow<D>(patch.cells(), row, [&](const RowPart<D>& part) {
      const Lanes m = load(cellMass, part), inverse = select(m > 0, 1 / m, 0);
      LanesVec<D> mean;
      for (std::size_t d = 0; d < D; ++d) mean[static_cast<int>(d)] = inverse * momentum.readRow(d, part.first);
      store(mean, cellVelocity, part);
    });
  };
  sumOverBoxes<D>(around, x, visit, finish, momentum);
}

/// Computes the density M_c / V_c [kg/m³].
template <int D>
void computeCellDensity(const Patch& patch, const Gas&, CellView<const double> mass, CellView<double> density) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { density[cell] = mass[cell] / patch.level().cellVolume(); });
}

/// Computes errors relative to exact cell means: of M_c / V_c, of momentum divided by mass, and of the pressure and
/// internal energy that follow from M_c / V_c and IE_c / M_c.
template <int D>
void measureCellError(const Patch& patch, const Gas& gas, const reference::GasReference* exact,
                      const reference::Clock* clock, CellView<const double> mass, CellView<const Vec<D>> velocity,
                      CellView<const double> internalEnergy, const ErrorNorms& errors) {
  const Level& level = patch.level();
  const double volume = level.cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!exact->covers(level.expandPoint<D>(level.cellCentre<D>(cell)), clock->time)) return;
    const double m = mass[cell], ie = internalEnergy[cell];
    errors.add({.density = m / volume,
                .velocity = level.expandDirection<D>(velocity[cell]),
                .pressure = (gas.gamma - 1) * ie / volume - gas.pInfinity,
                .energy = m > 0 ? gas.fullEnergy(m / volume, ie / m) : 0},
               reference::cellMean<D>(*exact, level, cell, clock->time));
  });
}

}  // namespace tushar::mpm::gas::conserving
