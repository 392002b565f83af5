#pragma once

#include <optional>

#include "components/mpm/gas/viscosity.hpp"

namespace tushar::mpm::gas::conserving {

/// The update of particle velocities from those of the grid.
enum class Transfer {
  apic,       ///< the grid's velocity, with its gradient, replaces theirs: Jiang et al., ACM Trans. Graph. 34 (2015) 51
  affineFlip  ///< the change of the grid's velocity is added to theirs where the flow is smooth; at shocks like apic
};

/// When to replace particles by one per cell.
struct Remap {
  int every = 4;             ///< steps
  double overfilled = 0.02;  ///< or when the gas in a cell exceeds its volume by this fraction
};

/// The `conserving_gas_dynamics` section.
struct ConservingGasDynamics {
  Transfer transfer = Transfer::apic;
  double cfl = 0.5;               ///< apic: dt times the speed of signals over h; affineFlip: dt max(c) / h
  double advectiveCfl = 0.8;      ///< affineFlip: dt max |v_d| / h
  double longestParticle = 2.36;  ///< cells; longer ones are halved
  Viscosity viscosity{1.0, 0.5};
  double heatConduction = 0;  ///< C_h of artificial heat conduction at shocks
  std::optional<Remap> remap;
};

/// Properties of apic, as compile-time constants.
struct Apic {
  static constexpr Transfer transfer = Transfer::apic;
  static constexpr double faceTime = 1.0;     ///< faces move with v + faceTime dt a
  static constexpr double spareEnergy = 0.5;  ///< fraction of e that may compensate for a lack of kinetic energy
};
struct AffineFlip {
  static constexpr Transfer transfer = Transfer::affineFlip;
  static constexpr double faceTime = 0.5;
  static constexpr double spareEnergy = 0.25;
};

}  // namespace tushar::mpm::gas::conserving
