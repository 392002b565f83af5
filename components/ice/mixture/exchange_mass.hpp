#pragma once

#include "components/ice/mixture/tasks.hpp"

namespace tushar::ice {

/// The conversion of one of several gases into another.
struct Transfer {
  std::size_t from = 0, to = 0;
  double rate = 0;       ///< fraction of it per time, 1/s
  double startTime = 0;  ///< s
};

/// Moves the fraction rate dt of a gas, at most all of it, to another one, with its volume: Uintah's model "Test". As
/// all have one velocity and the total energy stays, mass, momentum and energy are kept; the pressure changes where
/// the gases' gammas differ.
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

}  // namespace tushar::ice
