#include "components/mpm/solid/explicit/input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "components/mpm/solid/explicit/check_problem.hpp"
#include "components/mpm/solid/explicit/interpolators.hpp"
#include "components/mpm/solid/grains/grain_input.hpp"
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

const input::Choices<Interpolator> interpolators{{"linear", Interpolator::linear},
                                                 {"gimp", Interpolator::gimp},
                                                 {"cpdi", Interpolator::cpdi},
                                                 {"fast_cpdi", Interpolator::cpdi},
                                                 {"3rdorderBS", Interpolator::quadratic},
                                                 {"4thorderBS", Interpolator::cubic}};

struct MpmSection {
  int integrator = 0;
  Interpolator interpolator = Interpolator::linear;
  std::optional<bool> mirrorImages;
  bool artificialViscosity = false, withColor = false, axisymmetric = false, useLoadCurves = false;
  bool conductsHeat = true, loadsAtCorners = false, xpic = false, affine = false, projectsGradient = false,
       contactHeats = false, sharesVolume = false, isGranular = false, turnsPressures = false, oneNormal = true;
  std::optional<bool> viscosityHeats;
  double picFraction = 0;
  StressUpdate stressUpdate = StressUpdate::last;
  std::string manufactured;
  double linearViscosity = 0, quadraticViscosity = 0, damping = 0;
  double minimumParticleMass = 0, minimumMassForAcceleration = 0;
  std::optional<double> maximumParticleVelocity;
  std::optional<double> longestDiagonal;
  bool removesLost = true;
  int minimumSubcycles = 1;
  bool momentumForm = false, prescribesDeformation = false, insertsParticles = false, usesZones = false;
  std::string deformationFile, insertionFile;
};

/// Declares the tags of artificial viscosity and damping.
void addDissipation(Schema<MpmSection>& mpm) {
  mpm.value("artificial_viscosity", &MpmSection::artificialViscosity, false, "1",
            "artificial viscosity: a pressure that opposes compression")
      .value("artificial_viscosity_coeff1", &MpmSection::linearViscosity, 0.2, "1", "factor of c |D| h",
             input::nonNegative())
      .value("artificial_viscosity_coeff2", &MpmSection::quadraticViscosity, 2, "1", "factor of D^2 h^2",
             input::nonNegative())
      .optional("artificial_viscosity_heating", &MpmSection::viscosityHeats, "1",
                "the work of the artificial viscosity heats elastic_plastic and elastic_plastic_hp; true by default")
      .value("artificial_damping_coeff", &MpmSection::damping, 0, "1/s",
             "damping: an acceleration opposed to the velocity", input::nonNegative());
}

/// Declares the tags of limits for single particles and nodes.
void addLimits(Schema<MpmSection>& mpm) {
  mpm.value("minimum_particle_mass", &MpmSection::minimumParticleMass, 3e-15, "kg",
            "smallest allowed mass of a particle (Uintah removes lighter ones)", input::nonNegative())
      .value("minimum_mass_for_acc", &MpmSection::minimumMassForAcceleration, 1e-199, "kg",
             "nodes lighter than this are accelerated only by gravity", input::nonNegative())
      .optional("maximum_particle_velocity", &MpmSection::maximumParticleVelocity, "m/s",
                "particles faster than this are slowed down to 9/10 of this speed", input::positive())
      .optional("cpdi_lcrit", &MpmSection::longestDiagonal, "cells",
                "with the interpolator cpdi: domains of particles are shrunk so that no corner is farther from the "
                "centre; no domain extends farther than a cell along an axis in any case, so that 3^(1/2) and more "
                "do nothing",
                input::positive())
      .choice("lost_particles", &MpmSection::removesLost, {{"remove", true}, {"stop", false}}, true,
              "what happens when a step turns a particle inside out (det F <= 0), deforms it so much that nodes next "
              "to it must have moved farther than a cell, or throws it through a symmetry plane: it "
              "is removed and counted, or the run stops")
      .ours()
      .value("minimum_subcycles_for_F", &MpmSection::minimumSubcycles, 1, "1",
             "smallest number of substeps in which a step updates the deformation gradient; -n: uses the exponential "
             "series of L dt up to power n instead");
}

