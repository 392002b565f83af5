#include "components/mpm/input.hpp"

#include <fmt/format.h>

#include "components/mpm/conserving/conserving_mpm.hpp"
#include "components/mpm/materials/gas_input.hpp"
#include "components/mpm/mpm.hpp"
#include "components/mpm/solid/implicit/input.hpp"
#include "components/mpm/solid/input.hpp"
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

/// The particles of the conserving method fill their cells: they cannot stand just anywhere.
void refusePlacements(const GasProperties& properties, Diagnostics& diagnostics) {
  for (const GasSection& material : properties.mpm.materials)
    for (const GasObjectSection& object : material.objects)
      if (object.placement != Placement::midpoint)
        diagnostics.error(object.where, "MaterialProperties/MPM/material/geom_object",
                          "placement: the boxes of <conserving_gas_dynamics> fill the gas; use midpoint, or <gas_dynamics>");
}

/// Several gases at once: by boxes that are never mixed, with the transfer of the default.
void refuseMixtures(const MpmSection& method, const GasProperties& properties, Diagnostics& diagnostics) {
  const std::vector<GasSection>& materials = properties.mpm.materials;
  if (materials.size() < 2) return;
  const auto refuse = [&](const std::string& why) {
    diagnostics.error(materials[1].model.where, "MaterialProperties/MPM/material", why);
  };
  if (method.gas)
    refuse("<gas_dynamics> takes one material; give it several <geom_object>s, or use <conserving_gas_dynamics>");
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
void refuseStiffness(const GasProperties& properties, Diagnostics& diagnostics) {
  for (const GasSection& material : properties.mpm.materials)
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
  kind.boundaryLabels = {{"Symmetric"}, {"Velocity", true, true}, {"Temperature", false, true}};
  kind.describe = [](std::ostream& out) {
    solid::describe(out);
    out << "Where <MPM> has <gas_dynamics> or <conserving_gas_dynamics>, instead:\n";
    mpmSchema().describe(out);
    gasProperties().describe(out);
  };
  kind.nodesBeyond = [](const Element& root) { return isGas(root) ? 0 : solid::nodesBeyond(root); };
  kind.read = [](const Element& root, Diagnostics& diagnostics) -> simulation::MakeComponent {
    if (!isGas(root)) return (solid::isImplicit(root) ? solid::readImplicitScene : solid::readScene)(root, diagnostics);
    refuseSolidsOnly(root, diagnostics);
    const std::size_t before = diagnostics.size();
    const MpmSection method = simulation::readSection(root, mpmSchema(), diagnostics);
    const GasProperties properties = simulation::readSection(root, gasProperties(), diagnostics);
    refuseMixtures(method, properties, diagnostics);
    method.conserving ? refusePlacements(properties, diagnostics) : refuseStiffness(properties, diagnostics);
    if (diagnostics.size() > before) return {};
    std::vector<Gas> gases;
    const std::vector<GasSection>& materials = properties.mpm.materials;
    for (const GasSection& material : materials) gases.push_back(makeGas(material, materials.size() == 1));
    return [method, gases](const Level& level) { return makeComponent(level, method, gases); };
  };
  return kind;
}

}  // namespace tushar::mpm
