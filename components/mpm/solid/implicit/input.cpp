#include "components/mpm/solid/implicit/input.hpp"

#include <fmt/format.h>

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/solid/grains/grain_input.hpp"
#include "components/mpm/solid/implicit/implicit_mpm.hpp"
#include "components/mpm/solid/loads/load_input.hpp"
#include "components/mpm/solid/material_input.hpp"
#include "components/mpm/solid/scene_input.hpp"
#include "components/mpm/solid/uintah_words.hpp"
#include "core/simulation/by_dimension.hpp"
#include "core/solvers/input.hpp"

namespace tushar::mpm::solid::implicit {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

/// The section `MPM` for implicit time steps.
struct Section {
  int integrator = 0, solver = 0, transient = 0;
  bool gimp = false, useLoadCurves = false, withColor = false, axisymmetric = false;
  bool moves = true, dynamic = true, resetsGrid = true, sharesVolume = false, heat = false;
  double displacement = 1e-10, energy = 4e-10, decreaseFactor = 0.6, increaseFactor = 2;
  int maxIterations = 25, decrease = 12, increase = 4;
  std::optional<solvers::LinearSettings> linear;

  ImplicitMethod method() const {
    ImplicitMethod method;
    method.movesBodies = moves;
    method.dynamic = dynamic;
    method.resetsGrid = resetsGrid;
    method.sharesVolume = sharesVolume;
    method.conductsHeat = heat;
    method.newton.displacement = displacement;
    method.newton.energy = energy;
    method.newton.maxIterations = maxIterations;
    if (linear) method.newton.linear = method.heat = *linear;
    method.iterationsToDecrease = decrease;
    method.iterationsToIncrease = increase;
    method.decreaseFactor = decreaseFactor;
    method.increaseFactor = increaseFactor;
    return method;
  }
};

void declareSteps(Schema<Section>& schema) {
  schema
      .value("convergence_criteria_disp", &Section::displacement, 1e-10, "1",
             "Newton's iteration ends when the square of the latest change of displacement, relative to the "
             "square of the largest change, is below this",
             input::positive())
      .value(
          "convergence_criteria_energy", &Section::energy, 4e-10, "1",
          "Newton's iteration ends only when the product of the latest change and the residual before it, relative to "
          "the first such product, is also below this",
          input::positive())
      .value("iters_before_timestep_restart", &Section::maxIterations, 25, "1",
             "largest number of Newton iterations; if more are needed, the step is repeated with half the time step",
             input::atLeast(1))
      .value("num_iters_to_decrease_delT", &Section::decrease, 12, "1",
             "after this many iterations or more, the next time step is shorter", input::atLeast(1))
      .value("num_iters_to_increase_delT", &Section::increase, 4, "1",
             "after at most this many iterations, the next time step is longer", input::nonNegative())
      .value("delT_decrease_factor", &Section::decreaseFactor, 0.6, "1", "factor by which the time step is shortened",
             input::between(0.1, 1))
      .value("delT_increase_factor", &Section::increaseFactor, 2, "1", "factor by which the time step is lengthened",
             input::atLeast(1));
}

/// Notes that nodes do not keep the temperatures of the first step; in Uintah, every step conducts heat from those
/// temperatures.
void noteFrozenTemperature(Section&, const Element& element, Diagnostics& diagnostics) {
  const auto given = element.child("interpolateParticleTempToGridEveryStep");
  const auto conducts = element.child("DoImplicitHeatConduction");
  if (given && given->text() == "false" && conducts && conducts->text() == "true")
    diagnostics.note(*given,
                     "in each step, heat is conducted from the current temperatures of the particles; in Uintah, from "
                     "those in the first step");
}

/// Declares tags for the conduction of heat, some of which have only one value in Tushar.
void addHeat(Schema<Section>& mpm) {
  mpm.value("DoMechanics", &Section::moves, true, "1",
            "false: bodies rest, without forces and stresses, and only heat is conducted")
      .value("DoImplicitHeatConduction", &Section::heat, false, "1", "whether heat is conducted, by backward Euler")
      .ignored("DoExplicitHeatConduction", "heat is conducted implicitly if DoImplicitHeatConduction is true")
      .choice("DoTransientImplicitHeatConduction", &Section::transient, {{"true", 0}}, 0, "conduction is transient");
  mpm.custom("interpolateParticleTempToGridEveryStep", noteFrozenTemperature,
             {"interpolateParticleTempToGridEveryStep"},
             "true or false: in either case, nodes take their temperatures from the particles in every step")
      .forms({input::choiceForm({"interpolateParticleTempToGridEveryStep"}, {"true", "false"})});
  mpm.ignored("mirror_images", "implicit steps always mirror particles");
}

const Schema<Section>& sectionSchema() {
  static const Schema<Section> schema = [] {
    Schema<Section> mpm("MPM", "The Material Point Method for solids, with implicit time steps.");
    mpm.choice("time_integrator", &Section::integrator, {{"implicit", 0}}, 0, "the time integrator")
        .choice("interpolator", &Section::gimp, {{"linear", false}, {"gimp", true}}, false,
                "shape functions: linear, or generalised interpolation")
        .value("axisymmetric", &Section::axisymmetric, false, "1",
               "x is the radius and y the axis; mass, energy and forces are per radian")
        .value("dynamic", &Section::dynamic, true, "1",
               "true: Newmark's method; false: no inertia, each step ends in equilibrium");
    mpm.value("do_grid_reset", &Section::resetsGrid, true, "1",
              "false: the grid moves with the solid, particles keep their positions relative to the grid, and their "
              "true positions follow from p.displacement")
        .value("DoPressureStabilization", &Section::sharesVolume, false, "1",
               "F-bar: the particles of a cell share one change of volume, so that nearly incompressible materials do "
               "not lock; for comp_neo_hook, comp_mooney_rivlin, UCNH and comp_neo_hook_plastic");
    declareSteps(mpm);
    mpm.choice("solver", &Section::solver, {{"petsc", 0}, {"simple", 0}, {"amgx", 0}}, 0,
               "the linear solver, which is PETSc for each of the three names")
        .section(
            "Solver", &Section::linear, solvers::tangentSchema(),
            "settings of the linear solver, also for heat conduction, for which the default is conjugate gradients")
        .ours()
        .value("use_load_curves", &Section::useLoadCurves, false, "1", "whether the loads of <PhysicalBC> act")
        .value("withColor", &Section::withColor, false, "1",
               "accepted for compatibility with Uintah: p.color exists if it is saved")
        .ignored("artificial_damping_coeff", "as in Uintah, only explicit steps are damped")
        .ignored("minimum_particle_mass", "no particle is removed")
        .ignored("maximum_particle_velocity", "no particle is slowed down");
    refuseSwitch(mpm, "DoGranularMPM", "only explicit steps let grains separate");
    refuseSwitch(mpm, "artificial_viscosity", "only explicit steps have artificial viscosity");
    refuseSwitch(mpm, "UsePrescribedDeformation", "only explicit steps can follow a prescribed deformation");
    refuseSwitch(mpm, "use_cohesive_zones", "only explicit steps have cohesive zones; give the bodies a <contact>");
    refuseSwitch(mpm, "InsertParticles", "give every body its position at the start");
    refuseSwitch(mpm, "keepPressBCNormalToSurface", "a pressure keeps the initial direction of its surface");
    refuseSwitch(mpm, "temperature_solve", "nodes take the mean temperature of their particles");
    for (const char* tag :
         {"artificial_viscosity_coeff1", "artificial_viscosity_coeff2", "artificial_viscosity_heating",
          "minimum_mass_for_acc", "minimum_subcycles_for_F", "XPIC2", "do_contact_friction_heating", "cpdi_lcrit",
          "computeColinearNormals", "PrescribedDeformationFile", "InsertParticlesFile", "exactDeformation",
          "UseMomentumForm", "UseGradientEnhancedVelocityProjection"})
      mpm.ignored(tag, "as in Uintah, only explicit steps use it");
    addForeignTags(mpm);
    addHeat(mpm);
    refuseSwitch(mpm, "use_CBDI_boundary_condition", "a pressure is shared among the particles at its surface");
    return mpm;
  }();
  return schema;
}

/// Sets the directions of contacts: without a <direction>, bodies follow their master along all axes.
void settleDirections(std::vector<Contact>& contacts) {
  for (Contact& contact : contacts)
    if (!contact.directionIsGiven) contact.direction = {true, true, true};
}

/// Makes a material with <is_rigid> the master of all contacts of type rigid and specified.
void settleMasters(const Element& root, std::vector<Contact>& contacts, Diagnostics& diagnostics) {
  const std::vector<Element> materials = root.child("MaterialProperties")->child("MPM")->children("material");
  const auto isSpecified = [](const Contact& contact) { return contact.type == Contact::Type::specified; };
  bool isKnown = false;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const auto rigid = materials[m].child("is_rigid");
    if (!rigid || rigid->text() != "true") continue;
    if (isKnown) diagnostics.error(*rigid, "only one material can be rigid: the master of the contacts");
    if (std::none_of(contacts.begin(), contacts.end(), isSpecified))
      diagnostics.error(*rigid, "needs a <contact> of type rigid or specified, with this material as its master");
    isKnown = true;
    for (Contact& contact : contacts)
      if (isSpecified(contact)) contact.master = static_cast<int>(m);
  }
}

