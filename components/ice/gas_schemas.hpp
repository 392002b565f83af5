#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/ice/burn_model.hpp"
#include "components/ice/equation_of_state.hpp"
#include "components/ice/gas_input.hpp"
#include "components/ice/start.hpp"
#include "core/input/schema.hpp"

// The sections of a scene for Uintah's ICE, as they are written.

namespace tushar::ice {

struct AdvectionSection {
  euler::Reconstruction reconstruction = euler::Reconstruction::musclHancock;
};

/// The tag `CFD/ICE/TimeStepControl`.
struct StepSection {
  double soundSpeedKnob = 0.5;
  bool limitsSum = false;  ///< whether cfl limits the sum of rates over axes, instead of the rate along each axis
};

/// The tag `CFD/ICE/ImplicitSolver/Parameters`, with hypre's names.
struct HypreSection {
  std::string solver, preconditioner;
  double tolerance = 0;
  int maxIterations = 0;
};

/// The tag `CFD/ICE/ImplicitSolver`.
struct ImplicitSection {
  Location where;  ///< in the scene
  std::optional<HypreSection> hypre;
  std::optional<solvers::LinearSettings> solver;
};

/// The tag `CFD/ICE/fixedPressureGradient`.
struct PushSection {
  double x = 0, y = 0, z = 0;  ///< components of the force per volume [N/m³]
};

/// The tag `CFD/ICE/turbulence`.
struct EddiesSection {
  Location where;  ///< in the scene
  std::string model;
  double constant = 0;
};

/// The tag `CFD/ICE/ADD_HEAT`.
struct HeatingSection {
  Location where;  ///< in the scene
  std::vector<int> materials;
  std::vector<double> perMass;  ///< heating rate of each gas [W/kg]
  double start = 0, end = 0;    ///< start and end of heating [s]
};

/// The tag `CFD/ICE`.
struct IceSection {
  AdvectionSection advection;
  bool isExplicit = false;
  std::optional<StepSection> steps;
  std::optional<ImplicitSection> implicit;
  std::optional<bool> thinWalls;
  std::optional<CustomStart> start;
  std::optional<PushSection> push;
  std::optional<EddiesSection> eddies;
  std::optional<HeatingSection> heating;
  std::optional<bool> isHydrostatic;  ///< whether the Pressure of sides rises by the weight of the gas around
};

/// The tag `CFD`.
struct CfdSection {
  double cfl = 0;
  IceSection ice;
};

/// The initial gas in a region.
struct GasBody {
  Location where;  ///< in the scene
  std::shared_ptr<const input::GeometryPiece> shape;
  input::Expression density;         ///< density [kg/m³]
  input::Expression temperature;     ///< temperature [K]
  input::VectorExpression velocity;  ///< velocity [m/s]
  /// Pressure [Pa]; ignored, because it follows from density and temperature.
  std::optional<input::Expression> pressure;
  std::optional<input::Expression> share;  ///< volume fraction
  Index3 points = Index3::filled(1);       ///< points of a cell at which regions of several gases are found
};

/// `MaterialProperties/ICE/material/SpecificHeatModel`: the c_v of air, which depends on the temperature.
struct AirSection {
  Location where;  ///< in the scene
  std::string type;
  std::optional<double> gasConstant;  ///< R, J/(kg K)
};

/// The tag `MaterialProperties/ICE/material`.
struct GasMaterial {
  std::string name;
  EquationOfState state;
  double gamma = 0;         ///< ratio of specific heats
  double specificHeat = 0;  ///< specific heat c_v [J/(kg K)]
  double viscosity = 0;     ///< viscosity [Pa s]
  double conductivity = 0;  ///< conductivity [W/(m K)]
  euler::VaryingDiffusion varying;
  std::optional<AirSection> air;
  std::vector<GasBody> bodies;
  bool isAround = false;  ///< whether it is the gas around the others, whose weight counts at sides

  /// The law of the gas; null for an ideal gas of constant c_v, and for a stiffened one.
  std::shared_ptr<const euler::Gas::Law> law() const;
};

struct GasMaterials {
  std::vector<GasMaterial> materials;
};

/// The tag `MaterialProperties/exchange_properties/CoefficientModel`.
struct CoefficientSection {
  std::string heat = "constant";
};

/// The tag `MaterialProperties/exchange_properties/Model`.
struct ExchangeModelSection {
  std::string type;
  bool slips = true;  ///< whether coefficients follow from the mean free path of a gas
};

struct ExchangeSection {
  Exchange coefficients;
  bool convects = false;                      ///< whether a surface exchanges heat with the fluid in front of it
  std::optional<int> fluid = {}, solid = {};  ///< the numbers of the materials that do
  std::optional<CoefficientSection> model;
  std::optional<ExchangeModelSection> exchangeModel;
};

/// The tag `MaterialProperties`.
struct PropertiesSection {
  GasMaterials ice;
  std::optional<ExchangeSection> exchange;
};

/// The tag `PhysicalConstants`.
struct ConstantsSection {
  Vec3 gravity = Vec3::Zero();   ///< gravity [m/s²]
  double referencePressure = 0;  ///< reference pressure [Pa]
};

const input::Schema<CfdSection>& cfdSchema();
const input::Schema<PropertiesSection>& propertiesSchema();
const input::Schema<ConstantsSection>& constantsSchema();

/// Reads the `dynamicViscosityModels` of a material.
void readViscosityModels(euler::VaryingDiffusion& varying, const input::Element& material,
                         input::Diagnostics& diagnostics);
/// Writes the manual of `dynamicViscosityModels`.
void describeViscosityModels(std::ostream& out, int indent);

/// The tag `Models`.
struct ModelsSection {
  std::vector<ScalarSettings> scalars;
  std::vector<MassExchange> massExchanges;
  std::vector<BurnModel> burns;
  std::vector<PressureBurn> reactions;
  std::vector<ProgrammedBurn> programs;
  std::optional<BinaryProperties> binary;
  std::optional<TracerSettings> tracers;
};
const input::Schema<ModelsSection>& modelsSchema();

}  // namespace tushar::ice
