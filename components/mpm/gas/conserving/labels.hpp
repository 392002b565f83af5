#pragma once

#include "components/mpm/gas/conserving/modes.hpp"
#include "components/mpm/gas/labels.hpp"

namespace tushar::mpm::gas::conserving {

/// Labels of the conserving gas method.
namespace p {
using namespace gas::p;
template <int D>
inline constexpr ParticleLabel<Vec<D>> edges{"p.edges", "m", "edge lengths of the box that the particle fills",
                                             Bound::positive};
template <int D>
inline constexpr ParticleLabel<Modes<D>> modes{
    "p.velocityModes", "1/s", "velocity gradient in the particle, and mixed second derivatives", Bound::finite};
inline constexpr ParticleLabel<double> heat{
    "p.heat", "J/kg", "e - p_inf / rho, if there are several gases; 0 at a pressure of -p_inf", Bound::nonNegative};
inline constexpr ParticleLabel<double> affineEnergy{
    "p.affineEnergy", "J/kg", "kinetic energy per mass of the motion about the mean velocity", Bound::nonNegative};
}  // namespace p

namespace g {
using namespace gas::g;
inline constexpr NodeLabel<double> relaxation{
    "g.relaxation", "1", "fraction of PIC in the velocity that the node gives to particles; the rest is FLIP"};
}  // namespace g

namespace c {
using namespace gas::c;
inline constexpr CellLabel<double> mass{"c.mass", "kg", "mass of the parts of particles in the cell",
                                        Bound::nonNegative};
inline constexpr CellLabel<double> internalEnergy{
    "c.internalEnergy", "J", "internal energy of the parts of particles in the cell", Bound::nonNegative};
inline constexpr CellLabel<double> fill{"c.fill", "1",
                                        "volume of the parts of particles in the cell, as a fraction of the cell"};
template <int D>
inline constexpr CellLabel<Vec<D>> velocity{"c.velocity", "m/s",
                                            "momentum divided by mass, for the parts of particles in the cell"};
template <int D>
inline constexpr CellLabel<Tensor<D>> velocityGradient{"c.velocityGradient", "1/s",
                                                       "velocity gradient at the centre of the cell"};
inline constexpr CellLabel<double> pressure{"c.pressure", "Pa",
                                            "pressure of the cell, plus p_infinity if the only gas is stiffened"};
inline constexpr CellLabel<double> viscosity{"c.viscosity", "Pa", "artificial viscosity of the cell", Bound::finite};
inline constexpr CellLabel<double> shock{"c.shock", "1", "shock sensor, from 0 (smooth) to 1 (shock)"};
template <int D>
inline constexpr CellLabel<Tensor<D>> stress{
    "c.stress", "Pa", "pressure and viscosity on the faces, at the positions of the faces half a step later"};
inline constexpr CellLabel<double> work{"c.work", "1", "relative change of the internal energy due to compression"};
inline constexpr CellLabel<double> movedMass{"c.movedMass", "kg", "mass in the cell before the remap"};
inline constexpr CellLabel<double> movedEnergy{"c.movedEnergy", "J", "internal energy in the cell before the remap"};
}  // namespace c

/// Labels that limit the time step.
inline constexpr ReductionLabel<Maximum> signalPastGrid{"SignalPastGrid", "m/s",
                                                        "speed of the fastest signal relative to the grid"};
inline constexpr ReductionLabel<Maximum> signalPastGas{"SignalPastGas", "m/s",
                                                       "speed of the fastest signal relative to the gas"};

/// Labels that determine when to remap.
inline constexpr ReductionLabel<Maximum> cellFill{
    "CellFill", "1", "largest ratio of the volume of a cell's particles to that of the cell"};
inline constexpr ReductionLabel<Maximum> remapCount{"RemapCount", "1",
                                                    "steps since the last remap; 0: remap in this step"};
inline constexpr ReductionLabel<Maximum> remapAge{"RemapAge", "1", "steps since the last remap"};

}  // namespace tushar::mpm::gas::conserving