bool isMaster(const Problem& problem, int material) {
  return std::any_of(problem.contacts.begin(), problem.contacts.end(), [material](const Contact& contact) {
    return contact.type == Contact::Type::specified && contact.master == material;
  });
}

/// Refuses materials without a tangent, except masters of contacts, which do not deform.
void refuseWithoutTangent(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  for (const Material& material : problem.materials) {
    if (material.model->hasTangent() || isMaster(problem, material.index)) continue;
    if (material.thermalExpansion != 0)
      diagnostics.error(root.child("MaterialProperties").value(),
                        "'" + material.name +
                            "' expands with temperature, for which there is no tangent; implicit time steps need one: "
                            "remove linear_thermal_expansion_coef, or take <time_integrator> explicit");
    else
      diagnostics.error(
          root.child("MaterialProperties").value(),
          "'" + material.name + "' is " + std::string(material.model->name()) +
              ", which has no tangent; implicit time steps need one: use comp_neo_hook, comp_mooney_rivlin, "
              "trans_iso_hyper, visco_trans_iso_hyper, hypo_elastic, UCNH or elastic_plastic, or make the material the "
              "master of a <contact> of type rigid or specified");
  }
}

/// Whether a damage model accumulates damage without weakening the material.
bool onlyCounts(const Damage& damage) {
  return std::holds_alternative<NoDamage>(damage) || std::holds_alternative<HancockMackenzieDamage>(damage) ||
         std::holds_alternative<JohnsonCookDamage>(damage);
}

