#pragma once

#include "components/mpm/gas/conserving/cells.hpp"
#include "components/mpm/gas/conserving/diagnose.hpp"
#include "components/mpm/gas/conserving/stable_time_step.hpp"

namespace tushar::mpm::gas::conserving {

/// One view for each gas.
template <class T>
using CellViews = std::vector<CellView<T>>;
template <class T>
using NodeViews = std::vector<NodeView<T>>;

/// Several gases in a cell, which share pressure, velocity and compression; each has a volume fraction alpha. With G =
/// sum of alpha / (gamma - 1) and S = sum of alpha gamma p_inf / (gamma - 1), their energy per volume is p G + S. So
/// the pressure stays uniform across a contact discontinuity, at rest or in motion, and rho c² = (p (1 + G) + S) / G.
/// Sources: G. Allaire, S. Clerc & S. Kokh, J. Comput. Phys. 181 (2002) 577; for the use of G and S alone: R. Abgrall,
/// J. Comput. Phys. 125 (1996) 150.
struct Mixture {
  double density = 0;    ///< density [kg/m³]
  double energy = 0;     ///< internal energy per volume [J/m³]
  double softness = 0;   ///< G
  double stiffness = 0;  ///< stiffness S [J/m³]

  double pressure() const { return (energy - stiffness) / softness; }
  double soundSpeedSquared() const { return (pressure() * (1 + softness) + stiffness) / (softness * density); }
  /// Internal energy of a gas at this pressure, per volume of the gas [J/m³].
  static double energyAt(double pressure, const Gas& gas) {
    return (pressure + gas.gamma * gas.pInfinity) / (gas.gamma - 1);
  }
};

/// The fields of one gas in the cells of a patch.
struct GasInCells {
  CellView<const double> mass;            ///< mass of the gas in each cell [kg]
  CellView<const double> internalEnergy;  ///< internal energy of the gas in each cell [J]
  CellView<const double> fill;            ///< fraction of each cell's volume that the gas occupies

  /// Declares that a task reads these fields; `read` is requiresOld or requiresNew, as a function of a label.
  static GasInCells from(auto& take, const auto& read) {
    return {.mass = take(read(c::mass)), .internalEnergy = take(read(c::internalEnergy)), .fill = take(read(c::fill))};
  }
};

/// Views of all gases in the cells of a patch.
struct Cells {
  const std::vector<Gas>& gases;
  const std::vector<GasInCells>& held;  ///< views of each gas

