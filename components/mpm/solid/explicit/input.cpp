#include "components/mpm/solid/explicit/input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "components/mpm/shapes/cpdi_shape.hpp"
#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/loads/load_input.hpp"
#include "components/mpm/solid/material_input.hpp"
#include "components/mpm/solid/scene_input.hpp"
#include "components/mpm/solid/uintah_words.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

enum class Interpolator { linear, gimp, cpdi, quadratic, cubic };

const input::Choices<Interpolator> interpolators{{"linear", Interpolator::linear},
                                                 {"gimp", Interpolator::gimp},
                                                 {"cpdi", Interpolator::cpdi},
                                                 {"fast_cpdi", Interpolator::cpdi},
                                                 {"3rdorderBS", Interpolator::quadratic},
                                                 {"4thorderBS", Interpolator::cubic}};

struct MpmSection {
  int integrator = 0;
  Interpolator interpolator = Interpolator::linear;
  bool artificialViscosity = false, withColor = false, axisymmetric = false, useLoadCurves = false;
  bool conductsHeat = true, xpic = false, affine = false, contactHeats = false, sharesVolume = false;
  std::optional<bool> viscosityHeats;
  double picFraction = 0;
  StressUpdate stressUpdate = StressUpdate::last;
  std::string manufactured;
  double linearViscosity = 0, quadraticViscosity = 0, damping = 0;
  double minimumParticleMass = 0, minimumMassForAcceleration = 0;
  std::optional<double> maximumParticleVelocity;
  int minimumSubcycles = 1;
};

/// What works against compression and motion.
void addDissipation(Schema<MpmSection>& mpm) {
  mpm.value("artificial_viscosity", &MpmSection::artificialViscosity, false, "1", "pressure against compression")
      .value("artificial_viscosity_coeff1", &MpmSection::linearViscosity, 0.2, "1", "factor of c |D| h",
             input::nonNegative())
      .value("artificial_viscosity_coeff2", &MpmSection::quadraticViscosity, 2, "1", "factor of D^2 h^2",
             input::nonNegative())
      .optional("artificial_viscosity_heating", &MpmSection::viscosityHeats, "1",
                "the work of the artificial viscosity heats elastic_plastic and elastic_plastic_hp: true unless told "
                "otherwise, where there is one")
      .value("artificial_damping_coeff", &MpmSection::damping, 0, "1/s", "acceleration against the velocity",
             input::nonNegative());
}

/// What keeps single particles and nodes from ruling the run.
void addLimits(Schema<MpmSection>& mpm) {
  mpm.value("minimum_particle_mass", &MpmSection::minimumParticleMass, 3e-15, "kg",
            "no particle may be as light as that (Uintah takes such out)", input::nonNegative())
      .value("minimum_mass_for_acc", &MpmSection::minimumMassForAcceleration, 1e-199, "kg",
             "a node lighter than that is only accelerated by gravity", input::nonNegative())
      .optional("maximum_particle_velocity", &MpmSection::maximumParticleVelocity, "m/s",
                "a particle that becomes faster is slowed down to 9/10 of it", input::positive())
      .value("minimum_subcycles_for_F", &MpmSection::minimumSubcycles, 1, "1",
             "least number of parts in which a step changes the deformation gradient", input::atLeast(1));
}

/// When stresses are brought forward, and how velocities go from the grid to the particles.
void addUpdates(Schema<MpmSection>& mpm) {
  mpm.choice("stress_update", &MpmSection::stressUpdate,
             {{"usl", StressUpdate::last}, {"musl", StressUpdate::modifiedLast}, {"usf", StressUpdate::first}},
             StressUpdate::last,
             "stresses follow the grid's velocity at the end of the step, the particles' new velocity on the grid, or "
             "the grid's velocity at the start")
      .ours()
      .value("XPIC2", &MpmSection::xpic, false, "1", "velocities by extended PIC of order 2")
      .value("pic_fraction", &MpmSection::picFraction, 0, "1",
             "share of the grid's own velocity in what particles get; the rest is FLIP", input::between(0, 1))
      .ours()
      .value("apic", &MpmSection::affine, false, "1",
             "affine particle-in-cell: particles take the grid's velocity and a moment of it that keeps rotation")
      .ours();
}

/// The space, what acts from outside, and heat.
void addSurroundings(Schema<MpmSection>& mpm) {
  mpm.value("axisymmetric", &MpmSection::axisymmetric, false, "1",
            "x is the radius and y the axis; mass, energy and forces are per radian")
      .value(
          "DoPressureStabilization", &MpmSection::sharesVolume, false, "1",
          "the particles of a cell change their volume as one, so that a nearly incompressible body can bend and shear")
      .value("use_load_curves", &MpmSection::useLoadCurves, false, "1", "the loads of <PhysicalBC> act")
      .value("DoExplicitHeatConduction", &MpmSection::conductsHeat, true, "1", "heat is conducted")
      .value("do_contact_friction_heating", &MpmSection::contactHeats, false, "1",
             "friction between materials heats them, where heat is conducted")
      .choice("RunMMSProblem", &MpmSection::manufactured,
              {{"none", ""},
               {"AxisAligned", "AxisAligned"},
               {"ExpandingRing", "ExpandingRing"},
               {"GeneralizedVortex", "GeneralizedVortex"}},
              "", "start as a manufactured solution, under its body force")
      .value("withColor", &MpmSection::withColor, false, "1",
             "accepted for Uintah's sake: p.color is there where it is saved");
}

