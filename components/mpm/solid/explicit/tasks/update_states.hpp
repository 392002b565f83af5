#pragma once

#include <vector>

#include "components/mpm/solid/explicit/tasks/remove_lost.hpp"
#include "components/mpm/solid/explicit/tasks/share_volume.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/transfer/cell_run.hpp"

// The part of the update of particles that does not depend on shape functions: compiled once for each dimension.

namespace tushar::mpm::solid {

/// Whether the particles of a cell are updated together, one per lane: only in three dimensions do cells contain enough
/// of them. F of fewer is updated later, for several cells together.
template <int D>
inline constexpr bool updatesTogether = D == 3;

/// Particles that have moved to the end of the step, but whose stress has not been updated, nor F unless
/// updatesTogether.
template <int D>
struct MovedParticles {
  Volumes volumes = Volumes::own;
  CellRun<D> cells = {};
  std::vector<Matrix3> velocityGradient = {};  ///< room for at least the particles of the cells
  std::vector<double> waveSpeed = {};          ///< same size as velocityGradient
  bool hasLost = false;                        ///< whether the step deforms one of the particles too much

  /// Adds a cell; returns memory for L of its particles [1/s].
  Matrix3* add(const Index<D>& cell, const data::ParticleRange& range);
};

/// Updates F and the stress of particles that have moved, and the stable time step. Removes those that the step turns
/// inside out or throws out of `space`, or throws NumericalError. Afterwards `moved` is empty.
template <int D>
void updateStates(const Level& level, const Material& material, const Method& method, double time, double dt,
                  const StateUpdate<D>& u, const CrossingRate<D>& none, const BetweenPlanes<D>& space,
                  MovedParticles<D>& moved);

}  // namespace tushar::mpm::solid