  /// Volume of one gas divided by the volume of all gases in the cell.
  template <class Index>
  double share(std::size_t gas, const Index& cell) const {
    double all = 0;
    for (const GasInCells& one : held) all += one.fill[cell];
    return held[gas].fill[cell] / all;
  }
  template <class Index>
  Mixture at(const Index& cell, double volume) const {
    Mixture mixture;
    for (std::size_t k = 0; k < gases.size(); ++k) {
      const double alpha = share(k, cell), softness = alpha / (gases[k].gamma - 1);
      mixture.density += held[k].mass[cell] / volume;
      mixture.energy += held[k].internalEnergy[cell] / volume;
      mixture.softness += softness;
      mixture.stiffness += softness * gases[k].gamma * gases[k].pInfinity;
    }
    return mixture;
  }
  /// Whether there is more than one gas in a cell.
  template <class Index>
  bool isMixed(const Index& cell) const {
    return std::count_if(held.begin(), held.end(), [&](const GasInCells& one) { return one.mass[cell] > 0; }) > 1;
  }
};

/// Computes epsilon = e - p_inf / rho of each particle, with rho = m / V of its box. It is negative at pressures below
/// -p_inf, at which the gas ruptures.
template <int D>
void computeHeat(const Patch& patch, const Gas& gas, ParticleView<const double> mass, ParticleView<const Vec<D>> edges,
                 ParticleView<const double> internalEnergy, ParticleView<double> heat) {
  const double area = crossSection<D>(patch.level());
  for (int p = 0; p < mass.owned(); ++p) heat[p] = gas.heat(mass[p] / (edges[p].prod() * area), internalEnergy[p]);
}

/// Makes all gases move with one velocity: m_i = sum over the gases, v_i = sum m v / m_i, assigned to each gas.
template <int D>
void mixAtNodes(const Patch&, const std::vector<Gas>& gases, const NodeViews<double>& mass,
                const NodeViews<Vec<D>>& velocity) {
  forEach<D>(mass.front().box(), [&](const Index<D>& node) {
    double m = 0;
    Vec<D> momentum = Vec<D>::Zero();
    for (std::size_t k = 0; k < gases.size(); ++k) {
      m += mass[k][node];
      momentum += mass[k][node] * velocity[k][node];
    }
    const Vec<D> common = m > 0 ? Vec<D>(momentum / m) : Vec<D>::Zero();
    for (std::size_t k = 0; k < gases.size(); ++k) {
      mass[k][node] = m;
      velocity[k][node] = common;
    }
  });
}

/// Throws InputError if the gases leave a part of a cell empty at the start, or overlap, because the pressure of a
/// mixture acts on the whole grid.
template <int D>
void checkFill(const Patch& patch, const std::vector<Gas>& gases, const CellViews<double>& fill) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double all = 0;
    for (const CellView<double>& one : fill) all += one[cell];
    if (std::abs(all - 1) < 1e-9) return;
    const Vec3 middle = patch.level().template expandPoint<D>(patch.level().template cellCentre<D>(cell));
    throw InputError(
        {{gases.front().where, "MaterialProperties/MPM/material",
          fmt::format("several gases must fill the grid without overlap, but they fill {:.6g} of the cell around "
                      "({:g}, {:g}, {:g})",
                      all, middle[0], middle[1], middle[2])}});
  });
}

/// Assigns p of the mixture and q by shockViscosity to each gas, and 1 to the sensor of shocks.
template <int D>
void computeMixturePressure(const Patch& patch, const std::vector<Gas>& gases, const Viscosity& viscosity,
                            const std::vector<GasInCells>& held, const CellViews<const Tensor<D>>& gradient,
                            const CellViews<double>& pressure, const CellViews<double>& artificial,
                            const CellViews<double>& shock) {
  const Level& level = patch.level();
  const Cells cells{gases, held};
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const Mixture mixture = cells.at(cell, level.cellVolume());
    const double difference = level.minSpacing() * gradient.front()[cell].trace();
    const CellState state = shockViscosity(mixture.pressure(), mixture.density, std::sqrt(mixture.soundSpeedSquared()),
                                           difference, viscosity);
    for (std::size_t k = 0; k < gases.size(); ++k) {
      pressure[k][cell] = state.pressure[0];
      artificial[k][cell] = state.viscosity[0];
      shock[k][cell] = state.shock[0];
    }
  });
}

/// Distributes the work done on a cell [J] over the gases in it, as the relative change of each gas's internal energy.
template <class Index>
class SharedWork {
 public:
  SharedWork(const Cells& cells, const Index& cell, double volume, double done)
      : cells_(cells), cell_(cell), volume_(volume), done_(done), after_(cells.at(cell, volume)) {
    after_.energy += done / volume;
    if (!cells.isMixed(cell)) return;
    equalised_ = 1;
    for (std::size_t k = 0; k < cells.gases.size(); ++k)
      if (energyOf(k) > 0 && atEqualPressure(k) < -0.5)
        equalised_ = std::min(equalised_, std::max(0.0, (byVolume(k) + 0.5) / (byVolume(k) - atEqualPressure(k))));
  }
  double operator()(std::size_t gas) const {
    if (!(energyOf(gas) > 0)) return 0;
    if (equalised_ == 0) return byVolume(gas);
    return byVolume(gas) + equalised_ * (atEqualPressure(gas) - byVolume(gas));
  }

