#pragma once

#include "components/euler/diffusion.hpp"
#include "components/euler/settings.hpp"
#include "components/ice/face_flow.hpp"
#include "core/core.hpp"

namespace tushar::mpmice {

/// The gas around bodies, and its interaction with them.
struct Settings {
  euler::Settings gas;
  double referencePressure = 0;  ///< exerts no force on bodies, Pa
  Vec3 gravity = Vec3::Zero();   ///< m/s²
  std::vector<double> heat;      ///< W/(m³ K) between pairs of materials, row by row, the gas last; empty: none flows
  bool thinWalls = false;        ///< bodies thinner than a cell also hold the gas back
  bool areRigid = false;         ///< bodies keep their velocities, whatever the gas does
  euler::Diffusion diffusion = {};                ///< in the gas
  std::optional<ice::IceSettings> implicit = {};  ///< where sound does not limit the steps
  std::vector<euler::Settings> gases = {};        ///< each of several gases that share cells; the first is `gas`
};

/// Smaller free volumes count as 0.
inline constexpr double leastFreeVolume = 1e-9;
/// A cell with a smaller fraction of free volume gives its gas to a neighbour. An open face lets out, in a step, up to
/// cfl over this share of what a cell has, so that it is also the greatest cfl.
inline constexpr double smallFreeVolume = 0.5;
/// A smaller closed hole keeps its contents.
inline constexpr double narrowFreeVolume = 0.2;

/// The cells within some layers of a cell.
template <int D>
Box cellsAround(const Index<D>& cell, int layers) {
  Box cells{{}, Index3::filled(1)};
  for (int d = 0; d < D; ++d) {
    cells.lower[d] = cell[d] - layers;
    cells.upper[d] = cell[d] + layers + 1;
  }
  return cells;
}

}  // namespace tushar::mpmice