/// Declares the tags that determine when stresses are updated and how velocities are transferred to the particles.
void addUpdates(Schema<MpmSection>& mpm) {
  mpm.choice("stress_update", &MpmSection::stressUpdate,
             {{"usl", StressUpdate::last}, {"musl", StressUpdate::modifiedLast}, {"usf", StressUpdate::first}},
             StressUpdate::last,
             "the velocity from which stresses are computed: that of the grid at the end of the step (usl), the new "
             "velocity of the particles, interpolated to the grid (musl), or that of the grid at the start (usf); with "
             "usl, the steps after the first one that loses particles are those of musl")
      .ours()
      .value("XPIC2", &MpmSection::xpic, false, "1", "whether particles are updated by extended PIC of order 2")
      .value(
          "UseGradientEnhancedVelocityProjection", &MpmSection::projectsGradient, false, "1",
          "the velocity that particles contribute to nodes includes their velocity gradient; not with heat conduction")
      .value("pic_fraction", &MpmSection::picFraction, 0, "1",
             "fraction of PIC in the velocity update of particles; the rest is FLIP", input::between(0, 1))
      .ours()
      .value("apic", &MpmSection::affine, false, "1",
             "affine particle-in-cell: particles take the velocity of the grid and its first moment, which preserves "
             "rotation")
      .ours()
      .optional("mirror_images", &MpmSection::mirrorImages, "1",
                "whether symmetry planes mirror particles; by default only with B-splines, because Uintah does not")
      .ours()
      .value("UseMomentumForm", &MpmSection::momentumForm, false, "1",
             "from older versions of Uintah: true means <stress_update> musl");
}

/// Declares the tags of the prescribed deformation of bodies, and of particles that enter later.
void addPrescribedMotion(Schema<MpmSection>& mpm) {
  mpm.value("UsePrescribedDeformation", &MpmSection::prescribesDeformation, false, "1",
            "whether all bodies move as prescribed in <PrescribedDeformationFile>, independently of their stress")
      .value("PrescribedDeformationFile", &MpmSection::deformationFile, "time_defgrad_rotation", "1",
             "a file with 14 numbers per point in time: time (s), the components of the deformation gradient row by "
             "row, and the angle (degrees) and axis of a rotation since the previous point")
      .value("InsertParticles", &MpmSection::insertsParticles, false, "1",
             "particles move to their place at the times of <InsertParticlesFile>; until then they wait elsewhere "
             "on the grid, as ordinary bodies")
      .value("InsertParticlesFile", &MpmSection::insertionFile, "", "1",
             "a file with 8 numbers per line, t color x y z u v w: at the time t (s), all particles of this color move "
             "by (x, y, z) m and get the velocity (u, v, w) m/s");
  refuseSwitch(mpm, "exactDeformation", "give <Time> a delt_max that does not exceed the time between points");
}

/// Declares the tags of geometry, external loads and heat.
void addSurroundings(Schema<MpmSection>& mpm) {
  mpm.value("axisymmetric", &MpmSection::axisymmetric, false, "1",
            "x is the radius and y the axis; mass, energy and forces are per radian")
      .value("DoPressureStabilization", &MpmSection::sharesVolume, false, "1",
             "F-bar: the particles of a cell share one change of volume, so that a nearly incompressible body can bend "
             "and shear")
      .value("DoGranularMPM", &MpmSection::isGranular, false, "1",
             "after each step, particles that overlap with the sizes that they have at <critical_density> form "
             "clusters; each cluster of a MatTypeIdx moves to a material of its own")
      .value("use_cohesive_zones", &MpmSection::usesZones, false, "1",
             "whether the zones of each <cohesive_zone> hold bodies together")
      .value("use_load_curves", &MpmSection::useLoadCurves, false, "1", "whether the loads of <PhysicalBC> act")
      .value("computeColinearNormals", &MpmSection::oneNormal, true, "1",
             "for contacts of type friction, friction_bard and approach: true: bodies that meet at a node share one "
             "normal; false: each slides along its own surface")
      .value("use_CBDI_boundary_condition", &MpmSection::loadsAtCorners, false, "1",
             "pressures act at the corners of the faces of particles, whose area changes with F (Sadeghirad, Brannon & "
             "Guilkey 2013). As in Uintah, no pressure acts on particles without a face within 26 degrees of the "
             "surface, and a <torque> is four times as large as given, and acts only where a pressure acts")
      .value(
          "keepPressBCNormalToSurface", &MpmSection::turnsPressures, false, "1",
          "whether pressures rotate with the particles on which they act; otherwise they keep their initial direction")
      .value("DoExplicitHeatConduction", &MpmSection::conductsHeat, true, "1", "whether heat is conducted")
      .value("do_contact_friction_heating", &MpmSection::contactHeats, false, "1",
             "whether friction heats the materials, if heat is conducted")
      .choice("RunMMSProblem", &MpmSection::manufactured,
              {{"none", ""},
               {"AxisAligned", "AxisAligned"},
               {"ExpandingRing", "ExpandingRing"},
               {"GeneralizedVortex", "GeneralizedVortex"}},
              "", "the manufactured solution from which the run starts and whose body force acts")
      .value("withColor", &MpmSection::withColor, false, "1",
             "accepted for compatibility with Uintah: p.color exists if it is saved");
}

