#pragma once

#include <optional>

#include "components/mpm/gas/viscosity.hpp"

namespace tushar::mpm::gas::conserving {

/// How particle velocities are updated from those of the grid.
enum class Transfer {
  apic,       ///< replaced by the grid's velocity and its gradient: Jiang et al., ACM Trans. Graph. 34 (2015) 51
  affineFlip  ///< changed by the change of the grid's velocity where the flow is smooth; like apic at shocks
};

/// When to replace the particles by one per cell.
struct Remap {
  int every = 4;             ///< interval in steps
  double overfilled = 0.02;  ///< remap earlier if the volume of the gas in a cell exceeds the cell by this fraction
};

/// The section `conserving_gas_dynamics`.
struct ConservingGasDynamics {
  Transfer transfer = Transfer::apic;
  /// Courant number. apic: dt times the speed of signals over h; affineFlip: dt max(c) / h
  double cfl = 0.5;
  double advectiveCfl = 0.8;      ///< second Courant number of affineFlip: dt max |v_d| / h
  double longestParticle = 2.36;  ///< largest length of a particle [cells]; longer ones are halved
  Viscosity viscosity{1.0, 0.5};
  double heatConduction = 0;  ///< C_h of artificial heat conduction at shocks
  std::optional<Remap> remap;
};

/// Properties of apic, as compile-time constants.
struct Apic {
  static constexpr Transfer transfer = Transfer::apic;
  static constexpr bool relaxes = true;       ///< whether particles lose velocity relative to the grid
  static constexpr double faceTime = 1.0;     ///< faces move with velocity v + faceTime dt a
  static constexpr double spareEnergy = 0.5;  ///< fraction of e that may compensate for a lack of kinetic energy
};
struct AffineFlip {
  static constexpr Transfer transfer = Transfer::affineFlip;
  static constexpr bool relaxes = true;
  static constexpr double faceTime = 0.5;
  static constexpr double spareEnergy = 0.25;
};
/// affineFlip where no node is at a shock, so that beta is 0: a shorter formula with the same result.
template <class Scheme>
struct Smooth : Scheme {
  static constexpr bool relaxes = false;
};

}  // namespace tushar::mpm::gas::conserving
