#pragma once

#include "components/euler/settings.hpp"

namespace tushar::mpmice {

/// The gas around bodies, and how it meets them.
struct Settings {
  euler::Settings gas;
  double referencePressure = 0;  ///< exerts no force on bodies, Pa
  Vec3 gravity = Vec3::Zero();   ///< m/s²
  std::vector<double> heat;      ///< W/(m³ K) between pairs of materials, row by row, the gas last; empty: none flows
  bool thinWalls = false;        ///< bodies thinner than a cell hold the gas back, too
  bool areRigid = false;         ///< bodies move as they started, whatever the gas does
};

/// Free volumes below this are none.
inline constexpr double leastFreeVolume = 1e-9;
/// A cell with a smaller share of free volume gives its gas to a neighbour.
inline constexpr double smallFreeVolume = 0.5;

}  // namespace tushar::mpmice
