#pragma once

#include <algorithm>
#include <vector>

namespace tushar::ice {

/// Coefficients of the heat exchange between the materials of a cell [W/(m³ K)]: either a number for each pair, row by
/// row, or values that follow from the masses of the two materials in the cell.
struct HeatCoefficients {
  std::vector<double> pairs;
  bool byMasses = false;

  bool act() const {
    return byMasses || std::any_of(pairs.begin(), pairs.end(), [](double h) { return h > 0; });
  }
  /// The coefficient of a pair of materials with these masses per cell volume [kg/m³]. If coefficients depend on masses
  /// (Uintah's `linearVariation`), it is r², limited to the range from 1e5 to 1e12, where r is the larger mass divided
  /// by the smaller one.
  double of(std::size_t pair, double massA, double massB) const {
    if (!byMasses) return pairs.empty() ? 0 : pairs[pair];
    const double ratio = massA > massB ? massA / massB : massB / massA;
    return std::clamp(ratio * ratio, 1e5, 1e12);
  }
};

}  // namespace tushar::ice
