#pragma once

#include <algorithm>
#include <vector>

#include "components/euler/state_views.hpp"
#include "core/core.hpp"

namespace tushar::ice {

/// The tag `CFD/ICE/ADD_HEAT`: gases are heated during a period of time.
struct Heating {
  Location where;               ///< in the scene
  std::vector<double> perMass;  ///< heating rate of each gas [W/kg]
  double start = 0, end = 0;    ///< start and end of heating [s]

  bool acts() const {
    return std::any_of(perMass.begin(), perMass.end(), [](double rate) { return rate != 0; });
  }
  /// The heat per mass added to a gas in the part of a step that is within the heating period [J/kg].
  double inStep(std::size_t gas, double time, double dt) const {
    if (time >= start && time + dt <= end) return perMass[gas] * dt;
    return perMass[gas] * std::max(std::min(time + dt, end) - std::max(time, start), 0.0);
  }
};

/// Adds heat to one gas.
template <int D>
void addHeat(const Patch& patch, const Heating& heating, CellView<const double> density, double time, double dt,
             CellView<double> totalEnergy) {
  const double perMass = heating.inStep(0, time, dt);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { totalEnergy[cell] += perMass * density[cell]; });
}

}  // namespace tushar::ice