/// Refuses F-bar for materials that do not support it: F-bar changes the F from which the stress follows, and rate
/// models would also need a changed velocity gradient.
void refuseVolumesOfStates(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  for (const Material& material : problem.materials)
    if (!material.model->supportsFBar() && !isMaster(problem, material.index))
      diagnostics.error(root.child("MPM")->child("DoPressureStabilization").value(),
                        "is available with <time_integrator> implicit only for comp_neo_hook, comp_mooney_rivlin, UCNH "
                        "and comp_neo_hook_plastic; '" +
                            material.name + "' is " + std::string(material.model->name()));
}

/// Refuses features that are available only with explicit time steps.
void refuseExplicitOnly(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  const Element where = root.child("MaterialProperties").value();
  for (const Material& material : problem.materials)
    if (material.erosion.acts() || !onlyCounts(material.damage))
      diagnostics.error(where,
                        "'" + material.name +
                            "' may lose strength, which needs <time_integrator> explicit; implicit steps support only "
                            "damage without loss of strength: <damage_model> hancock_mackenzie or johnson_cook, and no "
                            "<erosion>");
  for (const Contact& contact : problem.contacts) {
    if (contact.type == Contact::Type::friction || contact.usesPlanes())
      diagnostics.error(
          where, "contact: friction needs <time_integrator> explicit; in implicit steps all materials move as one");
    if (!contact.angularVelocity.empty())
      diagnostics.error(where, "contact: include_rotation needs <time_integrator> explicit");
    if (contact.excluded >= 0) diagnostics.error(where, "contact: ExcludeMaterial needs <time_integrator> explicit");
    for (const Material& material : problem.materials)
      if (contact.type == Contact::Type::specified && !contact.concerns(material.index))
        diagnostics.error(
            where, "contact: '" + material.name +
                       "' is not among its <materials>; with <time_integrator> implicit, all materials move as one");
  }
}

