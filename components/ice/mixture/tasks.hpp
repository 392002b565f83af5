#pragma once

#include <fmt/format.h>

#include "components/euler/tasks/advance_mixture.hpp"
#include "components/euler/tasks/check_state.hpp"
#include "components/euler/tasks/diagnose.hpp"
#include "components/euler/tasks/initialize.hpp"
#include "components/ice/mixture/labels.hpp"
#include "components/reference/gas_solution.hpp"

namespace tushar::ice {

using Gases = std::vector<euler::Settings>;

/// The initial state of several gases at a point. Each gas has the state of its last object there, times its volume
/// fraction.
template <int D>
struct MixtureStart {
  euler::State<D> sum{};                                  ///< joint state of all gases
  std::array<double, euler::kMostGases> mass{}, share{};  ///< mass and volume fraction of each gas
  double filled = 0;                                      ///< sum of the volume fractions
  static constexpr double greatestGap = 1e-9;             ///< by which this sum may differ from 1

  static MixtureStart at(const Level& level, const Gases& gases, const Vec3& point) {
    MixtureStart start;
    for (std::size_t k = 0; k < gases.size(); ++k) {
      const double share = euler::shareAt(gases[k], point);
      const bool isThere = share > 0;
      const euler::State<D> state = isThere ? *euler::stateAt<D>(level, gases[k], point) : euler::State<D>{};
      for (std::size_t i = 0; i < state.size(); ++i) start.sum[i] += share * state[i];
      start.share[k] = share;
      start.mass[k] = share * state[euler::kDensity];
      start.filled += std::abs(share);
    }
    return start;
  }
  /// The initial state of a cell: that at its centre or, if surfaces between gases cut it, the mean over the points of
  /// it at which gases fill the space. Cells that bodies cut have the gas at the centre.
  static MixtureStart in(const Level& level, const Gases& gases, const Index<D>& cell) {
    const Vec3 centre = level.expandPoint<D>(level.cellCentre<D>(cell));
    const MixtureStart middle = at(level, gases, centre);
    const Box points = pointsOf(level, gases);
    if (points.size() == 1 || !middle.isFull()) return middle;
    MixtureStart mean;
    int count = 0;
    bool isCut = false;
    forEach<D>(points, [&](const Index<D>& place) {
      Vec<D> x;
      for (int d = 0; d < D; ++d)
        x[d] = level.nodePosition(d, cell[d]) + (place[d] + 0.5) / points.upper[d] * level.spacing(d);
      const Vec3 point = level.expandPoint<D>(x);
      const MixtureStart there = at(level, gases, point);
      if (!there.isFull()) return;
      for (const euler::Settings& gas : gases)
        isCut = isCut || euler::objectAt(gas, point) != euler::objectAt(gas, centre);
      mean.add(there);
      ++count;
    });
    return isCut ? mean.times(1.0 / count) : middle;
  }
  /// The points of a cell at which the regions of gases are found.
  static Box pointsOf(const Level& level, const Gases& gases) {
    Box points{{}, Index3::filled(1)};
    for (const euler::Settings& gas : gases)
      for (const euler::GasObject& one : gas.objects)
        for (int d = 0; d < D; ++d) points.upper[d] = std::max(points.upper[d], one.points[level.axis(d)]);
    return points;
  }
  bool isFull() const { return std::abs(filled - 1) < greatestGap; }
  void add(const MixtureStart& other) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += other.sum[i];
    for (std::size_t k = 0; k < mass.size(); ++k) mass[k] += other.mass[k], share[k] += other.share[k];
    filled += other.filled;
  }
  MixtureStart times(double factor) const {
    MixtureStart scaled = *this;
    for (double& number : scaled.sum) number *= factor;
    for (double& number : scaled.mass) number *= factor;
    for (double& number : scaled.share) number *= factor;
    scaled.filled *= factor;
    return scaled;
  }
  /// Throws InputError unless the volume fractions add up to 1.
  void check(const Gases& gases, const Vec3& point) const {
    if (!isFull())
      throw InputError({{gases.front().where, "MaterialProperties/ICE/material",
                         fmt::format("the gases fill {:.6g} of the cell around ({:g}, {:g}, {:g}): together they must "
                                     "fill the grid; in cells that they share, each needs a <volumeFraction>",
                                     filled, point[0], point[1], point[2])}});
  }
};

/// Sets the initial state of all cells. Throws InputError where euler::initialize does, and where the volume fractions
/// at the centre of a cell do not add up to 1.
template <int D>
void initializeMixture(const Patch& patch, const Gases& gases, const euler::NewState<D>& fresh,
                       const std::vector<euler::NewGas>& held) {
  const Level& level = patch.level();
  if (patch.id() == 0)
    for (const euler::Settings& gas : gases) euler::checkObjects<D>(level, gas);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const Vec3 point = level.expandPoint<D>(level.cellCentre<D>(cell));
    const auto start = MixtureStart<D>::in(level, gases, cell);
    start.check(gases, point);
    for (std::size_t k = 0; k < gases.size(); ++k) {
      held[k].share[cell] = start.share[k];
      held[k].mass[cell] = start.mass[k];
    }
    fresh.density[cell] = start.sum[euler::kDensity];
    for (int d = 0; d < D; ++d) fresh.momentum[cell][d] = start.sum[euler::kVelocity(d)];
    fresh.totalEnergy[cell] = start.sum[euler::kPressure<D>];
  });
}