void checkDissipation(const MpmSection& read, const Element& element, Diagnostics& diagnostics) {
  if (read.viscosityHeats.value_or(false) && !read.artificialViscosity)
    diagnostics.error(element.child("artificial_viscosity_heating").value(), "needs <artificial_viscosity> true");
}

void checkUpdates(const MpmSection& read, const Element& element, Diagnostics& diagnostics) {
  const bool hasAxisymmetric = read.interpolator == Interpolator::linear || read.interpolator == Interpolator::gimp;
  if (read.axisymmetric && !hasAxisymmetric)
    diagnostics.error(element, "axisymmetric: only with the interpolators linear and gimp");
  if (read.affine && (read.axisymmetric || read.interpolator == Interpolator::cpdi))
    diagnostics.error(element, "apic: neither with axisymmetric nor with the interpolator cpdi; use XPIC2");
  if (read.affine && read.stressUpdate != StressUpdate::last)
    diagnostics.error(element, "apic: only with stress_update usl");
  if (read.affine + read.xpic + (read.picFraction > 0) > 1)
    diagnostics.error(element, "apic, XPIC2 and pic_fraction are three ways to take the velocity: pick one");
}

/// Tags of Uintah's that only implicit steps look at.
constexpr std::array implicitOnly{"with_gauss_solver",
                                  "dynamic",
                                  "solver",
                                  "Solver",
                                  "convergence_criteria_disp",
                                  "convergence_criteria_energy",
                                  "num_iters_to_decrease_delT",
                                  "num_iters_to_increase_delT",
                                  "iters_before_timestep_restart",
                                  "DoImplicitHeatConduction",
                                  "DoTransientImplicitHeatConduction",
                                  "DoMechanics",
                                  "delT_decrease_factor",
                                  "delT_increase_factor",
                                  "temperature_solve"};

/// Uintah divides domains that become longer than so many cells; its default is 1e10.
void refuseShortDomains(MpmSection&, const Element& element, Diagnostics& diagnostics) {
  const auto given = element.child("cpdi_lcrit");
  if (given && input::parse<double>(given->text()).value.value_or(0) < 1e10)
    diagnostics.error(*given, "is not available; domains of cpdi keep the size that the deformation gives them");
}

/// What Uintah has and this method has not, or always does.
void addForeign(Schema<MpmSection>& mpm) {
  addForeignTags(mpm);
  for (const char* tag : implicitOnly) mpm.ignored(tag, "belongs to the implicit method");
  requireSwitch(mpm, "computeColinearNormals", "both sides of a contact have one normal");
  requireSwitch(mpm, "do_grid_reset", "the grid is where it was at the start of each step");
  mpm.custom("cpdi_lcrit", refuseShortDomains, {"cpdi_lcrit"},
             "only 1e10 and more: domains of cpdi keep the size that the deformation gives them")
      .forms({input::typeForm({"cpdi_lcrit"}, std::string(input::typeName<double>))});
}

const Schema<MpmSection>& mpmSchema() {
  static const Schema<MpmSection> schema = [] {
    Schema<MpmSection> mpm("MPM", "The Material Point Method for solids.");
    mpm.choice("time_integrator", &MpmSection::integrator, {{"explicit", 0}}, 0,
               "how time advances; implicit is another method, sus --describe impm")
        .choice("interpolator", &MpmSection::interpolator, interpolators, Interpolator::linear,
                "shape functions: linear, generalised interpolation, convected particle domains (fast_cpdi is another "
                "word for them), quadratic or cubic B-splines");
    addDissipation(mpm);
    addLimits(mpm);
    addUpdates(mpm);
    addSurroundings(mpm);
    mpm.check(checkDissipation).check(checkUpdates);
    addForeign(mpm);
    return mpm;
  }();
  return schema;
}