/// Refuses settings without which heat would not flow as the scene says.
void checkConduction(const Section& read, const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  if (problem.start.loads.hasHeat() && !read.heat)
    diagnostics.error(root.child("PhysicalBC").value(), "heat_flux: needs DoImplicitHeatConduction true");
  if (!read.moves && !read.heat)
    diagnostics.error(root.child("MPM")->child("DoMechanics").value(),
                      "false leaves nothing to compute; set DoImplicitHeatConduction to true, or remove DoMechanics");
}

/// Adds a note that temperature affects metals only through the equation of state; in Uintah's implicit steps, it also
/// strains them.
void noteThermalStrain(const Element& root, Diagnostics& diagnostics) {
  for (const Element& material : root.child("MaterialProperties")->child("MPM")->children("material")) {
    const auto model = material.child("constitutive_model");
    const auto given = model ? model->child("coeff_thermal_expansion") : std::nullopt;
    if (given && input::parse<double>(given->text()).value != 0.0)
      diagnostics.note(*given,
                       "temperature affects the stress only through the equation of state; in Uintah's implicit steps "
                       "it also strains the metal");
  }
}

/// Adds a note if steps become shorter and shorter: each is at most the last one times the factor of <MPM>, times the
/// multiplier of <Time>.
void noteShrinkingSteps(const Section& read, const Element& root, Diagnostics& diagnostics) {
  const auto time = root.child("Time"), tag = time ? time->child("timestep_multiplier") : std::nullopt;
  const std::optional<double> multiplier = tag ? input::parse<double>(tag->text()).value : 1.0;
  if (multiplier && *multiplier > 0 && *multiplier * read.increaseFactor < 1)
    diagnostics.note(*tag, fmt::format("each step is at most {:g} times the last one: timestep_multiplier times "
                                       "delT_increase_factor, as in Uintah, so that steps become shorter and shorter",
                                       *multiplier * read.increaseFactor));
}

/// Whether a boundary condition may concern solids; those of gases have other labels.
bool isOfSolids(std::string_view label) {
  return label == grid::symmetric.name || label == boundary::velocity.name || label == boundary::temperature.name;
}

/// Refuses boundary conditions that implicit steps would ignore: conditions for one of several materials, and a heat
/// flux.
void refuseConditions(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  for (const Element& condition : simulation::boundaryConditions(root)) {
    const std::string id = condition.attribute("id").value_or("all");
    if (!isOfSolids(condition.attribute("label").value_or(""))) continue;
    if (id != "all" && problem.materials.size() > 1)
      diagnostics.error(condition, "id: found '" + id +
                                       "'; with <time_integrator> implicit, materials share their nodes, and a "
                                       "condition applies to all of them");
  }
  refuseHeatFlows(problem, root, diagnostics);
}

