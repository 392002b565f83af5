#include "components/mpm/input.hpp"

#include <fmt/format.h>

#include "components/mpm/conserving/conserving_mpm.hpp"
#include "components/mpm/mpm.hpp"
#include "components/mpm/solid/implicit/input.hpp"
#include "components/mpm/solid/input.hpp"
#include "core/input/geometry.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::mpm {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

const Schema<Redistribution>& redistributeSchema() {
  using Mode = Redistribution::Mode;
  static const Schema<Redistribution> schema =
      Schema<Redistribution>("redistribute", "New particles where a cell holds too few or too many.")
          .location(&Redistribution::where)
          .choice("mode", &Redistribution::mode, {{"split_merge", Mode::splitMerge}, {"reseed", Mode::reseed}},
                  Mode::splitMerge, "halve large particles and join near ones, or put new ones at midpoints")
          .ours()
          .value("min_particles", &Redistribution::minParticles, 2, "1", "least number in a cell that is not empty",
                 input::positive())
          .ours()
          .value("max_particles", &Redistribution::maxParticles, 16, "1", "greatest number in a cell",
                 input::positive())
          .ours()
          .value("target_particles", &Redistribution::targetParticles, 4, "1", "number in a cell that is seeded anew",
                 input::positive())
          .ours()
          .check([](const Redistribution& r, const Element& element, Diagnostics& diagnostics) {
            if (r.minParticles > r.maxParticles)
              diagnostics.error(element, "min_particles is greater than max_particles");
            if (r.mode == Mode::reseed && (r.targetParticles < r.minParticles || r.targetParticles > r.maxParticles))
              diagnostics.error(element, "target_particles is not between min_particles and max_particles");
          });
  return schema;
}

const Schema<GasDynamics>& gasDynamicsSchema() {
  static const Schema<Viscosity> viscosity =
      Schema<Viscosity>("artificial_viscosity", "Of Monaghan & Pongracic (1985), (16) of the paper.")
          .value("quadratic", &Viscosity::quadratic, 0.6, "1", "C_q", input::nonNegative())
          .ours()
          .value("linear", &Viscosity::linear, 2.75, "1", "C_l", input::nonNegative())
          .ours();
  static const Schema<GasDynamics> schema =
      Schema<GasDynamics>("gas_dynamics", "The gas method of Tran, Kim & Berzins (2009).")
          .value("cfl", &GasDynamics::cfl, 0.2125, "1", "dt max(|v| + c) / h", input::positive())
          .ours()
          .section("artificial_viscosity", &GasDynamics::viscosity, viscosity)
          .ours()
          .value("density_filter", &GasDynamics::densityFilter, true, "1",
                 "smooth extrema of the cells' density, (18) of the paper")
          .ours()
          .choice("volume_model", &GasDynamics::volumeModel,
                  {{"cell_share", VolumeModel::cellShare}, {"tracked", VolumeModel::tracked}}, VolumeModel::cellShare,
                  "particles share their cell's volume, as in the paper, or keep their mass, which conserves mass and "
                  "energy")
          .ours()
          .section("redistribute", &GasDynamics::redistribute, redistributeSchema())
          .ours();
  return schema;
}

const Schema<Remap>& remapSchema() {
  static const Schema<Remap> schema =
      Schema<Remap>("remap", "One new particle per cell, with the mass, momentum and energy of what lies in it.")
          .value("every", &Remap::every, 4, "1", "steps", input::positive())
          .ours()
          .value("overfilled", &Remap::overfilled, 0.02, "1", "or once a cell holds this share more than its volume",
                 input::nonNegative())
          .ours();
  return schema;
}

