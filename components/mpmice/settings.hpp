#pragma once

#include "components/euler/settings.hpp"
#include "components/euler/varying_diffusion.hpp"
#include "components/ice/burn_model.hpp"
#include "components/ice/face_flow.hpp"
#include "components/ice/heat_coefficients.hpp"
#include "components/ice/heating.hpp"
#include "components/ice/scalar.hpp"
#include "core/core.hpp"

namespace tushar::mpmice {

/// A body that is converted into a gas.
struct Burning {
  ice::BurnModel model;
  std::size_t body = 0;  ///< its index among the bodies
  std::size_t gas = 0;   ///< that of the gas among several
};

/// The internal variable of constitutive models with cracks, in which a body may burn.
inline constexpr std::string_view crackRadiusLabel = "p.crackRad";

/// How the gas around bodies diffuses.
struct GasDiffusion {
  euler::VaryingDiffusion alone = {};         ///< of one gas; for several gases, only the eddies
  std::vector<euler::Diffusion> ofEach = {};  ///< of several gases: a cell has the mean weighted by volume fractions

  /// Whether viscosity and conductivity differ from cell to cell.
  bool varies() const { return alone.varies() || !ofEach.empty(); }
  bool isViscous() const {
    return alone.uniform.viscosity > 0 || alone.varies() ||
           std::any_of(ofEach.begin(), ofEach.end(), [](const auto& one) { return one.viscosity > 0; });
  }
  bool conducts() const {
    return alone.uniform.conductivity > 0 ||
           std::any_of(ofEach.begin(), ofEach.end(), [](const auto& one) { return one.conductivity > 0; });
  }
  bool acts() const { return isViscous() || conducts(); }
};

/// The gas around bodies, and its interaction with them.
struct Settings {
  euler::Settings gas;
  double referencePressure = 0;  ///< exerts no force on bodies, Pa
  Vec3 gravity = Vec3::Zero();   ///< m/s²
  ice::HeatCoefficients heat;    ///< of bodies in their order, then gases
  bool thinWalls = false;        ///< bodies thinner than a cell also block the gas
  bool areRigid = false;         ///< bodies keep their velocities, independently of the gas
  GasDiffusion diffusion = {};
  std::optional<ice::IceSettings> implicit = {};  ///< if sound does not limit the steps
  ice::Heating heating = {};                      ///< of the gases
  std::vector<euler::Settings> gases = {};        ///< each of several gases that share cells; the first is `gas`
  std::optional<Burning> burning = {};            ///< a body that burns
  std::vector<ice::ScalarSettings> scalars = {};  ///< scalars that are transported with the gas
};

/// The offset of thresholds for free volumes from round fractions. Such fractions occur when bodies are aligned with
/// cells; with the offset, round-off does not affect on which side of a threshold they are.
inline constexpr double offRoundShares = 1e-9;
/// Smaller free volumes are treated as 0.
inline constexpr double leastFreeVolume = offRoundShares;
/// With at least this free volume a cell is free of bodies.
inline constexpr double wholeFreeVolume = 1 - offRoundShares;
/// The gas of a cell with a smaller fraction of free volume is merged with that of a neighbour.
inline constexpr double smallFreeVolume = 0.5 - offRoundShares;
/// The largest cfl, with which an open face lets out at most the contents of a half-full cell.
inline constexpr double greatestCfl = 0.5;
/// A smaller closed hole keeps its contents.
inline constexpr double narrowFreeVolume = 0.2 - offRoundShares;

/// The fraction of a cell that its gas fills, as a function of the free volume, which falls continuously to 0 where the
/// cell is considered full.
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
