#pragma once

#include "components/mpm/solid/explicit/tasks/state_update.hpp"

namespace tushar::mpm::solid {

/// Which change of volume determines the stress of a particle.
enum class Volumes {
  own,    ///< the change of its own volume
  shared  ///< the change of the total volume of all intact particles of its material in the cell
};

/// Computes F_p = (J_c / det F_p)^(1/3) F_p with J_c = sum_p V0_p det F_p / sum_p V0_p over the intact particles of a
/// cell (masses are proportional to V0); tr L_p changes accordingly. The pressure of the particles then no longer
/// resists shearing or bending of the cell. This is Uintah's DoPressureStabilization, that is, F-bar (de Souza Neto et
/// al., Int. J. Solids Structures 33 (1996) 3277) applied to a cell. An inverted particle is left unchanged and
/// excluded from the sums. `velocityGradient` contains L [1/s] of the particles of `range`.
template <int D>
void shareVolume(double dt, const data::ParticleRange& range, const StateUpdate<D>& u, Matrix3* velocityGradient);

}  // namespace tushar::mpm::solid