/// A cell with several gases: rho, the internal energy per volume, and the law of the mixture in it.
struct MixedCell {
  double density = 0, energy = 0;
  euler::MixedGas law;

  template <int D>
  static MixedCell of(const Gases& gases, const euler::OldState<D>& state, const std::vector<euler::OldGas>& held,
                      const Index<D>& cell) {
    const double energy = euler::internalEnergyIn<D, const double>(state, cell);
    return {state.density[cell], energy, euler::lawAt(gases, held, energy, cell)};
  }
  double pressure() const { return law.pressure(density, energy); }
  double soundSpeed() const { return std::sqrt(law.soundSpeedSquared(density, pressure())); }
};

template <int D>
void computeMixedPressure(const Patch& patch, const Gases& gases, const euler::OldState<D>& state,
                          const std::vector<euler::OldGas>& held, CellView<double> pressure) {
  forEach<D>(patch.cells(),
             [&](const Index<D>& cell) { pressure[cell] = MixedCell::of<D>(gases, state, held, cell).pressure(); });
}

template <int D>
void computeMixedSoundSpeed(const Patch& patch, const Gases& gases, const euler::OldState<D>& state,
                            const std::vector<euler::OldGas>& held, CellView<double> soundSpeed) {
  forEach<D>(patch.cells(),
             [&](const Index<D>& cell) { soundSpeed[cell] = MixedCell::of<D>(gases, state, held, cell).soundSpeed(); });
}

template <int D>
void computeMixedMach(const Patch& patch, const Gases& gases, const euler::OldState<D>& state,
                      const std::vector<euler::OldGas>& held, CellView<Vec<D>> mach) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const MixedCell mixed = MixedCell::of<D>(gases, state, held, cell);
    mach[cell] = state.momentum[cell] / (mixed.density * mixed.soundSpeed());
  });
}

/// Computes T [K], which is the same for all gases of a cell: rho e = sum of m_k c_v,k T + z_k p_inf,k.
template <int D>
double temperatureAt(const Gases& gases, const euler::OldState<D>& state, const std::vector<euler::OldGas>& held,
                     const Index<D>& cell) {
  double heat = euler::internalEnergyIn<D, const double>(state, cell), capacity = 0;
  if (gases.front().blend) return euler::blendAt(gases, held, heat, cell).temperature;
  for (std::size_t k = 0; k < gases.size(); ++k) {
    heat -= held[k].share[cell] * gases[k].gas.pInfinity;
    capacity += held[k].mass[cell] * gases[k].gas.specificHeat;
  }
  return heat / capacity;
}

template <int D>
void computeMixedTemperature(const Patch& patch, const Gases& gases, const euler::OldState<D>& state,
                             const std::vector<euler::OldGas>& held, CellView<double> temperature) {
  forEach<D>(patch.cells(),
             [&](const Index<D>& cell) { temperature[cell] = temperatureAt<D>(gases, state, held, cell); });
}

/// Computes the mass of each gas per volume of that gas; 0 where it fills less than a millionth of the cell, which may
/// be round-off.
template <int D>
void computeOwnDensity(const Patch& patch, const Gases&, const std::vector<euler::OldGas>& held,
                       const std::vector<CellView<double>>& density) {
  for (std::size_t k = 0; k < held.size(); ++k)
    forEach<D>(patch.cells(), [&](const Index<D>& cell) {
      density[k][cell] = held[k].share[cell] > 1e-6 ? held[k].mass[cell] / held[k].share[cell] : 0.0;
    });
}

template <int D>
void computeMassFraction(const Patch& patch, const Gases&, CellView<const double> density,
                         const std::vector<euler::OldGas>& held, CellView<double> fraction) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { fraction[cell] = held[1].mass[cell] / density[cell]; });
}

/// Computes the mass of one gas in the patch [kg].
template <int D>
void sumGas(const Patch& patch, const Gases&, std::size_t gas, const std::vector<euler::OldGas>& held, Sum& mass) {
  euler::sumMass<D>(patch, held[gas].mass, mass);
}

/// Computes errors of the cells relative to the exact cell means.
template <int D>
void measureMixedError(const Patch& patch, const Gases& gases, const reference::GasReference* exact,
                       const reference::Clock* clock, const euler::OldState<D>& state,
                       const std::vector<euler::OldGas>& held, const reference::ErrorNorms& errors) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!exact->covers(level.expandPoint<D>(level.cellCentre<D>(cell)), clock->time)) return;
    const MixedCell mixed = MixedCell::of<D>(gases, state, held, cell);
    const Vec<D> velocity = state.momentum[cell] / mixed.density;
    errors.add({.density = mixed.density,
                .velocity = level.expandDirection<D>(velocity),
                .pressure = mixed.pressure(),
                .energy = mixed.energy / mixed.density},
               reference::cellMean<D>(*exact, level, cell, clock->time), level.weight());
  });
}

}  // namespace tushar::ice
