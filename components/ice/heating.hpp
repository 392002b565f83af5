#pragma once

#include <algorithm>
#include <vector>

#include "components/euler/state_views.hpp"
#include "core/core.hpp"

namespace tushar::ice {

/// `CFD/ICE/ADD_HEAT`: gases are heated for some time.
struct Heating {
  Location where;               ///< in the scene
  std::vector<double> perMass;  ///< of each gas, W/kg
  double start = 0, end = 0;    ///< s

  bool acts() const {
    return std::any_of(perMass.begin(), perMass.end(), [](double rate) { return rate != 0; });
  }
  /// The heat per mass that is added to a gas in a step [J/kg]; 0 if the step starts outside the heating period.
  double inStep(std::size_t gas, double time, double dt) const {
    return time >= start && time <= end ? perMass[gas] * dt : 0;
  }
};

/// Heats one gas.
template <int D>
void addHeat(const Patch& patch, const Heating& heating, CellView<const double> density, double time, double dt,
             CellView<double> totalEnergy) {
  const double perMass = heating.inStep(0, time, dt);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { totalEnergy[cell] += perMass * density[cell]; });
}

}  // namespace tushar::ice
