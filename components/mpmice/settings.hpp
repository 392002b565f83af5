#pragma once

#include "components/euler/settings.hpp"
#include "components/euler/varying_diffusion.hpp"
#include "components/ice/burn_model.hpp"
#include "components/ice/face_flow.hpp"
#include "components/ice/heat_coefficients.hpp"
#include "components/ice/heating.hpp"
#include "components/ice/mixture/pressure_burn.hpp"
#include "components/ice/scalar.hpp"
#include "components/ice/tracers/tracers.hpp"
#include "core/core.hpp"

namespace tushar::mpmice {

/// A body that is converted into a gas, and the law by which it burns.
struct Burning {
  ice::BurnModel model;
  std::size_t body = 0;  ///< index of the body among the bodies
  std::size_t gas = 0;   ///< index of the gas among several gases
};

/// The internal variable of constitutive models with cracks, in which a body may burn.
inline constexpr std::string_view crackRadiusLabel = "p.crackRad";

/// Diffusion coefficients of the gas around bodies.
struct GasDiffusion {
  euler::VaryingDiffusion alone = {};  ///< diffusion of a single gas; for several gases, only the eddies
  /// Diffusion of each of several gases; a cell has the mean, weighted by volume fractions.
  std::vector<euler::Diffusion> ofEach = {};

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

/// Coefficients by which bodies drag gas along, other than by its viscosity.
struct Drag {
  std::vector<std::vector<double>> ofGases = {};  ///< for each gas, the coefficient of each body [kg/(m³ s)]

  bool acts() const {
    return std::any_of(ofGases.begin(), ofGases.end(), [](const std::vector<double>& ofBodies) {
      return std::any_of(ofBodies.begin(), ofBodies.end(), [](double k) { return k > 0; });
    });
  }
};

/// A body whose surface also exchanges heat with a gas in front of it, and this gas (see HeatAtFaces).
struct Convection {
  Eigen::Index body = 0;  ///< index of the body among the bodies
  Eigen::Index gas = 0;   ///< index of the gas among several gases
};

/// The gas around bodies, and its interaction with them.
struct Settings {
  euler::Settings gas;
  double referencePressure = 0;  ///< pressure of the surroundings, which exerts no force on bodies [Pa]
  Vec3 gravity = Vec3::Zero();   ///< gravity [m/s²]
  ice::HeatCoefficients heat;    ///< coefficients of heat exchange: first the bodies in their order, then the gases
  bool thinWalls = false;        ///< whether bodies thinner than a cell also block the gas
  bool areRigid = false;         ///< whether bodies keep their velocities, unaffected by the gas
  bool endsAtPlane = false;      ///< whether an upper side of the grid is a symmetry plane
  bool opensAtSides = false;     ///< whether bodies may leave the grid through open sides
  GasDiffusion diffusion = {};
  Drag drag = {};
  std::optional<Convection> convection = {};
  std::optional<ice::IceSettings> implicit = {};    ///< settings of implicit steps, if sound does not limit the steps
  ice::Heating heating = {};                        ///< heating of the gases
  std::vector<euler::Settings> gases = {};          ///< each gas, if several share cells; the first is `gas`
  std::vector<ice::Reaction> reactions = {};        ///< reactions by which one gas becomes another
  std::optional<Burning> burning = {};              ///< the body that burns, if any
  std::vector<ice::ScalarSettings> scalars = {};    ///< scalars that are transported with the gas
  std::optional<ice::TracerSettings> tracers = {};  ///< particles that move with a gas

  /// Whether walls slow the gas that flows along them.
  bool hasFriction() const { return diffusion.isViscous() || drag.acts(); }
  /// Whether gas flows into space that bodies leave empty: ideal gases in explicit steps, which expand without limit.
  bool fillsVacuum() const {
    const auto isIdeal = [](const euler::Settings& one) { return !one.gas.law && one.gas.pInfinity == 0; };
    return !implicit && isIdeal(gas) && std::all_of(gases.begin(), gases.end(), isIdeal);
  }
};

/// The amount by which thresholds for free volumes differ from round fractions. Bodies that are aligned with cells
/// leave such fractions free; with the offset, round-off does not decide on which side of a threshold they are.
inline constexpr double offRoundShares = 1e-9;
/// The free volume below which a cell is treated as full.
inline constexpr double leastFreeVolume = offRoundShares;
/// The smallest free volume at which a cell is treated as free of bodies.
inline constexpr double wholeFreeVolume = 1 - offRoundShares;
/// The free volume below which the gas of a cell is merged with that of a neighbour.
inline constexpr double smallFreeVolume = 0.5 - offRoundShares;
/// The largest cfl. With it, an open face lets out at most the content of a half-full cell.
inline constexpr double greatestCfl = 0.5;
/// The free volume below which a closed hole keeps its contents.
inline constexpr double narrowFreeVolume = 0.2 - offRoundShares;

/// The fraction of a cell that its gas fills, as a function of the free volume. It decreases continuously to 0 at the
/// free volume at which the cell counts as full.
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