void checkDissipation(const MpmSection& read, const Element& element, Diagnostics& diagnostics) {
  if (read.viscosityHeats.value_or(false) && !read.artificialViscosity)
    diagnostics.error(element.child("artificial_viscosity_heating").value(), "needs <artificial_viscosity> true");
}

void checkDomains(const MpmSection& read, const Element& element, Diagnostics& diagnostics) {
  if (read.longestDiagonal && read.axisymmetric)
    diagnostics.note(element.child("cpdi_lcrit").value(), "does nothing with axisymmetric, as in Uintah");
}

bool isSpline(Interpolator shapes) { return shapes == Interpolator::quadratic || shapes == Interpolator::cubic; }

void checkUpdates(const MpmSection& read, const Element& element, Diagnostics& diagnostics) {
  if (read.axisymmetric && isSpline(read.interpolator))
    diagnostics.error(element, "axisymmetric: is available only with the interpolators linear, gimp and cpdi");
  if (read.affine && (read.axisymmetric || read.interpolator == Interpolator::cpdi))
    diagnostics.error(element, "apic: is not available with axisymmetric or the interpolator cpdi; use XPIC2");
  if (read.projectsGradient && (read.affine || read.axisymmetric || read.stressUpdate != StressUpdate::last))
    diagnostics.error(element,
                      "UseGradientEnhancedVelocityProjection: is available only with stress_update usl, without "
                      "axisymmetric and apic");
  if (read.projectsGradient && read.conductsHeat)
    diagnostics.error(element,
                      "UseGradientEnhancedVelocityProjection: temperatures are interpolated without their gradients; "
                      "set <DoExplicitHeatConduction> to false");
  if (read.affine && read.stressUpdate != StressUpdate::last)
    diagnostics.error(element, "apic: is available only with stress_update usl");
  if (read.momentumForm && read.affine) diagnostics.error(element, "UseMomentumForm: is not available with apic");
  if (read.affine + read.xpic + (read.picFraction > 0) > 1)
    diagnostics.error(element, "apic, XPIC2 and pic_fraction are three ways to update the velocity: choose one");
}

/// Tags of Uintah that only implicit steps read.
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
                                  "interpolateParticleTempToGridEveryStep",
                                  "delT_decrease_factor",
                                  "delT_increase_factor",
                                  "temperature_solve"};

/// Declares tags of Uintah for features that this method lacks or always has.
void addForeign(Schema<MpmSection>& mpm) {
  addForeignTags(mpm);
  for (const char* tag : implicitOnly) mpm.ignored(tag, "belongs to the implicit method");
  requireSwitch(mpm, "do_grid_reset", "the grid is reset after each step");
}

const Schema<MpmSection>& mpmSchema() {
  static const Schema<MpmSection> schema = [] {
    Schema<MpmSection> mpm("MPM", "The Material Point Method for solids.");
    mpm.choice("time_integrator", &MpmSection::integrator, {{"explicit", 0}}, 0,
               "the time integrator; for implicit, see sus --describe impm")
        .choice("interpolator", &MpmSection::interpolator, interpolators, Interpolator::linear,
                "shape functions: linear, generalised interpolation (gimp), convected particle domains (cpdi, "
                "fast_cpdi), quadratic or cubic B-splines");
    addDissipation(mpm);
    addLimits(mpm);
    addUpdates(mpm);
    addPrescribedMotion(mpm);
    addSurroundings(mpm);
    mpm.check(checkDissipation).check(checkDomains).check(checkUpdates);
    addForeign(mpm);
    return mpm;
  }();
  return schema;
}

