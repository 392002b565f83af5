#pragma once

#include <algorithm>
#include <vector>

namespace tushar::ice {

/// Coefficients of the heat exchange between the materials of a cell [W/(m³ K)]: a number for each pair, row by row, or
/// computed from the masses of both in the cell.
struct HeatCoefficients {
  std::vector<double> pairs;
  bool byMasses = false;

  bool act() const {
    return byMasses || std::any_of(pairs.begin(), pairs.end(), [](double h) { return h > 0; });
  }
  /// The coefficient of a pair of materials with these masses per volume of the cell [kg/m³]. By masses it is r² or
  /// 1/r², r their ratio, from 1e5 to 1e12: Uintah's `linearVariation`.
  double of(std::size_t pair, double massA, double massB) const {
    if (!byMasses) return pairs.empty() ? 0 : pairs[pair];
    const double ratio = massA > massB ? massA / massB : massB / massA;
    return std::clamp(ratio * ratio, 1e5, 1e12);
  }
};

}  // namespace tushar::ice
