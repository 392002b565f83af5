#pragma once

#include <algorithm>
#include <vector>

namespace tushar::ice {

/// Coefficients of the exchange of heat between the materials of a cell, W/(m³ K): a number for each pair, row by row,
/// or by the masses of both there.
struct HeatCoefficients {
  std::vector<double> pairs;
  bool byMasses = false;

  bool act() const {
    return byMasses || std::any_of(pairs.begin(), pairs.end(), [](double h) { return h > 0; });
  }
  /// That of a pair whose masses are given per volume of the cell [kg/m³]. By masses it is r² or 1/r², r their ratio,
  /// from 1e5 to 1e12: Uintah's `linearVariation`.
  double of(std::size_t pair, double massA, double massB) const {
    if (!byMasses) return pairs[pair];
    const double ratio = massA > massB ? massA / massB : massB / massA;
    return std::clamp(ratio * ratio, 1e5, 1e12);
  }
};

}  // namespace tushar::ice
