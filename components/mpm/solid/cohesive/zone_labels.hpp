#pragma once

#include "components/mpm/solid/labels.hpp"

namespace tushar::mpm::solid {

/// Labels of cohesive zones; their positions are p.x.
namespace p {
inline constexpr ParticleLabel<double> czArea{"p.czArea", "m^2", "area of a cohesive zone"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> czNorm{"p.czNorm", "1",
                                              "normal of a cohesive zone, from the bottom body to the top body"};
inline constexpr ParticleLabel<int> czBotMat{"p.czBotMat", "1", "number of the material of the bottom body"};
inline constexpr ParticleLabel<int> czTopMat{"p.czTopMat", "1", "number of the material of the top body"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> czDispTop{"p.czDispTop", "m", "displacement of the top body at the zone"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> czDispBottom{"p.czDispBottom", "m",
                                                    "displacement of the bottom body at the zone"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> czSeparation{"p.czSeparation", "m",
                                                    "displacement of the top body minus that of the bottom body"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> czForce{
    "p.czForce", "N", "force of a cohesive zone on the bottom body; the opposite force acts on the top body"};
inline constexpr ParticleLabel<int> czFailed{
    "p.czFailed", "1", "0 if the zone is intact; otherwise the lost part of its strength, in thousandths"};
inline constexpr ParticleLabel<int> czMode{
    "p.czMode", "1", "0: intact; failed because it 1: opened, 2: slid, 3: did both; 4: has lost one of its bodies"};
inline constexpr ParticleLabel<double> czMassTop{"p.czMassTop", "kg", "mass of the top body at the nodes of the zone"};
inline constexpr ParticleLabel<double> czMassBottom{"p.czMassBottom", "kg",
                                                    "mass of the bottom body at the nodes of the zone"};
inline constexpr ParticleLabel<double> czWork{"p.czWork", "J",
                                              "energy that the zone has taken from the bodies since the start"};
}  // namespace p

namespace total {
inline constexpr ReductionLabel<Sum> cohesiveWork{
    "CohesiveWork", "J", "energy that cohesive zones have taken from the bodies since the start: stored or dissipated"};
}  // namespace total

}  // namespace tushar::mpm::solid