 private:
  double energyOf(std::size_t gas) const { return cells_.held[gas].internalEnergy[cell_]; }
  double byVolume(std::size_t gas) const { return cells_.share(gas, cell_) * done_ / energyOf(gas); }
  double atEqualPressure(std::size_t gas) const {
    const double goal = cells_.share(gas, cell_) * volume_ * Mixture::energyAt(after_.pressure(), cells_.gases[gas]);
    return goal / energyOf(gas) - 1;
  }

  const Cells& cells_;
  const Index& cell_;
  double volume_, done_;
  Mixture after_;
  double equalised_ = 0;  ///< 0: distribution by volume; 1: at equal pressure
};

/// Computes f of each gas in a cell, for updateParticles. Several gases in a cell then have the pressure p' of the
/// mixture:
/// IE_k (1 + f_k) = alpha_k V (p' + gamma_k p_inf,k) / (gamma_k - 1), whose sum is IE + W. Where one gas would lose
/// more than half of its energy, the gases share the work by volume, and approach p' only until one has lost half.
template <int D>
void computeMixtureWork(const Patch& patch, const std::vector<Gas>& gases, const CellViews<const Tensor<D>>& stress,
                        const std::vector<GasInCells>& held, const NodeViews<const Vec<D>>& velocity,
                        const NodeViews<const Vec<D>>& acceleration, double dt, const CellViews<double>& work) {
  const Level& level = patch.level();
  const Cells cells{gases, held};
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double done = workOnCell<D>(level, stress.front()[cell], velocity.front(), acceleration.front(), dt, cell);
    const SharedWork shared(cells, cell, level.cellVolume(), done);
    for (std::size_t k = 0; k < gases.size(); ++k) work[k][cell] = shared(k);
  });
}

/// Computes the largest speeds of signals in a mixture [m/s], as measureSignals does in one gas: |v| + c with the
/// velocities of the nodes, and the speed relative to the gas.
template <int D>
void measureMixtureSignals(const Patch& patch, const std::vector<Gas>& gases, const std::vector<GasInCells>& held,
                           const CellViews<const Tensor<D>>& gradient, const NodeViews<const Vec<D>>& velocity,
                           Maximum& pastGrid, Maximum& pastGas) {
  const Cells cells{gases, held};
  double onGrid = 0, inGas = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double cSquared = cells.at(cell, patch.level().cellVolume()).soundSpeedSquared();
    double fastest = 0;
    for (int k = 0; k < Linear<D>::nodes; ++k)
      fastest = std::max(fastest, velocity.front()[Linear<D>::node(cell, k)].norm());
    onGrid = std::max(onGrid, fastest + std::sqrt(cSquared));
    inGas = std::max(inGas, signalInCells(patch.level(), gradient.front()[cell].trace(), cSquared)[0]);
  });
  pastGrid.add(onGrid);
  pastGas.add(inGas);
}

/// Computes errors of the cell means, relative to exact means: density, velocity (momentum over mass), pressure and
/// internal energy of the mixture.
template <int D>
void measureMixtureError(const Patch& patch, const std::vector<Gas>& gases, const reference::GasReference* exact,
                         const reference::Clock* clock, const std::vector<GasInCells>& held,
                         const CellViews<const Vec<D>>& velocity, Norm& density, Norm& u, Norm& pressure,
                         Norm& energy) {
  const Level& level = patch.level();
  const Cells cells{gases, held};
  const ErrorNorms errors{.density = density, .velocity = u, .pressure = pressure, .energy = energy};
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!exact->covers(level.expandPoint<D>(level.cellCentre<D>(cell)), clock->time)) return;
    const Mixture mixture = cells.at(cell, level.cellVolume());
    Vec<D> momentum = Vec<D>::Zero();
    for (std::size_t k = 0; k < gases.size(); ++k)
      momentum += held[k].mass[cell] / level.cellVolume() * velocity[k][cell];
    errors.add({.density = mixture.density,
                .velocity = level.expandDirection<D>(momentum / mixture.density),
                .pressure = mixture.pressure(),
                .energy = mixture.energy / mixture.density},
               reference::cellMean<D>(*exact, level, cell, clock->time));
  });
}

}  // namespace tushar::mpm::gas::conserving
