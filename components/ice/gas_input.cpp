#include "components/ice/gas_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "components/euler/labels.hpp"
#include "components/ice/gas_schemas.hpp"
#include "components/ice/heating_input.hpp"
#include "components/ice/mixture/input.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::ice {

using input::Diagnostics;
using input::Element;

namespace {

constexpr const char* solverTag = "Solver";

/// The index of the material to which a condition applies; -1 for all materials, or if the id is invalid, which the
/// grid reports.
int materialOf(const Element& condition) {
  return input::parse<int>(condition.attribute("id").value_or("all")).value.value_or(-1);
}

/// Reports an invalid condition of the gas: its value, and derivatives other than 0.
void checkCondition(const Element& condition, Diagnostics& diagnostics) {
  const std::string label = condition.attribute("label").value_or(""), var = condition.attribute("var").value_or("");
  const auto text = condition.child("value");
  if (!text) return;
  const auto number = input::parse<double>(text->text());
  const auto vector = input::parse<Vec3>(text->text());
  if (var == nameOf(BoundaryKind::neumann)) {
    if ((number && *number != 0) || (vector && *vector != Vec3::Zero()))
      diagnostics.error(
          *text, fmt::format("found '{}', expected 0: a Neumann condition continues {} unchanged outside the grid",
                             text->text(), label));
    return;
  }
  const auto limit = [&](const grid::BoundaryVariable& of, const std::string& unit) {
    if (label == of.name && var == nameOf(BoundaryKind::dirichlet) && number &&
        !input::satisfies(*number, input::positive()))
      diagnostics.error(*text, input::violation(text->text(), input::positive(), unit));
  };
  limit(euler::boundary::density, "kg/m^3");
  limit(euler::boundary::pressure, "Pa");
  limit(euler::boundary::temperature, "K");
}

/// Checks the conditions of the gas, which is material `gas` of the scene, and of the gases that follow it.
void checkConditions(const Element& root, int gas, int gases, Diagnostics& diagnostics) {
  for (const Element& condition : simulation::boundaryConditions(root)) {
    const int material = materialOf(condition);
    if (material >= gas + gases)
      diagnostics.error(condition.whereOf("id"), condition.path(),
                        gases == 1 ? fmt::format("there is no material {}: the gas has index {}", material, gas)
                                   : fmt::format("there is no material {}: the gases have indices {} to {}", material,
                                                 gas, gas + gases - 1));
    if (material >= 0 && material < gas && condition.attribute("label") == euler::boundary::density.name)
      diagnostics.note(condition,
                       fmt::format("does nothing: material {} is a body; the gas has index {}", material, gas));
    const bool isShared = condition.attribute("label") == euler::boundary::pressure.name;
    if (material < 0 || material >= gas || isShared) checkCondition(condition, diagnostics);
  }
}

/// Reports a condition that contradicts the others of its face: a wall that slips, or a side that lets waves out.
void checkBeside(const Element& condition, bool slips, bool relaxes, Diagnostics& diagnostics) {
  const std::string label = condition.attribute("label").value_or(""), var = condition.attribute("var").value_or("");
  const bool isGiven = var == nameOf(BoundaryKind::dirichlet);
  const bool isWall = var == "FreeSlipWall" || var == nameOf(BoundaryKind::symmetry);
  const bool acts = isGiven || isWall || var == "Sine";
  if (slips && !isWall && (acts || var == "LODI"))
    diagnostics.error(condition, "a FreeSlipWall is a plane of symmetry, so it takes no other condition");
  if (relaxes && !slips && acts && !(isGiven && label == euler::boundary::temperature.name))
    diagnostics.error(condition, "with var LODI for the Pressure, only a Temperature may be given as well");
}

/// Reports conditions of faces that contradict one another, or that require another condition.
void checkWords(const Element& root, Diagnostics& diagnostics) {
  const auto group = root.child("Grid") ? root.child("Grid")->child("BoundaryConditions") : std::nullopt;
  for (const Element& face : group ? group->children("Face") : std::vector<Element>()) {
    const auto has = [&](const char* var, const std::string_view label) {
      const auto conditions = face.children("BCType");
      return std::any_of(conditions.begin(), conditions.end(), [&](const Element& one) {
        return one.attribute("var") == var && (label.empty() || one.attribute("label") == label);
      });
    };
    const bool slips = has("FreeSlipWall", ""), relaxes = has("LODI", euler::boundary::pressure.name);
    if (!relaxes && has("LODI", ""))
      diagnostics.error(face, "var LODI for another variable needs var LODI for the Pressure");
    if (has("Sine", euler::boundary::temperature.name) && !has("Sine", euler::boundary::pressure.name) &&
        !has("Sine", euler::boundary::velocity.name))
      diagnostics.error(face, "var Sine for the Temperature needs var Sine for the Pressure or the Velocity");
    for (const Element& condition : face.children("BCType")) checkBeside(condition, slips, relaxes, diagnostics);
  }
}

/// Notes a given pressure that differs from the one that follows from density and temperature; as in Uintah, it is
/// ignored.
void noteOtherPressure(const GasBody& body, const euler::Gas& gas, const Element& element, Diagnostics& diagnostics) {
  if (!body.pressure) return;
  if (!body.pressure->isConstant() || !body.density.isConstant() || !body.temperature.isConstant()) return;
  const double given = (*body.pressure)(Vec3::Zero());
  const double density = body.density(Vec3::Zero());
  const double pressure = gas.pressureOf(density, gas.lastAt(density, body.temperature(Vec3::Zero())));
  if (std::abs(given - pressure) > 1e-3 * pressure)
    diagnostics.note(
        *element.child("pressure"),
        fmt::format("does nothing: the pressure follows from density and temperature, and is {:g} Pa", pressure));
}

/// The Dirichlet condition of a face for the gas, if it has one; the pressure is shared with material 0.
std::optional<Element> dirichletOf(const Element& face, const grid::BoundaryVariable& label, int gas) {
  const bool isShared = label.name == euler::boundary::pressure.name;
  for (const Element& condition : face.children("BCType")) {
    const int material = materialOf(condition);
    if (condition.attribute("label") == label.name && condition.attribute("var") == nameOf(BoundaryKind::dirichlet) &&
        (material < 0 || material == gas || (isShared && material == 0)))
      return condition;
  }
  return {};
}

/// Checks that density, pressure and temperature agree at faces with all three, as two determine the third.
void checkInflows(const Element& root, const euler::Gas& gas, Diagnostics& diagnostics) {
  const auto sides = root.child("Grid") ? root.child("Grid")->child("BoundaryConditions") : std::nullopt;
  if (!sides) return;
  const auto valueOf = [](const Element& condition) -> std::optional<double> {
    const auto text = condition.child("value");
    return text ? input::parse<double>(text->text()).value : std::nullopt;
  };
  for (const Element& face : sides->children("Face")) {
    const auto density = dirichletOf(face, euler::boundary::density, gas.material),
               pressure = dirichletOf(face, euler::boundary::pressure, gas.material),
               temperature = dirichletOf(face, euler::boundary::temperature, gas.material);
    if (!density || !pressure || !temperature) continue;
    const auto rho = valueOf(*density), p = valueOf(*pressure), t = valueOf(*temperature);
    if (!rho || !p || !t) {
      diagnostics.error(*temperature,
                        "the temperature already follows from Density and Pressure; keep two of the three");
      continue;
    }
    const double fitting = *p / (gas.gasConstant() * *rho);
    if (std::abs(*t - fitting) <= 1e-3 * fitting) continue;
    if (std::abs(*t - fitting) <= 1e-2 * fitting)  // rounded, or changed a little in one of them
      diagnostics.note(
          *temperature,
          fmt::format("does nothing: the temperature follows from Density and Pressure, and is {:g} K", fitting));
    else
      diagnostics.error(*temperature,
                        fmt::format("found {:g} K, but the Density, at {}, and the Pressure, at {}, give {:g} K; keep "
                                    "two of the three",
                                    *t, density->where().text(), pressure->where().text(), fitting));
  }
}

/// Whether a volume fraction is a number, and this one.
bool isShareOf(const GasBody& body, double share) {
  return body.share && body.share->isConstant() && (*body.share)(Vec3::Zero()) == share;
}

/// Reads a gas and its state at the start into the settings that it shares with others. `besideBodies`: a region with
/// none of a single gas is a body's, and what space it leaves has the gas around it.
void readMaterial(const GasMaterial& material, const Element& element, bool besideBodies, euler::Settings& settings,
                  Diagnostics& diagnostics) {
  settings.name = material.name;
  euler::Gas& gas = settings.gas;
  gas.gamma = material.gamma;
  gas.specificHeat = material.specificHeat;
  gas.pInfinity = material.state.pInfinity;
  gas.law = material.state.law(material.specificHeat);
  const auto tags = element.children("geom_object");
  for (std::size_t k = 0; k < material.bodies.size(); ++k) {
    const GasBody& body = material.bodies[k];
    if (besideBodies && isShareOf(body, 0)) continue;
    settings.objects.push_back({.where = body.where,
                                .shape = body.shape,
                                .density = body.density,
                                .pressure = {},
                                .velocity = body.velocity,
                                .temperature = body.temperature,
                                .share = body.share});
    if (k < tags.size()) noteOtherPressure(body, gas, tags[k], diagnostics);
  }
}

/// Checks that a single gas fills its regions, or leaves them to bodies.
void checkShares(const GasMaterial& material, bool besideBodies, Diagnostics& diagnostics) {
  for (const GasBody& body : material.bodies)
    if (body.share && !isShareOf(body, 1) && !(besideBodies && isShareOf(body, 0)))
      diagnostics.error(body.share->where(), "MaterialProperties/ICE/material/geom_object/volumeFraction",
                        fmt::format("found '{}', expected 1: a single gas fills the region", body.share->text()));
}

/// The diffusion of a gas, with the eddies of the scene.
euler::VaryingDiffusion varyingOf(const GasMaterial& material, const GasScene& scene) {
  euler::VaryingDiffusion varying = material.varying;
  varying.uniform = {material.viscosity, material.conductivity};
  varying.smagorinsky = scene.varying.smagorinsky;
  return varying;
}

void readOneGas(const GasMaterial& material, const Element& element, GasScene& scene, Diagnostics& diagnostics) {
  scene.specificHeat = material.specificHeat;
  scene.viscosity = material.viscosity;
  scene.conductivity = material.conductivity;
  scene.varying = varyingOf(material, scene);
  const bool besideBodies = scene.gas.gas.material > 0;  // which are numbered before it
  readMaterial(material, element, besideBodies, scene.gas, diagnostics);
  checkShares(material, besideBodies, diagnostics);
  if (scene.implicit && scene.gas.gas.isBarotropic())
    diagnostics.error(scene.implicit->where, "CFD/ICE/ImplicitSolver",
                      "is not available with JWLC or Murnaghan, whose pressure does not depend on the energy: remove "
                      "it, or run with --set CFD/ICE/explicit=true");
}

void readGases(const std::vector<GasMaterial>& materials, const Element& root, GasScene& scene,
               Diagnostics& diagnostics) {
  const auto elements = root.child("MaterialProperties")->child("ICE")->children("material");
  for (std::size_t k = 0; k < materials.size(); ++k) {
    euler::Settings settings = scene.gas;
    settings.where = elements[k].where();
    settings.gas.material += static_cast<int>(k);
    readMaterial(materials[k], elements[k], false, settings, diagnostics);
    if (settings.name.empty()) settings.name = fmt::format("gas{}", k);
    scene.mixture.push_back(settings);
    scene.diffusions.push_back({materials[k].viscosity, materials[k].conductivity});
  }
  checkMixture(materials, root, scene, scene.gas.gas.material, diagnostics);
}

bool isImplicit(const IceSection& ice) { return ice.implicit && !ice.isExplicit; }

/// Sections of implicit steps that have no effect in Tushar.
void noteIdle(const Element& root, const IceSection& ice, Diagnostics& diagnostics) {
  if (const auto solver = root.child(solverTag))
    diagnostics.note(*solver, isImplicit(ice) ? "does nothing: the settings of the solve are in <ImplicitSolver>"
                                              : "does nothing: explicit steps solve no system of equations");
  if (ice.steps && !isImplicit(ice))
    diagnostics.note(*root.child("CFD")->child("ICE")->child("TimeStepControl"),
                     "does nothing: steps follow from <cfl>, and from the sound speed and the diffusion in each cell");
}

/// The smallest tolerance: Uintah's scenes require residuals down to 1e-22, which rounding does not allow.
constexpr double leastTolerance = 1e-12;

ImplicitPressure implicitPressureOf(const IceSection& ice) {
  ImplicitPressure read;
  read.where = ice.implicit->where;
  read.soundSpeedKnob = ice.steps.value_or(StepSection()).soundSpeedKnob;
  if (const auto& hypre = ice.implicit->hypre) {
    read.solver.solver = hypre->solver;
    read.solver.preconditioner = hypre->preconditioner;
    read.solver.tolerance = std::clamp(hypre->tolerance, leastTolerance, 0.1);
    read.solver.maxIterations = hypre->maxIterations;
  }
  if (ice.implicit->solver) read.solver = *ice.implicit->solver;
  return read;
}

/// Why a gas beside bodies takes explicit steps though the scene has an <ImplicitSolver>; empty if it does not.
std::string whyExplicit(const std::vector<GasMaterial>& materials, const GasScene& scene) {
  if (!scene.burns.empty()) return "with a body that burns";
  if (materials.size() > 1) return "with several gases beside bodies";
  const auto kind = materials.front().state.kind;
  if (kind != EquationOfState::Kind::ideal && kind != EquationOfState::Kind::stiffened)
    return "beside bodies in a gas that is neither ideal nor stiffened";
  return "";
}

/// Takes the settings of implicit steps, or notes why steps are explicit.
void takeImplicitSteps(const IceSection& ice, const std::vector<GasMaterial>& materials, const Element& root,
                       int solids, GasScene& scene, Diagnostics& diagnostics) {
  if (!isImplicit(ice)) return;
  const std::string why = solids > 0 ? whyExplicit(materials, scene) : "";
  if (why.empty())
    scene.implicit = implicitPressureOf(ice);
  else
    diagnostics.note(*root.child("CFD")->child("ICE")->child("ImplicitSolver"),
                     fmt::format("does nothing: {} steps are explicit, so that sound limits them", why));
}

/// Refuses features of a gas that are not available with bodies.
void refuseBesideBodies(const Element& root, const IceSection& ice, Diagnostics& diagnostics) {
  const Element tag = *root.child("CFD")->child("ICE");
  const char* sentence = "is not available with bodies: remove it, or keep only the gas";
  if (ice.push) diagnostics.error(*tag.child("fixedPressureGradient"), sentence);
}

/// Sorts the models of a scene. Exchanges of mass from a body to a gas are a way to burn.
void takeModels(ModelsSection& models, const Element& root, int solids, GasScene& scene, Diagnostics& diagnostics) {
  scene.scalars = std::move(models.scalars);
  scene.massExchanges = std::move(models.massExchanges);
  scene.burns = std::move(models.burns);
  std::set<std::string> bodies;
  const auto mpm = root.child("MaterialProperties")->child("MPM");
  for (const Element& material : mpm ? mpm->children("material") : std::vector<Element>())
    bodies.insert(material.attribute("name").value_or(""));
  const auto isOfBody = [&](const MassExchange& one) { return bodies.contains(one.from); };
  for (const MassExchange& one : scene.massExchanges)
    if (isOfBody(one)) scene.burns.push_back({one.where, one.from, one.to, 0, 0, 0, Decay{one.rate, one.startTime}});
  std::erase_if(scene.massExchanges, isOfBody);
  if (solids == 0 && !scene.burns.empty())
    diagnostics.error(scene.burns.front().where, "Models/Model",
                      "burns a body, but the scene has none: it needs <MaterialProperties><MPM> and "
                      "<SimulationComponent type=\"mpmice\"/>");
}

/// Half the size of the first Level's Box, m: the centre of Uintah's <counterflow>.
Vec3 middleOf(const Element& root) {
  const auto grid = root.child("Grid");
  const auto level = grid ? grid->child("Level") : std::nullopt;
  const auto box = level ? level->child("Box") : std::nullopt;
  const auto corner = [&](const char* name) {
    const auto tag = box ? box->child(name) : std::nullopt;
    return tag ? input::parse<Vec3>(tag->text()).value.value_or(Vec3::Zero()) : Vec3::Zero();
  };
  return 0.5 * (corner("upper") - corner("lower"));
}

/// Applies the velocity and the temperature of <customInitialization> to the initial gas.
void takeDisturbance(const CustomStart& start, const std::vector<GasMaterial>& materials, const Element& root,
                     euler::Settings& gas, Diagnostics& diagnostics) {
  if (const std::string problem = start.problem(materials.size()); !problem.empty())
    diagnostics.error(*root.child("CFD")->child("ICE")->child("customInitialization"), problem);
  const double gasConstant = (materials.front().gamma - 1) * materials.front().specificHeat;
  gas.disturb = [start, gasConstant, middle = middleOf(root)](const Vec3& point, double rho, Vec3& velocity,
                                                              double& temperature) {
    start.apply(point, {rho, gasConstant, middle}, velocity, temperature);
  };
}

}  // namespace