std::unique_ptr<Solids> makeComponent(const Level& level, Interpolator interpolator, Problem problem) {
  settleParticles(level, problem, interpolator == Interpolator::gimp);
  placeZones(level, problem);
  problem.start.domainsDeform = interpolator == Interpolator::cpdi;
  return makeSolids(interpolator, level.dimension(), problem);
}

Method settle(const MpmSection& read, const PhysicalConstants& constants) {
  Method method;
  method.gravity = constants.gravity;
  method.damping = read.damping;
  if (read.artificialViscosity) method.viscosity = {read.linearViscosity, read.quadraticViscosity};
  method.minimumMassForAcceleration = read.minimumMassForAcceleration;
  method.maximumParticleVelocity = read.maximumParticleVelocity;
  if (const double longest = read.longestDiagonal.value_or(2); longest < std::numbers::sqrt3 && !read.axisymmetric)
    method.longestDiagonal = longest;
  method.removesLost = read.removesLost;
  method.minimumSubcyclesForF = read.minimumSubcycles;
  method.conductsHeat = read.conductsHeat;
  method.stressUpdate = read.momentumForm ? StressUpdate::modifiedLast : read.stressUpdate;
  method.picFraction = read.affine ? 1 : read.picFraction;
  method.xpic = read.xpic;
  method.affine = read.affine;
  method.projectsGradient = read.projectsGradient;
  method.viscosityHeats = read.artificialViscosity && read.viscosityHeats.value_or(true);
  method.contactHeats = read.contactHeats;
  method.loadsAtCorners = read.loadsAtCorners;
  method.sharesVolume = read.sharesVolume;
  method.turnsPressures = read.turnsPressures;
  return method;
}

/// Whether a failed step is repeated with half of its length.
bool repeatsSteps(const Element& root) {
  const auto time = root.child("Time");
  const auto tag = time ? time->child("recompute_timestep") : std::nullopt;
  return tag && input::parse<bool>(tag->text()).value.value_or(false);
}

/// The motion of all bodies, if the scene prescribes one.
std::shared_ptr<const PrescribedDeformation> readMotion(const MpmSection& read, const Element& root,
                                                        Diagnostics& diagnostics) {
  if (!read.prescribesDeformation) return {};
  const auto file = root.child("MPM")->child("PrescribedDeformationFile");
  if (read.axisymmetric)
    diagnostics.error(root.child("MPM")->child("axisymmetric").value(),
                      "is not available with UsePrescribedDeformation");
  const auto motion =
      readPrescribedDeformation(read.deformationFile, (file ? *file : *root.child("MPM")).where(), diagnostics);
  return motion ? std::make_shared<PrescribedDeformation>(*motion) : nullptr;
}

/// The particles that enter later, if the scene has any.
std::vector<Insertion> readEntering(const MpmSection& read, const Element& root, Diagnostics& diagnostics) {
  if (!read.insertsParticles) return {};
  const Element mpm = root.child("MPM").value();
  return readInsertions(read.insertionFile, mpm.child("InsertParticlesFile").value_or(mpm).where(), diagnostics);
}

/// Throws InputError at the location of <MPM> if bodies are deformed along an axis that the grid does not use.
void refuseFlat(const Level& level, const Location& where) {
  if (level.dimension() < 3)
    throw InputError({{where, "MPM/UsePrescribedDeformation",
                       "needs a grid in three dimensions: more than one cell along x, y and z"}});
}

/// The settings of the solids in a scene.
struct ReadSolids {
  Interpolator interpolator;
  Problem problem;
  Location where;  ///< location of <MPM>
};