/// The section as it is written; what is not given follows from the transfer and the dimension.
struct ConservingSection {
  Transfer transfer = Transfer::apic;
  double cfl = 0.5, advectiveCfl = 0.8;
  std::optional<double> longestParticle;
  std::optional<Viscosity> viscosity;
  double heatConduction = 0;
  std::optional<Remap> remap;
};
const Schema<ConservingSection>& conservingSchema() {
  static const Schema<Viscosity> viscosity =
      Schema<Viscosity>("artificial_viscosity", "q = rho |dv| (C_q |dv| + C_l c) where a cell is compressed.")
          .value("quadratic", &Viscosity::quadratic, 1, "1", "C_q", input::nonNegative())
          .ours()
          .value("linear", &Viscosity::linear, 0.5, "1", "C_l", input::nonNegative())
          .ours();
  static const Schema<ConservingSection> schema =
      Schema<ConservingSection>("conserving_gas_dynamics",
                                "A gas method that conserves mass, momentum and total energy.")
          .choice("transfer", &ConservingSection::transfer,
                  {{"apic", Transfer::apic}, {"affine_flip", Transfer::affineFlip}}, Transfer::apic,
                  "particles take the grid's velocity, or, where the gas is smooth, its change: of second order")
          .ours()
          .value("cfl", &ConservingSection::cfl, 0.5, "1", "dt times the speed of signals over h; affine_flip: dt max(c) / h",
                 input::positive())
          .ours()
          .value("advective_cfl", &ConservingSection::advectiveCfl, 0.8, "1", "affine_flip: dt max |v_d| / h",
                 input::between(0.01, 1))
          .ours()
          .optional("longest_particle", &ConservingSection::longestParticle, "1",
                    "length in cells beyond which a particle is halved (2.36 in one dimension with apic, else 1.4); "
                    "halving costs accuracy", input::between(1, 2.9))
          .ours()
          .section("artificial_viscosity", &ConservingSection::viscosity, viscosity)
          .ours()
          .value("artificial_heat_conduction", &ConservingSection::heatConduction, 0, "1",
                 "C_h: heat flows C_h rho h |dv/dx| de/dx h where cells are compressed (Noh 1987); 1 takes wall heating "
                 "away", input::between(0, 1))
          .ours()
          .section("remap", &ConservingSection::remap, remapSchema())
          .ours();
  return schema;
}

ConservingGasDynamics settle(const ConservingSection& read, int dimension) {
  const bool apic = read.transfer == Transfer::apic;
  ConservingGasDynamics method;
  method.transfer = read.transfer;
  method.cfl = read.cfl;
  method.advectiveCfl = read.advectiveCfl;
  method.longestParticle = read.longestParticle.value_or(apic && dimension == 1 ? 2.36 : 1.4);
  method.viscosity = read.viscosity.value_or(apic ? Viscosity{1, 0.5} : Viscosity{0.25, 0.25});
  method.heatConduction = read.heatConduction;
  method.remap = read.remap;
  return method;
}

struct MpmSection {
  int integrator = 0, interpolator = 0;
  std::optional<GasDynamics> gas;
  std::optional<ConservingSection> conserving;
};
const Schema<MpmSection>& mpmSchema() {
  static const Schema<MpmSection> schema =
      Schema<MpmSection>("MPM", "The Material Point Method.")
          .choice("time_integrator", &MpmSection::integrator, {{"explicit", 0}}, 0, "how time advances")
          .choice("interpolator", &MpmSection::interpolator, {{"linear", 0}}, 0, "shape functions")
          .section("gas_dynamics", &MpmSection::gas, gasDynamicsSchema())
          .ours()
          .section("conserving_gas_dynamics", &MpmSection::conserving, conservingSchema())
          .ours()
          .check([](const MpmSection& mpm, const Element& element, Diagnostics& diagnostics) {
            if (mpm.gas.has_value() == mpm.conserving.has_value())
              diagnostics.error(element, std::string(mpm.gas ? "gives both" : "gives neither") +
                                             " <gas_dynamics> and <conserving_gas_dynamics>; keep one");
          });
  return schema;
}

