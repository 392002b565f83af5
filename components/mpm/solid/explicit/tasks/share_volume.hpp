#pragma once

#include "components/mpm/solid/explicit/tasks/state_update.hpp"

namespace tushar::mpm::solid {

/// The change of volume that determines the stress of a particle.
enum class Volumes {
  own,    ///< its own
  shared  ///< that of all particles of its material in the cell that have not failed
};

/// F_p = (J_c / det F_p)^(1/3) F_p with J_c = sum_p V0_p det F_p / sum_p V0_p over the intact particles of a cell
/// (masses are proportional to V0); tr L_p changes accordingly. The pressure of the particles then no longer prevents
/// the cell from being sheared or bent. This is Uintah's DoPressureStabilization, and F-bar (de Souza Neto et al.,
/// Int. J. Solids Structures 33 (1996) 3277) applied to a cell. A particle that is turned inside out is left as it
/// is, and out of the sums.
/// `velocityGradient` holds L, 1/s, of the particles of `range`.
template <int D>
void shareVolume(double dt, const data::ParticleRange& range, const StateUpdate<D>& u, Matrix3* velocityGradient);

}  // namespace tushar::mpm::solid
