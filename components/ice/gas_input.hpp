#pragma once

#include <iosfwd>
#include <vector>

#include "components/euler/settings.hpp"
#include "components/euler/varying_diffusion.hpp"
#include "components/ice/burn_model.hpp"
#include "components/ice/heat_coefficients.hpp"
#include "components/ice/heating.hpp"
#include "components/ice/mixture/binary_properties.hpp"
#include "components/ice/mixture/programmed_burn.hpp"
#include "components/ice/scalar.hpp"
#include "core/input/diagnostics.hpp"
#include "core/simulation/catalogue.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::ice {

/// Values for each pair of materials, the upper triangle of their matrix row by row: Uintah's `exchange_coefficients`.
struct Exchange {
  Location where;                ///< in the scene
  std::vector<double> momentum;  ///< kg/(m³ s)
  std::vector<double> heat;      ///< W/(m³ K)
  bool heatByMasses = false;     ///< HeatCoefficients::byMasses replaces these

  HeatCoefficients heatCoefficients() const { return {heatByMasses ? std::vector<double>() : heat, heatByMasses}; }
};

/// `<Model type="Test">`: one gas is converted into another.
struct MassExchange {
  Location where;  ///< in the scene
  std::string from, to;
  double rate = 0;       ///< fraction of it per time, 1/s
  double startTime = 0;  ///< s
};

/// The settings of the implicit pressure solve.
struct ImplicitPressure {
  Location where;             ///< in the scene
  double soundSpeedKnob = 0;  ///< fraction of the speed of sound that limits the steps
  solvers::LinearSettings solver;
};

/// A gas as the sections of a scene for Uintah's ICE describe it.
struct GasScene {
  Location where;                         ///< place of <CFD> in the scene
  euler::Settings gas;                    ///< the method, the gas and its state at the start
  double specificHeat = 0;                ///< c_v, J/(kg K)
  double referencePressure = 0;           ///< Pa
  Vec3 gravity = Vec3::Zero();            ///< m/s²
  Vec3 push = Vec3::Zero();               ///< force per volume, which replaces a pressure gradient, N/m³
  euler::VaryingDiffusion varying = {};   ///< the viscosity, if it is not the same everywhere
  double viscosity = 0;                   ///< Pa s
  double conductivity = 0;                ///< W/(m K)
  std::optional<bool> thinWalls = {};     ///< whether bodies thinner than a cell block the gas
  std::optional<Exchange> exchange = {};  ///< exchange with other materials
  std::optional<ImplicitPressure> implicit = {};
  Heating heating = {};
  std::vector<ScalarSettings> scalars = {};  ///< scalars that are transported with the gas
  /// If there are several gases: each of them, with its initial state; the gas above is the first.
  std::vector<euler::Settings> mixture = {};
  std::vector<euler::Diffusion> diffusions = {};  ///< diffusion of each of several gases
  std::vector<MassExchange> massExchanges = {};   ///< between them
  std::vector<BurnModel> burns = {};              ///< of bodies
  std::vector<ProgrammedBurn> programs = {};      ///< of gases that become others
  std::optional<BinaryProperties> binary = {};    ///< where one gas of the scene is a mixture of two
};

/// Why implicit steps need one level.
inline constexpr const char* pressureOnOneLevel =
    "an <ImplicitSolver> solves for the pressure on one level; CFD/ICE/explicit=true switches it off";

/// Advice if a run fails.
inline constexpr const char* adviceForGas = "a smaller CFD/cfl, or CFD/ICE/advection of type FirstOrder";

/// Reads <CFD>, <PhysicalConstants>, <MaterialProperties> except its MPM, and the conditions at the sides of the grid.
/// Throughout the scene the gas is numbered after the `solids` materials of MPM. Every problem goes to the diagnostics.
GasScene readGas(const input::Element& root, int solids, input::Diagnostics& diagnostics);

/// The sections that readGas reads or accepts, for a component without further sections.
std::vector<simulation::SectionForm> gasForms();
/// Their names.
std::vector<std::string> gasSections();
/// The variables for which the sides of the grid may have conditions.
std::vector<grid::BoundaryVariable> gasBoundaryLabels();
/// The types of their conditions; oscillating ones only if conditions may depend on time.
simulation::ConditionWords gasConditionWords(bool mayDependOnTime);
/// The manual of the sections.
void describeGas(std::ostream& out);

}  // namespace tushar::ice
