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
  bool thinWalls = false;        ///< whether bodies thinner than a cell also hold back the gas
  bool areRigid = false;         ///< whether bodies keep their velocities, whatever the gas does
  euler::Diffusion diffusion = {};                ///< diffusion in the gas
  std::optional<ice::IceSettings> implicit = {};  ///< settings of implicit steps, if the scene has them
  std::vector<euler::Settings> gases = {};        ///< settings of several gases that share cells; the first is `gas`
};

/// The offset of limits of free volumes from round fractions, which occur when bodies are aligned with cells, so that
/// round-off does not decide on which side of a limit they are.
inline constexpr double offRoundShares = 1e-9;
/// Smaller free volumes count as 0.
inline constexpr double leastFreeVolume = offRoundShares;
/// With at least this free volume a cell is free of bodies.
inline constexpr double wholeFreeVolume = 1 - offRoundShares;
/// A cell with a smaller fraction of free volume gives its gas to a neighbour.
inline constexpr double smallFreeVolume = 0.5 - offRoundShares;
/// The largest cfl, with which an open face lets out at most the contents of a half-full cell.
inline constexpr double greatestCfl = 0.5;
/// A smaller closed hole keeps its contents.
inline constexpr double narrowFreeVolume = 0.2 - offRoundShares;

/// The fraction of a cell that its gas fills, as a function of the free volume, which falls continuously to 0 where the
/// cell counts as full.
inline double roomOf(double free) {
  return free < 2 * leastFreeVolume ? std::max(0.0, 2 * (free - leastFreeVolume)) : free;
}

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
