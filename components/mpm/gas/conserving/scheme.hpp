#pragma once

#include <optional>

#include "components/mpm/gas/viscosity.hpp"

namespace tushar::mpm::gas::conserving {

/// How particles update their velocity from that of the grid.
enum class Transfer {
  apic,       ///< it replaces theirs, with its gradient: Jiang et al., ACM Trans. Graph. 34 (2015) 51
  affineFlip  ///< its change is added to theirs where the gas is smooth; as apic at shocks
};

/// When particles are replaced by one per cell.
struct Remap {
  int every = 4;             ///< steps
  double overfilled = 0.02;  ///< or when gas fills a cell by more than 1 + this share of its volume
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

/// Compile-time differences between the two transfers.
struct Apic {
  static constexpr Transfer transfer = Transfer::apic;
  static constexpr double faceTime = 1.0;     ///< faces move with v + faceTime dt a
  static constexpr double spareEnergy = 0.5;  ///< share of e that may make up for missing kinetic energy
};
struct AffineFlip {
  static constexpr Transfer transfer = Transfer::affineFlip;
  static constexpr double faceTime = 0.5;
  static constexpr double spareEnergy = 0.25;
};

}  // namespace tushar::mpm::gas::conserving
