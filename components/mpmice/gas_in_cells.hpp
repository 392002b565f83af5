#pragma once

#include "components/euler/tasks/check_state.hpp"
#include "components/mpmice/labels.hpp"
#include "components/mpmice/settings.hpp"

namespace tushar::mpmice {

/// The gas in the free part of cells: what it holds, per volume of the cell, and how much room it has.
template <int D>
struct GasInCells {
  euler::StateViews<D, const double> held;
  CellView<const double> free;
  CellView<const Vec<D>> coverage;

  /// How far beyond a patch: the state, where gas is, and how much room it has.
  struct Reach {
    int state = 0, mass = 0, room = 0;
  };
  /// `reads` makes accesses of the state at the start of a step, or as the step has it.
  static GasInCells from(auto& take, auto reads, const Reach& ghost) {
    return {.held = {take(reads(c::density, ghost.mass)), take(reads(c::momentum<D>, ghost.state)),
                     take(reads(c::totalEnergy, ghost.state))},
            .free = take(reads(c::freeVolume, ghost.room)),
            .coverage = take(reads(c::coverage<D>, ghost.room))};
  }
  bool isEmpty(const Index<D>& cell) const { return free[cell] < leastFreeVolume || !(held.density[cell] > 0); }
  /// rho, rho v, E of the gas alone; the cell must hold some.
  euler::State<D> conserved(const Index<D>& cell) const {
    const double inverse = 1 / free[cell];
    euler::State<D> u;
    u[euler::kDensity] = held.density[cell] * inverse;
    for (int d = 0; d < D; ++d) u[euler::kVelocity(d)] = held.momentum[cell][d] * inverse;
    u[euler::kPressure<D>] = held.totalEnergy[cell] * inverse;
    return u;
  }
  /// rho, v, p of the gas alone.
  template <class G>
  euler::State<D> primitive(const G& gas, const Index<D>& cell) const {
    return euler::primitive<D>(gas, conserved(cell));
  }
};

/// Throws NumericalError for an impossible gas in the free fraction `free` of a cell, with its density [kg/m³] and the
/// last number of its primitive state.
template <int D>
[[noreturn]] void refuseGas(const Level& level, const euler::Gas& gas, const Index<D>& cell, double free,
                            double density, double last) {
  const Vec3 at = level.expandPoint<D>(level.cellCentre<D>(cell));
  throw NumericalError(
      fmt::format("the gas beside a body became unphysical: {:.6g} kg/m^3 and {:.6g} Pa in the free {:.3g} of the cell "
                  "at ({:g}, {:g}, {:g}) m",
                  density, gas.pressureOf(density, last), free, at[0], at[1], at[2]),
      "", "c.density", level.cellNumber<D>(cell));
}

inline constexpr auto readsOld = [](const auto& label, int ghost) { return requiresOld(label, ghost); };
inline constexpr auto readsNew = [](const auto& label, int ghost) { return requiresNew(label, ghost); };

}  // namespace tushar::mpmice
