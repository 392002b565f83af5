#pragma once

#include <cmath>

#include "components/ice/mixture/pressure_burn.hpp"
#include "components/ice/mixture/programmed_burn.hpp"
#include "components/ice/mixture/tasks.hpp"

namespace tushar::ice {

/// The conversion of one gas into another, as rate and start time.
struct Transfer {
  std::size_t from = 0, to = 0;
  double rate = 0;       ///< converted fraction per unit time [1/s]
  double startTime = 0;  ///< start time [s]
};

/// Converts the fraction rate dt of a gas, at most all of it, into another one, which takes over its volume: Uintah's
/// model "Test". Mass, momentum and energy are conserved, since all gases have one velocity and the total energy does
/// not change. The pressure changes if the gases have different gammas.
template <int D>
void transferMass(const Patch& patch, const Gases&, const Transfer& one, double time, double dt,
                  const std::vector<euler::ChangedGas>& held) {
  if (time < one.startTime) return;
  const double part = std::min(one.rate * dt, 1.0);
  const auto move = [&](const CellView<double>& from, const CellView<double>& to, const Index<D>& cell) {
    const double moved = part * from[cell];
    from[cell] -= moved;
    to[cell] += moved;
  };
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    move(held[one.from].mass, held[one.to].mass, cell);
    move(held[one.from].share, held[one.to].share, cell);
  });
}

/// Converts a gas into another one at a rate that depends on the pressure, and adds the heat of the reaction. The
/// product takes over the volume. Mass and momentum are conserved; the energy increases by this heat.
template <int D>
void reactGas(const Patch& patch, const Gases& gases, const Reaction& one, double dt, CellView<const double> density,
              CellView<const Vec<D>> momentum, CellView<double> totalEnergy,
              const std::vector<euler::ChangedGas>& held) {
  const euler::ChangedGas &from = held[one.from], &to = held[one.to];
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    Reactants there{from.mass[cell], to.mass[cell], from.share[cell]};
    if (!(there.from > 0)) return;
    const double energy = euler::internalEnergyPerVolume<D>(density[cell], momentum[cell], totalEnergy[cell]);
    double pressure = 0;
    if (gases.front().blend) {  // their volume fractions are found after all sources
      const euler::Blend blend = euler::blendAt(gases, held, energy, cell);
      there.share = blend.shares[one.from];
      pressure = blend.pressure;
    } else {
      pressure = euler::mixedAt(gases, held, cell).pressure(density[cell], energy);
    }
    const double part = there.converted(one.burn, pressure, dt), burned = part * there.from;
    if (!(part > 0)) return;
    from.mass[cell] = part < 1 ? there.from - burned : 0;
    to.mass[cell] += burned;
    const double share = part * there.share;
    from.share[cell] = part < 1 ? there.share - share : 0;
    to.share[cell] += share;
    totalEnergy[cell] += burned * one.burn.heat;
  });
}

/// A gas that is converted into another one by a programmed burn.
struct BurningGas {
  std::size_t from = 0, to = 0;
  ProgrammedBurn burn;
};

/// Converts the part of a gas that its programmed burn has reached into another gas, which takes over its volume, and
/// adds the heat of the reaction. Mass and momentum are conserved; the energy increases by this heat.
template <int D>
void burnByProgram(const Patch& patch, const Gases&, const BurningGas& one, double time, double dt,
                   CellView<double> totalEnergy, const std::vector<euler::ChangedGas>& held) {
  const Level& level = patch.level();
  const euler::ChangedGas &from = held[one.from], &to = held[one.to];
  double product = 1;  // of the widths of cells along the axes with an extent
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (const double wide = level.cellWidth(axis); wide > 0) {
      product *= wide;
      ++axes;
    }
  const double width = axes == 3 ? std::cbrt(product) : std::pow(product, 1.0 / axes);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double mass = from.mass[cell];
    if (!(mass > 0) || !one.burn.takesCell(from.share[cell] + to.share[cell])) return;
    const Vec3 point = level.expandPoint<D>(level.cellCentre<D>(cell));
    const double reached = one.burn.reached(point, time + dt, width) * (mass + to.mass[cell]);
    const double burned = std::clamp(reached - to.mass[cell], 0.0, mass), share = burned / mass * from.share[cell];
    from.mass[cell] = burned < mass ? mass - burned : 0;
    to.mass[cell] += burned;
    from.share[cell] = burned < mass ? from.share[cell] - share : 0;
    to.share[cell] += share;
    totalEnergy[cell] += burned * one.burn.heat;
  });
}

}  // namespace tushar::ice