template <template <int> class Shape>
std::unique_ptr<Component> makeAxisymmetric(const Level& level, const Problem& problem, const ImplicitMethod& method) {
  if (level.dimension() == 1) return std::make_unique<ImplicitMpm<1>>(problem, shapesOf<Shape<1>>, method);
  return std::make_unique<ImplicitMpm<2>>(problem, shapesOf<Shape<2>>, method);
}

template <template <int> class Shape>
std::unique_ptr<Component> makeComponent(const Level& level, const Problem& problem, const ImplicitMethod& method) {
  if (level.dimension() == 1) return std::make_unique<ImplicitMpm<1>>(problem, shapesOf<Shape<1>>, method);
  if (level.dimension() == 2) return std::make_unique<ImplicitMpm<2>>(problem, shapesOf<Shape<2>>, method);
  return std::make_unique<ImplicitMpm<3>>(problem, shapesOf<Shape<3>>, method);
}

/// Reads a scene with solids and implicit time steps; reports every problem to the diagnostics.
simulation::MakeComponent readScene(const Element& root, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const Section read = simulation::readSection(root, sectionSchema(), diagnostics);
  Problem problem;
  problem.method.gravity = simulation::readOptionalSection(root, constantsSchema(), diagnostics).gravity;
  const MaterialProperties properties = simulation::readSection(root, propertiesSchema(), diagnostics);
  if (diagnostics.size() > before) return {};
  problem.materials = properties.mpm.materials;
  problem.contacts = properties.mpm.contacts;
  settleMasters(root, problem.contacts, diagnostics);
  settleDirections(problem.contacts);
  problem.start.axisymmetric = read.axisymmetric;
  problem.start.loads = readLoads(root, {read.useLoadCurves, read.axisymmetric}, diagnostics);
  nameMaterials(problem.materials);
  settleGrains(problem, {}, root, diagnostics);
  settleZones(problem, properties.mpm.zones, {}, root, diagnostics);
  checkHeat(problem, root, diagnostics);
  checkConduction(read, problem, root, diagnostics);
  if (read.moves) refuseWithoutTangent(problem, root, diagnostics);
  if (read.moves) refuseExplicitOnly(problem, root, diagnostics);
  if (read.moves && read.sharesVolume) refuseVolumesOfStates(problem, root, diagnostics);
  refuseConditions(problem, root, diagnostics);
  if (read.heat) noteThermalStrain(root, diagnostics);
  if (read.moves) noteShrinkingSteps(read, root, diagnostics);
  if (diagnostics.size() > before) return {};
  return [read, problem, where = root.child("MPM")->where()](const Level& level) {
    if (read.axisymmetric) refuseCellsAround(level, where);
    Problem settled = problem;
    settleParticles(level, settled, read.gimp);
    if (read.axisymmetric)
      return read.gimp ? makeAxisymmetric<AxisymmetricGimpShape>(level, settled, read.method())
                       : makeAxisymmetric<AxisymmetricLinearShape>(level, settled, read.method());
    return read.gimp ? makeComponent<GimpShape>(level, settled, read.method())
                     : makeComponent<LinearShape>(level, settled, read.method());
  };
}

}  // namespace

simulation::ComponentKind implicitKind() {
  simulation::ComponentKind kind;
  kind.name = "impm";
  kind.sentence = "the Material Point Method for solids, with implicit time steps";
  kind.sections = {"MPM", "MaterialProperties", "PhysicalConstants", "PhysicalBC"};
  kind.amrSections = {"MPM"};
  kind.boundaryLabels = {grid::symmetric, boundary::velocity, boundary::temperature};
  kind.describe = [](std::ostream& out) {
    sectionSchema().describe(out);
    constantsSchema().describe(out);
    propertiesSchema().describe(out);
    describeLoads(out);
  };
  kind.forms = [] { return std::vector<std::vector<simulation::SectionForm>>{sectionForms(sectionSchema())}; };
  kind.nodesBeyond = nodesBeyond;
  kind.read = readScene;
  return kind;
}

}  // namespace tushar::mpm::solid::implicit
