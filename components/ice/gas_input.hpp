#pragma once

#include <functional>
#include <iosfwd>
#include <vector>

#include "components/euler/flat_axes.hpp"
#include "components/euler/settings.hpp"
#include "components/euler/varying_diffusion.hpp"
#include "components/ice/burn_model.hpp"
#include "components/ice/heat_coefficients.hpp"
#include "components/ice/heating.hpp"
#include "components/ice/mixture/binary_properties.hpp"
#include "components/ice/mixture/pressure_burn.hpp"
#include "components/ice/mixture/programmed_burn.hpp"
#include "components/ice/scalar.hpp"
#include "components/ice/tracers/tracers.hpp"
#include "core/input/diagnostics.hpp"
#include "core/simulation/catalogue.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::ice {

/// Uintah's `exchange_coefficients`: values for each pair of materials, which are the upper triangle of a matrix, row
/// by row.
struct Exchange {
  Location where;                ///< in the scene
  std::vector<double> momentum;  ///< momentum exchange coefficients [kg/(m³ s)]
  std::vector<double> heat;      ///< heat exchange coefficients [W/(m³ K)]
  bool heatByMasses = false;     ///< whether the coefficients follow from HeatCoefficients::byMasses instead
  bool convects = false;         ///< whether the surface of a body also heats the fluid in front of it
  std::optional<int> fluid = {}, solid = {};  ///< the numbers of these materials

  HeatCoefficients heatCoefficients() const { return {heatByMasses ? std::vector<double>() : heat, heatByMasses}; }
};

/// `<Model type="Test">`: one gas is converted into another.
struct MassExchange {
  Location where;  ///< in the scene
  std::string from, to;
  double rate = 0;       ///< converted fraction of the gas per unit time [1/s]
  double startTime = 0;  ///< start time [s]
};

/// The settings of the implicit pressure solve.
struct ImplicitPressure {
  Location where;             ///< in the scene
  double soundSpeedKnob = 0;  ///< fraction of the speed of sound that limits the steps
  solvers::LinearSettings solver;
};

/// A gas as described by the sections of a scene for Uintah's ICE.
struct GasScene {
  Location where;                         ///< location of <CFD> in the scene
  euler::Settings gas;                    ///< the method, and the gas with its initial state
  double specificHeat = 0;                ///< specific heat c_v [J/(kg K)]
  double referencePressure = 0;           ///< reference pressure [Pa]
  Vec3 gravity = Vec3::Zero();            ///< gravity [m/s²]
  Vec3 push = Vec3::Zero();               ///< force per volume, equivalent to a pressure gradient [N/m³]
  euler::VaryingDiffusion varying = {};   ///< viscosity and conductivity, if they are not the same everywhere
  double viscosity = 0;                   ///< viscosity [Pa s]
  double conductivity = 0;                ///< conductivity [W/(m K)]
  std::optional<bool> thinWalls = {};     ///< whether bodies thinner than a cell block the gas
  std::optional<Exchange> exchange = {};  ///< momentum and heat exchange with other materials
  std::optional<ImplicitPressure> implicit = {};
  Heating heating = {};
  std::vector<ScalarSettings> scalars = {};  ///< scalars that are transported with the gas
  /// If there are several gases, each of them with its initial state; the first is also in `gas`.
  std::vector<euler::Settings> mixture = {};
  std::vector<euler::Diffusion> diffusions = {};  ///< diffusion of each gas, if there are several
  std::vector<MassExchange> massExchanges = {};   ///< mass exchanges between gases
  std::vector<BurnModel> burns = {};              ///< burn models of bodies
  std::vector<PressureBurn> reactions = {};       ///< burns by JWL++, by which one gas becomes another
  std::vector<ProgrammedBurn> programs = {};      ///< programmed burns, by which one gas becomes another
  std::optional<TracerSettings> tracers = {};     ///< particles that move with a gas
  std::optional<BinaryProperties> binary = {};    ///< set if the only gas of the scene is a mixture of two
};

/// The reactions of a scene, with the indices of its gases.
std::vector<Reaction> reactionsOf(const GasScene& scene);

/// The reason why implicit steps need a grid of one level.
inline constexpr const char* pressureOnOneLevel =
    "an <ImplicitSolver> solves for the pressure on one level; CFD/ICE/explicit=true switches it off";

/// The largest Courant number of the sum over axes, if cfl limits the rate along each axis; the other one applies
/// beside bodies and in implicit steps.
inline constexpr double greatestSum = 0.8, greatestSumWithBodies = 0.5;

/// Advice if a run fails.
inline constexpr const char* adviceForGas = "a smaller CFD/cfl, or CFD/ICE/advection of type FirstOrder";

/// Reads <CFD>, <PhysicalConstants>, <MaterialProperties> (apart from its section MPM), and the boundary conditions of
/// the grid. In the scene, the `solids` materials of MPM come before the gas. Reports every problem to the diagnostics.
GasScene readGas(const input::Element& root, int solids, input::Diagnostics& diagnostics);

/// A check of a scene on a grid: throws InputError if velocities at the start or at sides, gravity or the driving force
/// have a component along a periodic axis with one cell.
std::function<void(const Level&)> checkOfAxes(const input::Element& root, const GasScene& scene);
/// Lets the pressure rise by the weight of the gas, or of several, beyond sides where it continues; for explicit steps.
void letPressureRise(const GasScene& scene, euler::Settings& gas, std::vector<euler::Settings>& mixture);

/// The forms of the sections that readGas reads or accepts, for a component without further sections.
std::vector<simulation::SectionForm> gasForms();
/// The names of the sections in gasForms.
std::vector<std::string> gasSections();
/// The variables for which boundary conditions may be given.
std::vector<grid::BoundaryVariable> gasBoundaryLabels();
/// The types of boundary conditions of a gas.
simulation::ConditionWords gasConditionWords();
/// Writes the manual of the sections in gasForms.
void describeGas(std::ostream& out);

}  // namespace tushar::ice
