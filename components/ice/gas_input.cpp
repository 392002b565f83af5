#include "components/ice/gas_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "components/euler/labels.hpp"
#include "components/ice/check_conditions.hpp"
#include "components/ice/gas_materials.hpp"
#include "components/ice/gas_schemas.hpp"
#include "components/ice/heating_input.hpp"
#include "components/ice/tracers/input.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::ice {

using input::Diagnostics;
using input::Element;

namespace {

constexpr const char* solverTag = "Solver";

bool isImplicit(const IceSection& ice) { return ice.implicit && !ice.isExplicit; }

/// Adds notes on sections that concern implicit steps but have no effect here.
void noteIdle(const Element& root, bool isImplicit, Diagnostics& diagnostics) {
  if (const auto solver = root.child(solverTag))
    diagnostics.note(*solver, isImplicit ? "does nothing: the settings of the solve are in <ImplicitSolver>"
                                         : "does nothing: explicit steps solve no system of equations");
  const auto steps = root.child("CFD")->child("ICE")->child("TimeStepControl");
  if (const auto knob = steps ? steps->child("knob_for_speedSound") : std::nullopt; knob && !isImplicit)
    diagnostics.note(*knob, "does nothing: the whole speed of sound limits explicit steps");
}

/// The smallest tolerance allowed: Uintah's scenes require residuals down to 1e-22, which rounding errors make
/// impossible.
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

/// The reason why a gas beside bodies takes explicit steps although the scene has an <ImplicitSolver>; empty if there
/// is no such reason.
std::string whyExplicit(const std::vector<GasMaterial>& materials, const GasScene& scene) {
  if (!scene.burns.empty()) return "with a burning body";
  if (materials.size() > 1) return "with bodies in several gases";
  const GasMaterial& gas = materials.front();
  return gas.law() ? "with bodies in a gas that is neither ideal nor stiffened" : "";
}

/// Reads the settings of implicit steps, or notes why steps are explicit.
void takeImplicitSteps(const IceSection& ice, const std::vector<GasMaterial>& materials, const Element& root,
                       int solids, GasScene& scene, Diagnostics& diagnostics) {
  if (!isImplicit(ice)) return;
  const std::string why = solids > 0 ? whyExplicit(materials, scene) : "";
  if (why.empty())
    scene.implicit = implicitPressureOf(ice);
  else
    diagnostics.note(*root.child("CFD")->child("ICE")->child("ImplicitSolver"),
                     fmt::format("does nothing: {}, steps are explicit, so the speed of sound limits them", why));
}

/// Reports features of a gas that are not available together with bodies.
void refuseBesideBodies(const Element& root, const IceSection& ice, Diagnostics& diagnostics) {
  const Element tag = *root.child("CFD")->child("ICE");
  const char* sentence = "is not available with bodies: remove it, or keep only the gas";
  if (ice.push) diagnostics.error(*tag.child("fixedPressureGradient"), sentence);
}

/// Distributes the models of a scene over its settings. Exchanges of mass from a body to a gas are treated as burning.
void takeModels(ModelsSection& models, const Element& root, int solids, GasScene& scene, Diagnostics& diagnostics) {
  scene.scalars = std::move(models.scalars);
  scene.massExchanges = std::move(models.massExchanges);
  scene.burns = std::move(models.burns);
  scene.programs = std::move(models.programs);
  scene.reactions = std::move(models.reactions);
  scene.binary = std::move(models.binary);
  scene.tracers = std::move(models.tracers);
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

/// The vector of a tag of the first Level, such as <spacing>, or of its Box; none if there is no such tag.
std::optional<Vec3> ofLevel(const Element& root, const char* name) {
  const auto grid = root.child("Grid");
  const auto level = grid ? grid->child("Level") : std::nullopt;
  const auto box = level ? level->child("Box") : std::nullopt;
  auto tag = box ? box->child(name) : std::nullopt;
  if (!tag && level) tag = level->child(name);
  return tag ? input::parse<Vec3>(tag->text()).value : std::nullopt;
}
Vec3 cornerOf(const Element& root, const char* name) { return ofLevel(root, name).value_or(Vec3::Zero()); }

/// Half the size of the Box of the first Level [m]: the centre of Uintah's <counterflow>.
Vec3 middleOf(const Element& root) { return 0.5 * (cornerOf(root, "upper") - cornerOf(root, "lower")); }

/// The number of cells of the first Level along each axis, as given by the scene.
Vec3 cellsOf(const Element& root) {
  if (const auto cells = ofLevel(root, "resolution")) return *cells;
  const auto spacing = ofLevel(root, "spacing");
  return spacing ? Vec3((cornerOf(root, "upper") - cornerOf(root, "lower")).cwiseQuotient(*spacing)) : Vec3::Zero();
}

/// Notes what is lost of vortices that move the gas along an axis with one cell.
void noteFlatVortices(const CustomStart& start, const Element& root, Diagnostics& diagnostics) {
  if (!start.vortices) return;
  const Vec3 cells = cellsOf(root);
  for (const Vortex& vortex : start.vortices->list)
    for (int axis = 0; axis < 3; ++axis)
      if (axis != vortex.axis && cells[axis] > 0 && cells[axis] < 1.5)
        diagnostics.note(
            vortex.where, "CFD/ICE/customInitialization/vortices/vortex",
            fmt::format("does nothing along {1}, along which the grid has one cell, although a vortex about "
                        "{0} moves the gas along it",
                        "xyz"[vortex.axis], "xyz"[axis]));
}

/// Applies the velocity and the temperature of <customInitialization> to the initial gas.
void takeDisturbance(const CustomStart& start, const std::vector<GasMaterial>& materials, const Element& root,
                     GasScene& scene, Diagnostics& diagnostics) {
  noteFlatVortices(start, root, diagnostics);
  euler::Gas gas;
  takeLaw(materials.front(), gas);
  if (const std::string problem = start.problem(scene.binary ? 2 : materials.size(), gas); !problem.empty())
    diagnostics.error(*root.child("CFD")->child("ICE")->child("customInitialization"), problem);
  scene.gas.disturb = [start, gas, middle = middleOf(root)](const Vec3& point, double rho, Vec3& velocity,
                                                            double& temperature) {
    start.apply(point, {rho, gas, middle}, velocity, temperature);
  };
}

/// The density of a gas in the first cell of the grid at the start [kg/m³].
double densityInFirstCell(const GasMaterial& gas, const Element& root) {
  const Vec3 lower = cornerOf(root, "lower");
  Vec3 centre = lower + 0.5 * ofLevel(root, "spacing").value_or(Vec3::Zero());
  if (const auto cells = ofLevel(root, "resolution"))
    centre = lower + 0.5 * (cornerOf(root, "upper") - lower).cwiseQuotient(cells->cwiseMax(1));
  const GasBody* there = &gas.bodies.front();
  for (const GasBody& body : gas.bodies)
    if (body.shape->contains(centre)) there = &body;
  return there->density(centre);
}

/// Lets the pressures that sides prescribe rise by the weight of the gas around the others.
void takeWeight(const IceSection& ice, const std::vector<GasMaterial>& materials, const Element& root, GasScene& scene,
                Diagnostics& diagnostics) {
  if (scene.gravity.isZero(0) || !ice.isHydrostatic.value_or(true)) return;
  const auto around =
      std::find_if(materials.begin(), materials.end(), [](const GasMaterial& one) { return one.isAround; });
  if (around == materials.end()) {
    if (ice.isHydrostatic)
      diagnostics.error(*root.child("CFD")->child("ICE")->child("applyHydrostaticPressure"),
                        "needs a gas with <isSurroundingMatl> true, whose weight is to count");
    return;
  }
  scene.gas.gas.weight = densityInFirstCell(*around, root) * scene.gravity;
  for (euler::Settings& one : scene.mixture) one.gas.weight = scene.gas.gas.weight;
}

/// Settles whether gases stick to walls: whether one of them is viscous.
void settleSticking(GasScene& scene) {
  const auto isViscous = [](const euler::Diffusion& one) { return one.viscosity > 0; };
  scene.gas.gas.sticks = scene.viscosity > 0 || scene.varying.varies() ||
                         std::any_of(scene.diffusions.begin(), scene.diffusions.end(), isViscous);
  for (euler::Settings& one : scene.mixture) one.gas.sticks = scene.gas.gas.sticks;
}

}  // namespace

std::function<void(const Level&)> checkOfAxes(const Element& root, const GasScene& scene) {
  std::vector<euler::GivenVector> all = euler::velocitiesAtSides(root);
  const auto addStart = [&](const euler::Settings& gas) {
    for (euler::GivenVector& one : euler::velocitiesAtStart(gas, "MaterialProperties/ICE/material/geom_object"))
      all.push_back(std::move(one));
  };
  addStart(scene.gas);
  for (const euler::Settings& gas : scene.mixture) addStart(gas);
  const auto constants = root.child("PhysicalConstants");
  if (const auto gravity = constants ? constants->child("gravity") : std::nullopt)
    all.push_back({gravity->where(), gravity->path(), input::VectorExpression(scene.gravity)});
  if (const auto push = root.child("CFD")->child("ICE")->child("fixedPressureGradient"))
    all.push_back({push->where(), push->path(), input::VectorExpression(scene.push)});
  return [all](const Level& level) { euler::refuseAlongFlatAxes(level, all); };
}

void letPressureRise(const GasScene& scene, euler::Settings& gas, std::vector<euler::Settings>& mixture) {
  const auto take = [&](euler::Gas& one) {
    one.gravity = scene.gravity;
    one.push = scene.push;
  };
  take(gas.gas);
  for (euler::Settings& one : mixture) take(one.gas);
}

GasScene readGas(const Element& root, int solids, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const CfdSection cfd = simulation::readSection(root, cfdSchema(), diagnostics);
  const ConstantsSection constants = simulation::readOptionalSection(root, constantsSchema(), diagnostics);
  const PropertiesSection properties = simulation::readSection(root, propertiesSchema(), diagnostics);
  ModelsSection models = simulation::readOptionalSection(root, modelsSchema(), diagnostics);
  const auto& materials = properties.ice.materials;
  checkConditions(root, solids, properties.ice.materials, models.scalars, models.binary.has_value(), diagnostics);
  GasScene scene;
  if (diagnostics.size() > before) return scene;
  scene.where = root.child("CFD")->where();
  scene.gas.where = scene.where;
  scene.gas.section = "MaterialProperties/ICE/material";
  scene.gas.method.reconstruction = cfd.ice.advection.reconstruction;
  scene.gas.courant.number = cfd.cfl;
  scene.gas.gas.material = solids;
  scene.thinWalls = cfd.ice.thinWalls;
  takeModels(models, root, solids, scene, diagnostics);
  scene.gravity = constants.gravity;
  scene.referencePressure = constants.referencePressure;
  takeImplicitSteps(cfd.ice, materials, root, solids, scene, diagnostics);
  if (!cfd.ice.steps.value_or(StepSection()).limitsSum)
    scene.gas.courant.sum = solids > 0 || scene.implicit ? greatestSumWithBodies : greatestSum;
  noteIdle(root, scene.implicit.has_value(), diagnostics);
  if (cfd.ice.push) scene.push = Vec3(cfd.ice.push->x, cfd.ice.push->y, cfd.ice.push->z);
  if (cfd.ice.heating) scene.heating = heatingOf(*cfd.ice.heating, solids, materials.size(), diagnostics);
  if (cfd.ice.eddies) scene.varying.smagorinsky = cfd.ice.eddies->constant;
  if (cfd.ice.start) takeDisturbance(*cfd.ice.start, materials, root, scene, diagnostics);
  if (properties.exchange) {
    scene.exchange = properties.exchange->coefficients;
    scene.exchange->convects = properties.exchange->convects;
    scene.exchange->fluid = properties.exchange->fluid;
    scene.exchange->solid = properties.exchange->solid;
    if (solids == 0 && scene.exchange->convects)
      diagnostics.note(scene.exchange->where, "MaterialProperties/exchange_properties/do_convective_heat_transfer",
                       "does nothing: there are no bodies");
    scene.exchange->heatByMasses = properties.exchange->model.value_or(CoefficientSection()).heat != "constant";
  }
  if (solids > 0) refuseBesideBodies(root, cfd.ice, diagnostics);
  readMaterials(materials, root, solids, scene, diagnostics);
  if (diagnostics.size() == before) takeWeight(cfd.ice, materials, root, scene, diagnostics);
  if (!scene.implicit) letPressureRise(scene, scene.gas, scene.mixture);
  settleSticking(scene);
  if (scene.tracers && diagnostics.size() == before) checkTracers(scene, solids, diagnostics);
  return scene;
}

std::vector<Reaction> reactionsOf(const GasScene& scene) {
  const auto indexOf = [&](const std::string& name) {
    const auto isIt = [&](const euler::Settings& gas) { return gas.name == name; };
    const auto& gases = scene.mixture;
    return static_cast<std::size_t>(std::find_if(gases.begin(), gases.end(), isIt) - gases.begin());
  };
  std::vector<Reaction> reactions;
  for (const PressureBurn& one : scene.reactions) reactions.push_back({indexOf(one.from), indexOf(one.to), one});
  return reactions;
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
