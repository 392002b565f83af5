#pragma once

#include <array>
#include <limits>

#include "components/euler/labels.hpp"
#include "components/ice/labels.hpp"
#include "components/mpm/solid/labels.hpp"

namespace tushar::mpmice {

/// Labels of cell variables. The gas variables of `euler`, c.density, c.momentum and c.totalEnergy, are per cell
/// volume, not per volume of the gas in it. Quantities at faces belong to the lower faces of a cell, with one number
/// for each axis.
namespace c {
using namespace euler::c;
using namespace ice::c;
inline constexpr CellLabel<double> freeVolume{"c.freeVolume", "1",
                                              "fraction of the cell that is open to the gas; 0 in narrow holes"};
inline constexpr CellLabel<double> unfilledVolume{"c.unfilledVolume", "1",
                                                  "fraction of the cell that bodies do not fill, including holes"};
template <int D>
inline constexpr CellLabel<Vec<D>> coverage{"c.coverage", "1", "fraction of the lower faces that bodies cover"};
template <int D>
inline constexpr CellLabel<Vec<D>> coverageAtEnd{
    "c.coverageAtEnd", "1", "fraction of the upper faces that bodies cover, on symmetry planes; 0 on other faces"};
/// Labels of each body if there are several.
inline constexpr CellLabel<double> freeOfBody{"c.freeOfBody", "1", "fraction of the cell that the body does not fill"};
template <int D>
inline constexpr CellLabel<Vec<D>> coverageOfBody{"c.coverageOfBody", "1",
                                                  "fraction of the lower faces that the body covers"};
template <int D>
inline constexpr CellLabel<Vec<D>> coverageOfBodyAtEnd{
    "c.coverageOfBodyAtEnd", "1",
    "fraction of the upper faces that the body covers, on symmetry planes; 0 on other faces"};
template <int D>
inline constexpr CellLabel<Vec<D>> swept{
    "c.swept", "1", "volume of bodies that moved upwards through the lower faces, divided by that of a cell"};
template <int D>
inline constexpr CellLabel<Vec<D>> sweptBy{
    "c.sweptBy", "1",
    "mean displacement of the bodies that moved through the lower faces, in cell widths; infinite if none did"};
/// c.sweptBy of faces through which no body moved.
inline constexpr double notSwept = std::numeric_limits<double>::infinity();
template <int D>
inline constexpr CellLabel<Vec<D>> leaving{"c.leaving", "1",
                                           "volume of bodies that left the grid through the faces of the cell in the "
                                           "step, divided by that of a cell"};
/// A pair of labels, each with one number per axis: for the walls at the lower faces of a cell, and for those at the
/// upper faces.
template <int D>
using OnWalls = std::array<CellLabel<Vec<D>>, 2>;
template <int D>
inline constexpr OnWalls<D> wallPressure{{{"c.wallPressureBelow", "Pa", "pressure on walls at the lower faces"},
                                          {"c.wallPressureAbove", "Pa", "pressure on walls at the upper faces"}}};
template <int D>
inline constexpr CellLabel<Vec<D>> wallFriction{"c.wallFriction", "N/m^3",
                                                "friction force of walls on the gas of the cell, per cell volume"};
/// Labels of an implicit step.
template <int D>
inline constexpr euler::StateLabels<D> alone{
    {"c.aloneDensity", "kg/m^3", "mass of the gas, per volume of the gas"},
    {"c.aloneMomentum", "kg/(m^2 s)", "momentum of the gas, per volume of the gas"},
    {"c.aloneEnergy", "J/m^3", "energy of the gas, per volume of the gas"}};
template <int D>
inline constexpr OnWalls<D> wallSpeed{{{"c.wallSpeedBelow", "m/s", "speed of walls at the lower faces"},
                                       {"c.wallSpeedAbove", "m/s", "speed of walls at the upper faces"}}};
template <int D>
inline constexpr OnWalls<D> wallYield{
    {{"c.wallYieldBelow", "m/(s^2 Pa)", "acceleration of walls at the lower faces, per pressure"},
     {"c.wallYieldAbove", "m/(s^2 Pa)", "acceleration of walls at the upper faces, per pressure"}}};
/// Labels of the state after a step before small cells are merged with others.
inline constexpr CellLabel<double> unsharedDensity{"c.unsharedDensity", "kg/m^3",
                                                   "density of the gas before small cells are merged with others"};
template <int D>
inline constexpr CellLabel<Vec<D>> unsharedMomentum{"c.unsharedMomentum", "kg/(m^2 s)",
                                                    "momentum of the gas before small cells are merged with others"};
inline constexpr CellLabel<double> unsharedEnergy{"c.unsharedEnergy", "J/m^3",
                                                  "energy of the gas before small cells are merged with others"};
/// Labels of each of several gases, with the index of the gas: its mass per cell volume, its fraction of the volume of
/// all gases and, before small cells are merged, its mass and its volume, both per cell volume.
inline constexpr std::array<CellLabel<double>, 3> massOfGas{{{"c.massOfGas0", "kg/m^3", "mass of the first gas"},
                                                             {"c.massOfGas1", "kg/m^3", "mass of the second gas"},
                                                             {"c.massOfGas2", "kg/m^3", "mass of the third gas"}}};
inline constexpr std::array<CellLabel<double>, 3> shareOfGas{
    {{"c.shareOfGas0", "1", "fraction of the gas volume that the first gas fills"},
     {"c.shareOfGas1", "1", "fraction of the gas volume that the second gas fills"},
     {"c.shareOfGas2", "1", "fraction of the gas volume that the third gas fills"}}};
inline constexpr std::array<CellLabel<double>, 3> unsharedMass{
    {{"c.unsharedMass0", "kg/m^3", "mass of the first gas, before small cells are merged"},
     {"c.unsharedMass1", "kg/m^3", "mass of the second gas, before small cells are merged"},
     {"c.unsharedMass2", "kg/m^3", "mass of the third gas, before small cells are merged"}}};
inline constexpr std::array<CellLabel<double>, 3> unsharedVolume{
    {{"c.unsharedVolume0", "1", "volume of the first gas, before small cells are merged"},
     {"c.unsharedVolume1", "1", "volume of the second gas, before small cells are merged"},
     {"c.unsharedVolume2", "1", "volume of the third gas, before small cells are merged"}}};
/// Labels of what the gas transfers to bodies, per cell volume: in a step, and since the start.
template <int D>
inline constexpr CellLabel<Vec<D>> impulse{"c.impulseOnBodies", "N s/m^3", "impulse of the gas on walls in the step"};
inline constexpr CellLabel<double> work{"c.workOnBodies", "J/m^3", "work of the gas on walls in the step"};
inline constexpr CellLabel<double> heat{"c.heatToBodies", "J/m^3",
                                        "heat from the gas in the step, from exchange coefficients"};
inline constexpr CellLabel<double> wallHeat{"c.heatToWalls", "J/m^3", "heat from the gas in the step, by conduction"};
inline constexpr CellLabel<double> bodyCapacity{"c.bodyCapacity", "J/(m^3 K)", "heat capacity of bodies"};
inline constexpr CellLabel<double> bodyTemperature{"c.bodyTemperature", "K",
                                                   "mean temperature of bodies, weighted by heat capacity"};
inline constexpr CellLabel<double> wallWarming{"c.warmingByWalls", "K",
                                               "change of the temperature of bodies in the step, by conduction"};
/// Labels of each body that exchanges heat by coefficients, and of each gas.
inline constexpr CellLabel<double> capacityOfBody{"c.capacityOfBody", "J/(m^3 K)", "heat capacity of the body"};
inline constexpr CellLabel<double> temperatureOfBody{"c.temperatureOfBody", "K",
                                                     "mean temperature of the body, weighted by heat capacity"};
inline constexpr CellLabel<double> volumeOfBody{"c.volumeOfBody", "1",
                                                "volume of the boxes of the body, divided by that of the cell"};
inline constexpr CellLabel<double> heatOfBodyAtFaces{"c.heatOfBodyAtFaces", "J/m^3",
                                                     "heat that the body received from neighbouring cells in the step"};
inline constexpr std::array<CellLabel<double>, 3> heatOfGasAtFaces{
    {{"c.heatOfGasAtFaces0", "J/m^3", "heat that the first gas received from bodies in neighbouring cells in the step"},
     {"c.heatOfGasAtFaces1", "J/m^3",
      "heat that the second gas received from bodies in neighbouring cells in the step"},
     {"c.heatOfGasAtFaces2", "J/m^3",
      "heat that the third gas received from bodies in neighbouring cells in the step"}}};
inline constexpr CellLabel<double> warming{"c.warming", "K", "change of the temperature of the body in the step"};
template <int D>
inline constexpr CellLabel<Vec<D>> impulseSinceStart{"c.impulseSinceStart", "N s/m^3",
                                                     "impulse of the gas on walls since the start"};
inline constexpr CellLabel<double> workSinceStart{"c.workSinceStart", "J/m^3",
                                                  "work of the gas on walls since the start"};
inline constexpr CellLabel<double> heatSinceStart{"c.heatSinceStart", "J/m^3",
                                                  "heat from the gas to bodies since the start"};
template <int D>
inline constexpr CellLabel<Vec<D>> massFlow{
    "c.massFlow", "kg/m^3", "gas that passed bodies upwards through the open lower faces, per volume of a cell"};
inline constexpr CellLabel<double> leakSinceStart{"c.leakSinceStart", "kg/m^3",
                                                  "gas that leaked through bodies in the cell"};
/// Labels of a body that burns.
inline constexpr CellLabel<double> reactantMass{"c.reactantMass", "kg/m^3", "mass of the burning body per cell volume"};
inline constexpr CellLabel<double> reactantVolume{"c.reactantVolume", "1",
                                                  "fraction of the cell that the burning body fills"};
inline constexpr CellLabel<double> reactantTemperature{"c.reactantTemperature", "K", "temperature of the burning body"};
inline constexpr CellLabel<double> otherVolume{"c.otherVolume", "1", "fraction of the cell that other bodies fill"};
inline constexpr CellLabel<double> hottestBody{
    "c.hottestBody", "K",
    "highest temperature of any body that fills more than a fifth of the cell; 0 if there is none"};
template <int D>
inline constexpr CellLabel<Vec<D>> burnRate{
    "c.burnRate", "kg/(m^3 s)", "mass that burns at the lower faces, per cell volume; negative where the gas is above"};
template <int D>
inline constexpr CellLabel<Vec<D>> blowing{
    "c.blowing", "m/s", "speed of new gas away from walls at the lower faces; negative where the gas is above"};
template <int D>
inline constexpr CellLabel<Vec<D>> recoil{
    "c.recoil", "Pa", "pressure of new gas on walls at the lower faces; negative where the gas is above"};
inline constexpr CellLabel<double> burnRateWithin{
    "c.burnRateWithin", "kg/(m^3 s)", "mass that burns in a cell with a remnant of a body, per cell volume"};
/// Labels of surfaces that burn by Unsteady_Burn.
inline constexpr CellLabel<double> surfaceTemperatureBefore{"c.surfaceTemperatureBefore", "K",
                                                            "temperature of the burning surface before the step"};
inline constexpr CellLabel<double> surfaceGradientBefore{
    "c.surfaceGradientBefore", "K/m", "temperature gradient below the burning surface before the step"};
inline constexpr CellLabel<double> surfaceTemperature{"c.surfaceTemperature", "K",
                                                      "temperature of the burning surface; 0 where nothing burns"};
inline constexpr CellLabel<double> surfaceGradient{
    "c.surfaceGradient", "K/m", "temperature gradient below the burning surface; 0 where nothing burns"};
inline constexpr CellLabel<double> unsteadyRate{"c.unsteadyRate", "kg/(m^2 s)", "rate at which the surface burns"};
/// Labels of a body with cracks that burns.
inline constexpr CellLabel<double> bodyPressure{"c.bodyPressure", "Pa", "mean pressure of the burning body"};
inline constexpr CellLabel<double> crackRadius{"c.crackRadius", "m", "radius of the widest cracks of the burning body"};
inline constexpr CellLabel<double> burnMode{
    "c.burnMode", "1", "mode of burning: 0 none, 1 at the surface, 2 in cracks, 3 waiting for a flame"};
inline constexpr CellLabel<double> burnPressure{"c.burnPressure", "Pa", "pressure at which the body burns"};
inline constexpr CellLabel<double> waited{"c.waited", "s", "time for which a flame has been next to the cell"};
inline constexpr CellLabel<double> inductionTime{"c.inductionTime", "s", "time that the cell waits before it burns"};
inline constexpr CellLabel<double> burntShare{"c.burntShare", "1", "fraction of c.reactantMass that burns in the step"};
inline constexpr CellLabel<double> burntSinceStart{"c.burntSinceStart", "kg/m^3", "mass that burned in the cell"};
inline constexpr CellLabel<double> gasDensity{"c.gasDensity", "kg/m^3",
                                              "mass per volume of the gas; 0 in cells without gas"};
}  // namespace c

namespace p {
using namespace mpm::solid::p;
template <int D>
inline constexpr ParticleLabel<Vec<D>> boxEdges{"p.boxEdges", "1",
                                                "edges of the box that represents the particle, in cells"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> ahead{
    "p.ahead", "1", "1 or -1 along an axis if the particle ahead has left the grid through its upper or lower side"};
inline constexpr ParticleLabel<double> surfaceTemperature{
    "p.surfaceTemperature", "K", "temperature of the burning surface in the particle's cell; 0 where nothing burns"};
inline constexpr ParticleLabel<double> surfaceGradient{
    "p.surfaceGradient", "K/m", "temperature gradient below that surface; 0 where nothing burns"};
inline constexpr ParticleLabel<double> unburned{"p.unburned", "1", "remaining fraction of the particle's initial mass"};
}  // namespace p
namespace g {
using namespace mpm::solid::g;
}

/// Labels of totals. Those of `euler` and of the solids that have the same name add up.
namespace total {
inline constexpr ReductionLabel<Sum> energy{"TotalEnergy", "J",
                                            "internal and kinetic energy of the gas, kinetic and strain energy of "
                                            "bodies, and their heat if the gas heats them"};
inline constexpr ReductionLabel<Sum> gasMass{"GasMass", "kg", "mass of the gas"};
inline constexpr ReductionLabel<VectorSum> gasMomentum{"GasMomentum", "kg m/s", "momentum of the gas"};
inline constexpr ReductionLabel<Sum> gasEnergy{"GasEnergy", "J", "internal and kinetic energy of the gas"};
inline constexpr ReductionLabel<Sum> gasKineticEnergy{"GasKineticEnergy", "J", "kinetic energy of the gas"};
inline constexpr ReductionLabel<Maximum> diffusivityAtStart{"GasDiffusivityAtStart", "m^2/s",
                                                            "largest diffusivity of the gas at the start of the run"};
inline constexpr ReductionLabel<VectorSum> forceOnBodies{"GasForceOnBodies", "N",
                                                         "force of the gas on all bodies, above reference_pressure"};
inline constexpr ReductionLabel<Sum> powerOnBodies{"GasPowerOnBodies", "W", "power of the gas on all bodies"};
inline constexpr ReductionLabel<VectorSum> impulse{"GasImpulseOnBodies", "N s",
                                                   "momentum that the gas has given to walls since the start"};
inline constexpr ReductionLabel<Sum> work{"GasWorkOnBodies", "J", "work of the gas on walls since the start"};
inline constexpr ReductionLabel<Sum> heat{"GasHeatToBodies", "J", "heat from the gas to bodies since the start"};
inline constexpr ReductionLabel<Sum> heatOfStep{"GasHeatOfStep", "J", "heat from the gas to bodies in the step"};
inline constexpr ReductionLabel<Sum> burntMass{"BurntMass", "kg", "mass of bodies that burned since the start"};
inline constexpr ReductionLabel<Sum> reactionHeat{"ReactionHeat", "J", "heat released by burning since the start"};
inline constexpr ReductionLabel<Sum> leak{"GasLeak", "kg", "gas that leaked through bodies since the start"};
inline constexpr ReductionLabel<Sum> mergedCells{
    "MergedCells", "1", "number of small cells, with some free volume, merged with a neighbour in the step"};
inline constexpr ReductionLabel<Minimum> leastFreeVolume{
    "LeastFreeVolume", "1", "smallest open fraction of a cell that contains gas, after the step"};
inline constexpr ReductionLabel<Minimum> leastMass{"LeastGasMass", "kg/m^3",
                                                   "smallest mass of gas in a cell, divided by the volume of the cell"};
inline constexpr ReductionLabel<Minimum> leastHeat{
    "LeastGasHeat", "J/m^3",
    "smallest internal energy of gas in a cell, minus that of p_inf, divided by the volume of the cell"};
}  // namespace total

}  // namespace tushar::mpmice