std::unique_ptr<Component> makeComponent(const Level& level, Interpolator interpolator, Problem problem) {
  settleParticles(level, problem);
  problem.start.domainsDeform = interpolator == Interpolator::cpdi;
  const auto make = [&]<template <int> class Shape>() -> std::unique_ptr<Component> {
    if (level.dimension() == 1) return std::make_unique<SolidMpm<Shape<1>>>(problem);
    if (level.dimension() == 2) return std::make_unique<SolidMpm<Shape<2>>>(problem);
    return std::make_unique<SolidMpm<Shape<3>>>(problem);
  };
  const auto makeAxisymmetric = [&]<template <int> class Shape>() -> std::unique_ptr<Component> {
    if (level.dimension() == 1) return std::make_unique<SolidMpm<Shape<1>>>(problem);
    return std::make_unique<SolidMpm<Shape<2>>>(problem);
  };
  if (problem.start.axisymmetric)
    return interpolator == Interpolator::linear ? makeAxisymmetric.template operator()<AxisymmetricLinearShape>()
                                                : makeAxisymmetric.template operator()<AxisymmetricGimpShape>();
  switch (interpolator) {
    case Interpolator::linear:
      return make.template operator()<LinearShape>();
    case Interpolator::gimp:
      return make.template operator()<GimpShape>();
    case Interpolator::cpdi:
      return make.template operator()<CpdiShape>();
    case Interpolator::quadratic:
      return make.template operator()<QuadraticShape>();
    default:
      return make.template operator()<CubicShape>();
  }
}

Method settle(const MpmSection& read, const PhysicalConstants& constants) {
  Method method;
  method.gravity = constants.gravity;
  method.damping = read.damping;
  if (read.artificialViscosity) method.viscosity = {read.linearViscosity, read.quadraticViscosity};
  method.minimumMassForAcceleration = read.minimumMassForAcceleration;
  method.maximumParticleVelocity = read.maximumParticleVelocity;
  method.minimumSubcyclesForF = read.minimumSubcycles;
  method.conductsHeat = read.conductsHeat;
  method.stressUpdate = read.stressUpdate;
  method.picFraction = read.affine ? 1 : read.picFraction;
  method.xpic = read.xpic;
  method.affine = read.affine;
  method.viscosityHeats = read.artificialViscosity && read.viscosityHeats.value_or(true);
  method.contactHeats = read.contactHeats;
  method.sharesVolume = read.sharesVolume;
  return method;
}

/// Loads that something else in the scene would put out of effect.
void checkLoads(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  const Loads& loads = problem.start.loads;
  if (problem.start.solution && (loads.hasForces() || loads.hasHeat()))
    diagnostics.error(root.child("PhysicalBC").value(), "<RunMMSProblem> has loads of its own: take these out");
  for (const SurfaceLoad& load : loads.surfaces)
    if (load.material >= static_cast<int>(problem.materials.size()))
      diagnostics.error(root.child("PhysicalBC").value(),
                        fmt::format("load_curve/material: there is no material {}: they are counted from 0 to {}",
                                    load.material, problem.materials.size() - 1));
  if (loads.hasHeat() && !problem.method.conductsHeat)
    diagnostics.error(root.child("PhysicalBC").value(), "heat_flux: needs <DoExplicitHeatConduction> true");
}

}  // namespace

simulation::MakeComponent readScene(const Element& root, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const MpmSection read = simulation::readSection(root, mpmSchema(), diagnostics);
  const auto constants = root.child("PhysicalConstants");
  const Method method = settle(read, constants ? constantsSchema().read(*constants, diagnostics) : PhysicalConstants{});
  const MaterialProperties properties = simulation::readSection(root, propertiesSchema(), diagnostics);
  if (diagnostics.size() > before) return {};
  Problem problem{method, properties.mpm.materials, properties.mpm.contacts, {}};
  for (Contact& contact : problem.contacts) {
    contact.actsTwice = contact.actsTwice || read.xpic;
    contact.normalsInCells = read.axisymmetric;
  }
  problem.method.thermalContact = properties.mpm.thermalContact.has_value();
  problem.start = {read.axisymmetric, readLoads(root, read.useLoadCurves, diagnostics),
                   makeManufactured(read.manufactured)};
  problem.start.leastMass = read.minimumParticleMass;
  nameMaterials(problem.materials);
  checkHeat(problem, root, diagnostics);
  checkLoads(problem, root, diagnostics);
  for (const Contact& contact : problem.contacts)
    if (problem.start.axisymmetric && contact.volumeConstraint > 0)
      diagnostics.error(root.child("MPM")->child("axisymmetric").value(),
                        "volume_constraint of <contact> compares volumes, which are per radian here: leave it out");
  for (const Material& material : problem.materials) {
    if (problem.start.solution && material.model->name() != "cnh_mms")
      diagnostics.error(root.child("MPM")->child("RunMMSProblem").value(),
                        "is made for the constitutive model cnh_mms, but '" + material.name + "' is " +
                            std::string(material.model->name()));
  }
  if (diagnostics.size() > before) return {};
  return [interpolator = read.interpolator, problem, where = root.child("MPM")->where()](const Level& level) {
    if (problem.start.axisymmetric) refuseCellsAround(level, where);
    return makeComponent(level, interpolator, problem);
  };
}

std::vector<simulation::SectionForm> forms() { return sectionForms(mpmSchema()); }

void describe(std::ostream& out) {
  mpmSchema().describe(out);
  constantsSchema().describe(out);
  propertiesSchema().describe(out);
  describeLoads(out);
}

}  // namespace tushar::mpm::solid