struct ObjectSection {
  Location where;
  std::shared_ptr<const input::GeometryPiece> shape;
  Index3 res{{1, 1, 1}};
  std::optional<input::Expression> density, pressure, temperature;
  input::VectorExpression velocity;
  Placement placement = Placement::midpoint;
  int seed = 0;
};
const Schema<ObjectSection>& objectSchema() {
  static const Schema<ObjectSection> schema =
      Schema<ObjectSection>("geom_object", "A body of material at the start.")
          .custom("shape",
                  [](ObjectSection& object, const Element& element, Diagnostics& diagnostics) {
                    object.where = element.where();
                    object.shape = input::readGeometry(element, diagnostics);
                  },
                  input::geometryNames(), "the body's shape; several are united", input::describeGeometry)
          .required("res", &ObjectSection::res, "1", "particles per cell along x, y, z", input::between(1, 64))
          .value("velocity", &ObjectSection::velocity, input::VectorExpression(), "m/s", "velocity at the start",
                 input::WithoutTime())
          .optional("temperature", &ObjectSection::temperature, "K",
                    "temperature at the start, in place of <pressure>: p = (gamma - 1) rho c_v T", input::positive(),
                    input::WithoutTime())
          .optional("density", &ObjectSection::density, "kg/m^3", "density at the start, if not that of the material",
                    input::positive(), input::WithoutTime())
          .ours()
          .optional("pressure", &ObjectSection::pressure, "Pa", "pressure at the start", input::positive(),
                    input::WithoutTime())
          .ours()
          .choice("placement", &ObjectSection::placement,
                  {{"midpoint", Placement::midpoint}, {"jittered", Placement::jittered}, {"random", Placement::random}},
                  Placement::midpoint,
                  "particles in the middle of equal parts of a cell, anywhere in these parts, or anywhere in the cell")
          .ours()
          .value("seed", &ObjectSection::seed, 0, "1", "another one draws other places", input::nonNegative())
          .ours()
          .check([](const ObjectSection& object, const Element& element, Diagnostics& diagnostics) {
            if (object.pressure.has_value() == object.temperature.has_value())
              diagnostics.error(element, object.pressure ? "gives both <pressure> and <temperature>; keep one"
                                                         : "gives neither <pressure> nor <temperature>");
          });
  return schema;
}

enum class GasType { ideal, stiffened };
struct ModelSection {
  Location where;
  GasType type = GasType::ideal;
  double gamma = 1.4, pInfinity = 0;
  double specificHeat = 717.5;
};
const Schema<ModelSection>& modelSchema() {
  static const Schema<ModelSection> schema =
      Schema<ModelSection>("constitutive_model", "How the material answers to being deformed.")
          .location(&ModelSection::where)
          .requiredChoiceAttribute("type", &ModelSection::type,
                                   {{"ideal_gas", GasType::ideal}, {"stiffened_gas", GasType::stiffened}},
                                   "p = (gamma - 1) rho e, or (gamma - 1) rho e - gamma p_infinity")
          .value("gamma", &ModelSection::gamma, 1.4, "1", "ratio of specific heats", input::greaterThan(1))
          .value("specific_heat", &ModelSection::specificHeat, 717.5, "J/(kg K)",
                 "c_v, for bodies that give a temperature", input::positive())
          .value("p_infinity", &ModelSection::pInfinity, 0, "Pa", "stiffness: 0 for air, about 6e8 for water",
                 input::nonNegative())
          .ours()
          .check([](const ModelSection& model, const Element& element, Diagnostics& diagnostics) {
            if (model.type == GasType::ideal && model.pInfinity > 0)
              diagnostics.error(element, "an ideal_gas has no p_infinity; use type=\"stiffened_gas\"");
          });
  return schema;
}

const Schema<Relaxation>& relaxationSchema() {
  static const Schema<Relaxation> schema =
      Schema<Relaxation>("relaxation", "A source of heat, de/dt = -rate (e - internal_energy), integrated exactly.")
          .required("rate", &Relaxation::rate, "1/s", "how fast", input::nonNegative())
          .ours()
          .required("internal_energy", &Relaxation::internalEnergy, "J/kg", "what the gas goes to", input::positive())
          .ours();
  return schema;
}

struct MaterialSection {
  std::string name;
  std::optional<double> density;
  ModelSection model;
  std::optional<Relaxation> relaxation;
  std::vector<ObjectSection> objects;
  double thermalConductivity = 0, specificHeat = 0;
};
const Schema<MaterialSection>& materialSchema() {
  static const Schema<MaterialSection> schema =
      Schema<MaterialSection>("material", "A material and the bodies made of it.")
          .attributeValue("name", &MaterialSection::name, "gas", "1", "its name")
          .optional("density", &MaterialSection::density, "kg/m^3", "density at the start", input::positive())
          .requiredSection("constitutive_model", &MaterialSection::model, modelSchema())
          .section("relaxation", &MaterialSection::relaxation, relaxationSchema())
          .ours()
          .value("thermal_conductivity", &MaterialSection::thermalConductivity, 0, "W/(m K)",
                 "must be 0: the gas method conducts no heat", input::between(0, 0))
          .value("specific_heat", &MaterialSection::specificHeat, 0, "J/(kg K)",
                 "accepted for Uintah's sake: the constitutive model has its own", input::nonNegative())
          .list("geom_object", &MaterialSection::objects, objectSchema(), "a body of material at the start", 1)
          .check([](const MaterialSection& material, const Element& element, Diagnostics& diagnostics) {
            const auto bodies = element.children("geom_object");
            for (std::size_t k = 0; k < material.objects.size(); ++k)
              if (!material.density && !material.objects[k].density)
                diagnostics.error(bodies[k], "has no <density>, and neither has its material");
          });
  return schema;
}

