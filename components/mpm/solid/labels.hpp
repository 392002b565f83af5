#pragma once

#include "components/mpm/labels.hpp"
#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/transfer/node_record.hpp"
#include "components/mpm/solid/transfer/surface_record.hpp"

namespace tushar::mpm::solid {

/// Labels of particle variables, including those that the gas methods also have.
namespace p {
using namespace mpm::p;
inline constexpr ParticleLabel<Matrix3> stress{"p.stress", "Pa", "Cauchy stress"};
inline constexpr ParticleLabel<Matrix3> deformationMeasure{"p.deformationMeasure", "1", "deformation gradient"};
inline constexpr ParticleLabel<Matrix3> velocityGradient{"p.velGrad", "1/s", "velocity gradient of the latest step"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> displacement{"p.displacement", "m", "displacement since the start"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> size{"p.size", "1", "edge lengths at the start, in cells"};
inline constexpr ParticleLabel<Matrix3> domain{"p.domain", "1", "edges at the start, in cells, one per column"};
inline constexpr ParticleLabel<double> temperature{"p.temperature", "K", "temperature"};
inline constexpr ParticleLabel<double> temperatureChange{"p.temperatureChange", "K",
                                                         "change of temperature due to the work of the step"};
inline constexpr ParticleLabel<double> damage{"p.damage", "1", "damage, 0 if intact"};
inline constexpr ParticleLabel<double> failureThreshold{"p.epsf", "Pa, 1 or Pa^(1/2)", "threshold of damage"};
inline constexpr ParticleLabel<int> localized{"p.localizedMPM", "1", "1 if the particle has failed"};
inline constexpr ParticleLabel<double> failureTime{"p.timeofloc", "s", "time at which the particle failed"};
inline constexpr ParticleLabel<double> color{"p.color", "1", "number that the scene assigns to a body"};
inline constexpr ParticleLabel<int> surface{"p.surface", "1", "1 if the particle starts at the surface of its body"};
inline constexpr ParticleLabel<double> viscosity{"p.q", "Pa", "artificial viscosity"};
inline constexpr ParticleLabel<double> strainEnergy{
    "p.strainEnergy", "J", "strain energy of an elastic particle; for others, its increase in the step"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> smoothVelocity{"p.velocitySSPlus", "m/s",
                                                      "velocity at the start of a step, interpolated from the grid"};
inline constexpr ParticleLabel<Matrix3> affineMoment{
    "p.affineMoment", "m^2/s", "weighted sum of velocity times distance over the nearby nodes (APIC)"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> externalForce{"p.externalforce", "N", "force of loads"};
inline constexpr ParticleLabel<Matrix3> scaleFactor{"p.scalefactor", "m",
                                                    "edges of the particle, deformed by F, one per column"};
/// The work on a particle since the start [J]: one number for each label in total::work.
using Works = Eigen::Matrix<double, 1, 7, Eigen::DontAlign | Eigen::RowMajor>;
inline constexpr ParticleLabel<Works> work{
    "p.work", "J",
    "work on the particle since the start: by loads and gravity, by faces of the grid, by contact; dissipated by "
    "viscosity and damping, stored as strain, dissipated by plastic flow; and 1/2 m v^2 at the start"};
inline constexpr ParticleLabel<double> heatFlux{"p.externalHeatFlux", "W", "heat flow from loads"};
inline constexpr ParticleLabel<int> loadCurves{
    "p.loadCurveID", "1",
    "number of the load on the particle, or 0, plus the numbers of further loads times 256 and 65536"};
}  // namespace p

/// Labels of node variables.
namespace g {
using namespace mpm::g;
inline constexpr NodeLabel<double> volume{"g.volume", "m^3", "volume gathered from particles"};
inline constexpr NodeLabel<Matrix3> stress{"g.stressFS", "Pa",
                                           "Cauchy stress, averaged over the volume of the nearby particles"};
inline constexpr NodeLabel<NodeRecord> record{
    "g.record", "SI units", "velocity, mass, force and volume of a step in progress", Counts::nearParticles};
inline constexpr NodeLabel<NodeRecord> stressRecord{
    "g.stressRecord", "SI units",
    "velocity and mass for the stress update, if its velocity differs from that of the motion", Counts::nearParticles};
inline constexpr NodeLabel<NodeRecord> smoothRecord{
    "g.smoothRecord", "SI units", "p.velocitySSPlus gathered from particles, and mass", Counts::nearParticles};
template <int D>
inline constexpr NodeLabel<Vec<D>> velocityOfForces{"g.velocityOfForces", "m/s",
                                                    "velocity after the forces of a step are applied, before contact",
                                                    Counts::nearParticles};
template <int D>
inline constexpr NodeLabel<Vec<D>> velocityOfContact{
    "g.velocityOfContact", "m/s", "velocity after the forces of a step and contact are applied", Counts::nearParticles};
template <int D>
inline constexpr NodeLabel<Vec<D>> transmittedForce{"g.transmittedForce", "N",
                                                    "contact force on a force-transmitting material"};
template <int D>
inline constexpr NodeLabel<Vec<D>> surroundingForce{"g.surroundingForce", "N",
                                                    "force exerted on the body by its surroundings, such as a gas"};
inline constexpr NodeLabel<NodeRecord> workRecord{"g.workRecord", "SI units",
                                                  "mean velocity of a step, and work per mass", Counts::nearParticles};
inline constexpr NodeLabel<SurfaceRecord> surfaceRecord{
    "g.surfaceRecord", "SI units", "surface of the body at nodes where it meets others, for friction",
    Counts::nearParticles};
template <int D>
inline constexpr NodeLabel<Vec<D>> separatingNormal{
    "g.normAlphaToBeta", "1",
    "normal pointing out of the body with the largest mass at the node, where several bodies touch; 0 elsewhere"};
inline constexpr NodeLabel<double> prominence{"g.matlProminence", "m",
                                              "extent of surface particles along g.normAlphaToBeta"};
inline constexpr NodeLabel<double> color{"g.color", "1", "mass-weighted mean of p.color"};
inline constexpr NodeLabel<double> frictionHeat{"g.frictionHeat", "J", "frictional heat in a step"};
inline constexpr NodeLabel<double> heatCapacity{"g.heatCapacity", "J/K", "heat capacity gathered from particles"};
inline constexpr NodeLabel<double> temperatureNoBC{"g.temperaturenobc", "K", "temperature gathered from particles"};
inline constexpr NodeLabel<double> temperature{"g.temperature", "K", "temperature with the boundary conditions"};
inline constexpr NodeLabel<double> hasGivenTemperature{"g.hasGivenTemperature", "1",
                                                       "1 where a side of the grid gives the temperature, 0 elsewhere"};
inline constexpr NodeLabel<double> givenTemperatureChange{
    "g.givenTemperatureChange", "K", "change with which particles follow a given temperature in the step"};
inline constexpr NodeLabel<double> subgridTemperatureChange{
    "g.subgridTemperatureChange", "K", "change of the temperature by conduction within cells in the step"};
inline constexpr NodeLabel<double> heatRate{"g.heatRate", "W", "heat that reaches the node by conduction"};
inline constexpr NodeLabel<double> contactTemperatureRate{
    "g.contactTemperatureRate", "K/s", "rate of change of the temperature due to contact with other materials"};
inline constexpr NodeLabel<double> temperatureRate{"g.temperatureRate", "K/s", "rate of change of the temperature"};
}  // namespace g

/// Labels of cell variables.
namespace c {
inline constexpr CellLabel<double> stableTimeStep{
    "c.stableTimeStep", "s", "time in which the fastest wave of the cell's particles crosses the cell"};
}  // namespace c

/// Labels of totals over all particles.
namespace total {
using namespace mpm::total;
inline constexpr ReductionLabel<VectorSum> angularMomentum{
    "AngularMomentum", "kg m^2/s", "angular momentum of all particles, about the origin of x, y, z"};
inline constexpr ReductionLabel<Minimum> stableTimeStep{
    "stableTimeStep", "s", "shortest time in which the fastest wave of a cell's particles crosses the cell"};
inline constexpr ReductionLabel<Sum> volume{"TotalVolumeDeformed", "m^3", "volume of all particles, deformed by F"};
inline constexpr ReductionLabel<Sum> thermalEnergy{"ThermalEnergy", "J", "mass times specific heat times temperature"};
inline constexpr ReductionLabel<VectorSum> rigidReactionForce{
    "RigidReactionForce", "N",
    "force by which the master of a contact of type rigid or specified resists the stresses of the other materials"};
inline constexpr ReductionLabel<Sum> strainEnergy{
    "StrainEnergy", "J",
    "strain energy of elastic materials; for others, its increase in the latest step, as in Uintah"};
/// Labels of the sums of the components of p.work, in the same order.
inline constexpr std::array<ReductionLabel<Sum>, 7> work{{
    {"ExternalWork", "J", "work of loads and gravity since the start"},
    {"BoundaryWork", "J", "work of those sides of the grid where a velocity is given, since the start"},
    {"ContactWork", "J", "work of contact since the start: positive from a driven master, negative from friction"},
    {"DissipatedWork", "J", "energy dissipated by artificial viscosity and damping since the start"},
    {"StrainWork", "J",
     "work of the stresses since the start, minus PlasticWork: stored energy, and dissipation in models without "
     "p.plasticStrain"},
    {"PlasticWork", "J", "energy dissipated by plastic flow since the start, in models with p.plasticStrain"},
    {"KineticEnergyAtStart", "J", "initial kinetic energy of the particles that have not left the grid"},
}};
/// Labels of the force of the body on a face of the grid, and of the area of the body on this face.
struct OnFace {
  ReductionLabel<VectorSum> force;
  ReductionLabel<Sum> area;
};
/// Makes both labels; `force` and `area` are their names.
constexpr OnFace onFace(std::string_view force, std::string_view area) {
  return {{force, "N", "force of the body on this face of the grid"},
          {area, "m^2", "area of the body on this face of the grid"}};
}
/// Labels for the faces of the grid in the order x-, x+, y-, y+, z-, z+.
inline constexpr std::array<OnFace, 6> onFaces{
    onFace("BndyForce_xminus", "BndyContactArea_xminus"), onFace("BndyForce_xplus", "BndyContactArea_xplus"),
    onFace("BndyForce_yminus", "BndyContactArea_yminus"), onFace("BndyForce_yplus", "BndyContactArea_yplus"),
    onFace("BndyForce_zminus", "BndyContactArea_zminus"), onFace("BndyForce_zplus", "BndyContactArea_zplus")};
}  // namespace total

}  // namespace tushar::mpm::solid