/// Reads a scene with solids; returns none if there are problems, which are all reported to the diagnostics.
std::optional<ReadSolids> readSolids(const Element& root, bool besideGas, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const MpmSection read = besideGas ? simulation::readOptionalSection(root, mpmSchema(), diagnostics)
                                    : simulation::readSection(root, mpmSchema(), diagnostics);
  const Method method = settle(read, simulation::readOptionalSection(root, constantsSchema(besideGas), diagnostics));
  const MaterialProperties properties = simulation::readSection(root, propertiesSchema(besideGas), diagnostics);
  if (diagnostics.size() > before) return {};
  Problem problem{method, properties.mpm.materials, properties.mpm.contacts, {}};
  for (Contact& contact : problem.contacts) {
    contact.actsTwice = contact.actsTwice || (read.xpic && contact.type != Contact::Type::planeFriction);
    contact.normalsInCells = read.axisymmetric;
    contact.oneNormal = read.oneNormal;
    if (besideGas) contact.onlyOnApproach = true;  // the pressure of the gas compresses surfaces that do not touch
    if (contact.hasMaster()) problem.materials[contact.master].isRigid = true;  // as in Uintah
  }
  problem.method.thermalContact = properties.mpm.thermalContact.has_value();
  problem.start = {read.axisymmetric, readLoads(root, {read.useLoadCurves, read.axisymmetric}, diagnostics),
                   makeManufactured(read.manufactured)};
  problem.start.leastMass = read.minimumParticleMass;
  problem.method.removesLost = problem.method.removesLost && !repeatsSteps(root);
  problem.motion = readMotion(read, root, diagnostics);
  problem.method.limitsDeformation = !problem.motion;
  problem.insertions = readEntering(read, root, diagnostics);
  nameMaterials(problem.materials);
  for (Material& material : problem.materials)
    material.hasMirrorImages = read.mirrorImages.value_or(isSpline(read.interpolator));
  settleGrains(problem, {read.isGranular, besideGas}, root, diagnostics);
  settleZones(problem, properties.mpm.zones, {read.usesZones, besideGas, read.axisymmetric}, root, diagnostics);
  checkHeat(problem, root, diagnostics);
  checkProblem(problem, root, diagnostics);
  for (const Material& material : problem.materials)
    if (problem.start.solution && material.model->name() != "cnh_mms")
      diagnostics.error(root.child("MPM")->child("RunMMSProblem").value(),
                        "needs the constitutive model cnh_mms, but '" + material.name + "' is " +
                            std::string(material.model->name()));
  if (diagnostics.size() > before) return {};
  return ReadSolids{read.interpolator, std::move(problem), root.child("MPM").value_or(root).where()};
}

std::unique_ptr<Solids> makeComponent(const Level& level, const ReadSolids& read) {
  if (read.problem.start.axisymmetric) refuseCellsAround(level, read.where);
  if (read.problem.motion) refuseFlat(level, read.where);
  refuseShifts(level, read.problem.insertions, read.where);
  return makeComponent(level, read.interpolator, read.problem);
}

simulation::MakeComponent readScene(const Element& root, Diagnostics& diagnostics) {
  const std::optional<ReadSolids> read = readSolids(root, false, diagnostics);
  if (!read) return {};
  return [read = *read](const Level& level) { return makeComponent(level, read); };
}

/// The sections of a scene with solids, for the schemas of editors.
std::vector<std::vector<simulation::SectionForm>> forms() { return {sectionForms(mpmSchema())}; }

}  // namespace

SurroundedSolids readSurrounded(const Element& root, Diagnostics& diagnostics) {
  std::optional<ReadSolids> read = readSolids(root, true, diagnostics);
  if (!read) return {};
  auto make = [read = *read](const Level& level, bool areRigid, std::shared_ptr<const Surroundings> surroundings) {
    ReadSolids solids = read;
    for (Material& material : solids.problem.materials) material.isRigid |= areRigid;
    if (areRigid) solids.problem.method.gravity.setZero();  // the bodies keep their velocities
    solids.problem.surroundings = std::move(surroundings);
    return makeComponent(level, solids);
  };
  return {std::move(make), std::move(read->problem.materials)};
}

void describe(std::ostream& out) {
  mpmSchema().describe(out);
  constantsSchema().describe(out);
  propertiesSchema(false).describe(out);
  describeLoads(out);
}

MethodKind kind() { return {readScene, describe, forms, nodesBeyond}; }

}  // namespace tushar::mpm::solid