GasScene readGas(const Element& root, int solids, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const CfdSection cfd = simulation::readSection(root, cfdSchema(), diagnostics);
  const ConstantsSection constants = simulation::readOptionalSection(root, constantsSchema(), diagnostics);
  const PropertiesSection properties = simulation::readSection(root, propertiesSchema(), diagnostics);
  ModelsSection models = simulation::readOptionalSection(root, modelsSchema(), diagnostics);
  noteIdle(root, cfd.ice, diagnostics);
  checkWords(root, diagnostics);
  const auto& materials = properties.ice.materials;
  checkConditions(root, solids, static_cast<int>(std::max<std::size_t>(materials.size(), 1)), diagnostics);
  GasScene scene;
  if (diagnostics.size() > before) return scene;
  scene.where = root.child("CFD")->where();
  scene.gas.where = scene.where;
  scene.gas.section = "MaterialProperties/ICE/material";
  scene.gas.method.reconstruction = cfd.ice.advection.reconstruction;
  scene.gas.cfl = cfd.cfl;
  scene.gas.gas.material = solids;
  scene.thinWalls = cfd.ice.thinWalls;
  takeModels(models, root, solids, scene, diagnostics);
  scene.gravity = constants.gravity;
  scene.referencePressure = constants.referencePressure;
  takeImplicitSteps(cfd.ice, materials, root, solids, scene, diagnostics);
  if (cfd.ice.push) scene.push = Vec3(cfd.ice.push->x, cfd.ice.push->y, cfd.ice.push->z);
  if (cfd.ice.heating) scene.heating = heatingOf(*cfd.ice.heating, solids, materials.size(), diagnostics);
  if (cfd.ice.eddies) scene.varying.smagorinsky = cfd.ice.eddies->constant;
  if (cfd.ice.start) takeDisturbance(*cfd.ice.start, materials, root, scene.gas, diagnostics);
  if (properties.exchange) {
    scene.exchange = properties.exchange->coefficients;
    scene.exchange->heatByMasses = properties.exchange->model.value_or(CoefficientSection()).heat != "constant";
  }
  if (solids > 0) refuseBesideBodies(root, cfd.ice, diagnostics);
  if (materials.size() > 1) {
    readGases(materials, root, scene, diagnostics);
    return scene;
  }
  if (!scene.massExchanges.empty())
    diagnostics.error(scene.massExchanges.front().where, "Models/Model",
                      "there is one gas, which cannot become another");
  readOneGas(materials.front(), *root.child("MaterialProperties")->child("ICE")->child("material"), scene, diagnostics);
  checkInflows(root, scene.gas.gas, diagnostics);
  return scene;
}

std::vector<simulation::SectionForm> gasForms() {
  return {{"CFD", &cfdSchema()},
          {"PhysicalConstants", &constantsSchema(), false},
          {"MaterialProperties", &propertiesSchema()},
          {"Models", &modelsSchema(), false},
          {solverTag, nullptr, false}};
}

std::vector<std::string> gasSections() {
  std::vector<std::string> names;
  for (const simulation::SectionForm& form : gasForms()) names.push_back(form.name);
  return names;
}

std::vector<grid::BoundaryVariable> gasBoundaryLabels() {
  std::vector<grid::BoundaryVariable> all{grid::symmetric, euler::boundary::density, euler::boundary::velocity,
                                          euler::boundary::pressure, euler::boundary::temperature};
  for (const char* name : scalarsAtSides) all.push_back(BoundaryLabel<double>(name));
  return all;
}

void describeGas(std::ostream& out) {
  cfdSchema().describe(out);
  constantsSchema().describe(out);
  propertiesSchema().describe(out);
  modelsSchema().describe(out);
}

}  // namespace tushar::ice
