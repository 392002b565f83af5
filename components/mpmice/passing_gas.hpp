#pragma once

#include <algorithm>
#include <array>

#include "components/mpmice/gas_in_cells.hpp"
#include "components/mpmice/open_sides.hpp"

namespace tushar::mpmice {

/// What a donor gives: its gas, and the fraction of the requested volume that it can give.
template <int D>
struct Gift {
  Parcel<D> of;
  double share = 1;
};

/// Whether more gas than there was has left a cell at an open side, as round-off may have it where bodies fill the
/// cell.
template <int D>
bool isOverdrawnAtSide(const Level& level, const euler::Gas& gas, const euler::MixtureViews<D, double>& held,
                       const Index<D>& cell) {
  const bool isFine = held.density[cell] > 0 && euler::internalEnergyIn<D>(held, cell) >= 0;
  return !isFine && openSideAt<D>(level, gas, cell).isOne();
}

/// The volumes, per cell volume, that follow walls into and out of a cell that bodies fill, along each axis, and what
/// it passes on. It passes on only gas that flows in along other axes, as where a hole moves around an edge. So no
/// gas passes straight through a body whose boxes do not move exactly as its walls do.
template <int D>
struct PassingGas {
  using PerAxis = std::array<double, D>;
  PerAxis in{}, out{};
  std::array<PerAxis, D> through{};  ///< volume that flows in along the first axis and out along the second

  /// Divides what flows out among the axes along which gas flows in, in proportion to what these bring.
  void divide() {
    for (std::size_t d = 0; d < D; ++d) {
      double across = 0;
      for (std::size_t e = 0; e < D; ++e) across += e == d ? 0 : in[e];
      for (std::size_t e = 0; e < D; ++e)
        if (e != d && across > 0) through[e][d] = std::min(1.0, out[d] / across) * in[e];
    }
    for (std::size_t e = 0; e < D; ++e)
      if (const double most = passedFrom(e); most > in[e])
        for (double& volume : through[e]) volume *= in[e] / most;
  }
  double passedFrom(std::size_t axis) const {
    double sum = 0;
    for (const double volume : through[axis]) sum += volume;
    return sum;
  }
  double passedTo(std::size_t axis) const {
    double sum = 0;
    for (const PerAxis& from : through) sum += from[axis];
    return sum;
  }
  /// The fraction of what flows in along an axis that is passed on, or that has room in the cell.
  double accepted(std::size_t axis, double room) const {
    double rest = 0;
    for (std::size_t e = 0; e < D; ++e) rest += in[e] - passedFrom(e);
    const double passed = passedFrom(axis), kept = rest > room ? std::max(0.0, room) / rest : 1;
    return (passed + kept * (in[axis] - passed)) / in[axis];
  }
};

}  // namespace tushar::mpmice