struct MaterialList {
  std::vector<MaterialSection> materials;
};
struct MaterialProperties {
  MaterialList mpm;
};
const Schema<MaterialProperties>& propertiesSchema() {
  static const Schema<MaterialList> list =
      Schema<MaterialList>("MPM", "The materials of the Material Point Method.")
          .list("material", &MaterialList::materials, materialSchema(), "a material", 1);
  static const Schema<MaterialProperties> schema =
      Schema<MaterialProperties>("MaterialProperties", "What there is.")
          .requiredSection("MPM", &MaterialProperties::mpm, list);
  return schema;
}

/// The pressure of a body, from its temperature where it gives that: (gamma - 1) rho c_v T - p_inf.
input::Expression pressureOf(const ObjectSection& object, const input::Expression& density, const ModelSection& model) {
  if (object.pressure) return *object.pressure;
  const std::string text = fmt::format("({})*({})*({})-({})", (model.gamma - 1) * model.specificHeat, density.text(),
                                       object.temperature->text(), model.pInfinity);
  return *input::Expression::parse(text);
}

Gas makeGas(const MaterialSection& material, bool isAlone) {
  Gas gas;
  gas.name = material.name;
  gas.gamma = material.model.gamma;
  gas.pInfinity = material.model.pInfinity;
  gas.carried = isAlone ? 0 : gas.pInfinity;
  gas.where = material.model.where;
  gas.relaxation = material.relaxation;
  for (const ObjectSection& object : material.objects) {
    const input::Expression density = object.density ? *object.density : input::Expression(*material.density);
    gas.objects.push_back({object.where, object.shape, object.res, density, pressureOf(object, density, material.model),
                           object.velocity, object.placement, object.seed});
  }
  return gas;
}

/// The particles of the conserving method fill their cells: they cannot stand just anywhere.
void refusePlacements(const MaterialProperties& properties, Diagnostics& diagnostics) {
  for (const MaterialSection& material : properties.mpm.materials)
    for (const ObjectSection& object : material.objects)
      if (object.placement != Placement::midpoint)
        diagnostics.error(object.where, "MaterialProperties/MPM/material/geom_object",
                          "placement: the boxes of <conserving_gas_dynamics> fill the gas; use midpoint, or <gas_dynamics>");
}

/// Several gases at once: by boxes that are never mixed, with the transfer of the default.
void refuseMixtures(const MpmSection& method, const MaterialProperties& properties, Diagnostics& diagnostics) {
  const std::vector<MaterialSection>& materials = properties.mpm.materials;
  if (materials.size() < 2) return;
  const auto refuse = [&](const std::string& why) {
    diagnostics.error(materials[1].model.where, "MaterialProperties/MPM/material", why);
  };
  if (method.gas) refuse("<gas_dynamics> takes one material; give it several <geom_object>s, or use <conserving_gas_dynamics>");
  if (!method.conserving) return;
  if (method.conserving->transfer != Transfer::apic) refuse("several gases need <transfer> apic");
  if (method.conserving->remap) refuse("several gases are not mixed by a <remap>; take it out");
  if (method.conserving->heatConduction > 0) refuse("several gases take no <artificial_heat_conduction>");
  for (std::size_t k = 0; k < materials.size(); ++k) {
    if (materials[k].relaxation) refuse("several gases take no <relaxation>");
    for (std::size_t other = 0; other < k; ++other)
      if (materials[k].name == materials[other].name)
        refuse("two materials are called '" + materials[k].name + "'; give each a name of its own");
  }
}

