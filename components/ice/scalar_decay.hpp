#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/core.hpp"

namespace tushar::ice {

/// Values at points of the grid, read from a file: one for each cell.
struct ValuesOfCells {
  Location where;    ///< the tag that names the file
  std::string path;  ///< of this tag
  std::string file;
  std::vector<std::pair<Vec3, double>> points;  ///< positions in cells [m], and the values there
};

/// How a scalar f falls with time: df/dt = -r0 - (r1 + c1 c2 + c3) f, where c2 may differ from cell to cell.
struct ScalarDecay {
  double constantRate = 0;                            ///< r0 [1/s]
  double linearRate = 0;                              ///< r1 + c3 [1/s]
  double factor = 0;                                  ///< c1; c1 c2 is in 1/s
  double coefficient = 0;                             ///< c2, if it is the same everywhere
  bool isExponential = false;                         ///< whether c1, c2 and c3 are given
  std::shared_ptr<const ValuesOfCells> coefficients;  ///< c2 of each cell; null if it is the same everywhere

  bool acts() const { return constantRate != 0 || linearRate != 0 || isExponential; }
};

/// The exact solution of df/dt = -r0 - k f over a time dt [s]: f' = f exp(-k dt) - r0 (1 - exp(-k dt)) / k. The part r0
/// ends where f reaches 0.
struct Fall {
  double kept, lost;  ///< f' = kept f - lost
  bool isBounded;     ///< whether it ends at 0

  Fall(double r0, double k, double dt)
      : kept(k == 0 ? 1 : std::exp(-k * dt)),
        lost(r0 == 0  ? 0
             : k == 0 ? r0 * dt
                      : -r0 * std::expm1(-k * dt) / k),
        isBounded(r0 > 0) {}

  /// The new f times `mass`, from the old one times `mass`.
  double operator()(double held, double mass = 1) const {
    const double after = kept * held - lost * mass;
    return isBounded && held >= 0 ? std::max(after, 0.0) : after;
  }
};

/// Sets the coefficients c2 of the cells of a patch. Throws InputError if the file has none for one of them.
template <int D>
void initializeDecay(const Patch& patch, const ScalarDecay& decay, CellView<double> coefficient) {
  const Level& level = patch.level();
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  coefficient.fill(decay.coefficients ? unknown : decay.coefficient);
  if (!decay.coefficients) return;
  for (const auto& [point, value] : decay.coefficients->points) {
    const Index<D> cell = level.cellOf<D>(level.reduce<D>(point));
    if (patch.cells().contains(cell)) coefficient[cell] = value;
  }
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!std::isnan(coefficient[cell])) return;
    const Vec3 centre = level.expandPoint<D>(level.cellCentre<D>(cell));
    throw InputError(
        {{decay.coefficients->where, decay.coefficients->path,
          fmt::format("'{}' has no line for the cell at ({:g}, {:g}, {:g}); every cell needs one, x,y,z,c2",
                      decay.coefficients->file, centre[0], centre[1], centre[2])}});
  });
}

/// Lets a scalar fall for the length of a step. `held` is f times the mass of the gas per volume of the cell.
template <int D>
void decayScalar(const Patch& patch, const ScalarDecay& decay, double dt, CellView<const double> density,
                 std::optional<CellView<const double>> coefficient, CellView<double> held) {
  const auto fallWith = [&](double c2) { return Fall(decay.constantRate, decay.linearRate + decay.factor * c2, dt); };
  const Fall everywhere = fallWith(decay.coefficient);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const Fall fall = coefficient ? fallWith((*coefficient)[cell]) : everywhere;
    held[cell] = fall(held[cell], density[cell]);
  });
}

}  // namespace tushar::ice