/// The paper's method knows the ideal gas alone.
void refuseStiffness(const MaterialProperties& properties, Diagnostics& diagnostics) {
  for (const MaterialSection& material : properties.mpm.materials)
    if (material.model.type == GasType::stiffened)
      diagnostics.error(material.model.where, "MaterialProperties/MPM/material/constitutive_model",
                        "type: <gas_dynamics> takes an ideal_gas alone; use <conserving_gas_dynamics>");
}

/// Cells that are seeded anew with more than max_particles would be seeded anew in every step.
void checkSeeds(const Redistribution& how, int dimension) {
  const int along = how.seededAlongAxis(dimension);
  const int seeds = static_cast<int>(std::pow(along, dimension));
  if (how.mode != Redistribution::Mode::reseed || seeds <= how.maxParticles) return;
  throw InputError({{how.where, "MPM/gas_dynamics/redistribute",
                     fmt::format("target_particles: {} in a cell become {}, {} along each of {} axes, and max_particles is "
                                 "{}; lower the one or raise the other",
                                 how.targetParticles, seeds, along, dimension, how.maxParticles)}});
}

bool isGas(const Element& root) {
  const auto mpm = root.child("MPM");
  return mpm && (mpm->child("gas_dynamics") || mpm->child("conserving_gas_dynamics"));
}

/// What only scenes of solids may say.
void refuseSolidsOnly(const Element& root, Diagnostics& diagnostics) {
  if (const auto constants = root.child("PhysicalConstants"))
    diagnostics.error(*constants, "a gas knows no <PhysicalConstants>: nothing acts on it but its pressure");
  const auto grid = root.child("Grid");
  const auto conditions = grid ? grid->child("BoundaryConditions") : std::nullopt;
  if (!conditions) return;
  for (const Element& face : conditions->children("Face"))
    for (const Element& condition : face.children("BCType"))
      if (const auto label = condition.attribute("label"); label && (*label == "Velocity" || *label == "Temperature"))
        diagnostics.error(condition, "label: found '" + *label + "', expected 'Symmetric': a gas takes no other");
}

std::unique_ptr<Component> makeComponent(const Level& level, const MpmSection& method, const std::vector<Gas>& gases) {
  if (method.gas && method.gas->redistribute) checkSeeds(*method.gas->redistribute, level.dimension());
  if (method.gas) return simulation::makeByDimension<Mpm>(level, *method.gas, gases);
  return simulation::makeByDimension<ConservingMpm>(level, settle(*method.conserving, level.dimension()), gases);
}

}  // namespace

simulation::ComponentKind kind() {
  simulation::ComponentKind kind;
  kind.name = "mpm";
  kind.sentence = "the Material Point Method: solids, and gas dynamics of Tran, Kim & Berzins";
  kind.sections = {"MPM", "MaterialProperties", "PhysicalConstants", "PhysicalBC"};
  kind.boundaryLabels = {{"Symmetric"}, {"Velocity", true}, {"Temperature", false, true}};
  kind.describe = [](std::ostream& out) {
    solid::describe(out);
    out << "Where <MPM> has <gas_dynamics> or <conserving_gas_dynamics>, instead:\n";
    mpmSchema().describe(out);
    propertiesSchema().describe(out);
  };
  kind.nodesBeyond = [](const Element& root) { return isGas(root) ? 0 : solid::nodesBeyond(root); };
  kind.read = [](const Element& root, Diagnostics& diagnostics) -> simulation::MakeComponent {
    if (!isGas(root)) return (solid::isImplicit(root) ? solid::readImplicitScene : solid::readScene)(root, diagnostics);
    refuseSolidsOnly(root, diagnostics);
    const std::size_t before = diagnostics.size();
    const MpmSection method = simulation::readSection(root, mpmSchema(), diagnostics);
    const MaterialProperties properties = simulation::readSection(root, propertiesSchema(), diagnostics);
    refuseMixtures(method, properties, diagnostics);
    method.conserving ? refusePlacements(properties, diagnostics) : refuseStiffness(properties, diagnostics);
    if (diagnostics.size() > before) return {};
    std::vector<Gas> gases;
    const std::vector<MaterialSection>& materials = properties.mpm.materials;
    for (const MaterialSection& material : materials) gases.push_back(makeGas(material, materials.size() == 1));
    return [method, gases](const Level& level) { return makeComponent(level, method, gases); };
  };
  return kind;
}

}  // namespace tushar::mpm
