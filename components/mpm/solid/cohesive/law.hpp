#pragma once

#include <cmath>
#include <numbers>

namespace tushar::mpm::solid {

/// The traction across a cohesive zone as a function of the jump of the displacement across it: Xu & Needleman, J.
/// Mech. Phys. Solids 42 (1994) 1397, equations 2.2 to 2.5 with r = 0, as Daphalapurkar, Lu, Coker & Komanduri, Int. J.
/// Fracture 143 (2007) 79, use it with the Material Point Method (equation 15).
///
/// With x = D_n / delta_n, the jump along the normal, and y = |D_t| / delta_t, the jump across it, the zone stores per
/// area
///
///   phi = phi_n {1 - (1 + x) exp(-x) [1 - q (1 - exp(-y^2))]},  q = phi_t / phi_n,
///
/// and the traction is its gradient:
///
///   T_n = phi_n / delta_n  x exp(-x) [1 - q (1 - exp(-y^2))]
///   T_t = 2 phi_t / delta_t^2  (1 + x) exp(-x) exp(-y^2)  D_t.
///
/// T_n has its maximum, sigma_max, at x = 1 and y = 0, and |T_t| has its maximum, tau_max, at x = 0 and y = 1/sqrt(2).
/// Therefore phi_n = e sigma_max delta_n and phi_t = sqrt(e/2) tau_max delta_t: the energies that it takes to separate
/// a unit of area in mode I and in mode II.
struct CohesiveLaw {
  double normalStrength = 0;           ///< sigma_max [Pa]
  double tangentialStrength = 0;       ///< tau_max [Pa]
  double normalLength = 1;             ///< delta_n [m]
  double tangentialLength = 1;         ///< delta_t [m]
  double normalFailureLength = 0;      ///< |D_n| beyond which a zone fails [m]
  double tangentialFailureLength = 0;  ///< |D_t| beyond which a zone fails [m]

  /// phi_n [J/m^2]
  double normalEnergy() const { return std::numbers::e * normalStrength * normalLength; }
  /// phi_t [J/m^2]
  double tangentialEnergy() const { return std::sqrt(std::numbers::e / 2) * tangentialStrength * tangentialLength; }

  /// T_n [Pa], and T_t / D_t [Pa/m].
  struct Traction {
    double normal, perTangentialJump;
  };
  /// The traction at a jump: its component along the normal, and the length of the rest [m].
  Traction at(double normalJump, double tangentialJump) const {
    const double x = normalJump / normalLength, y = tangentialJump / tangentialLength;
    const double decay = std::exp(-x), shear = std::exp(-y * y);
    return {decay * x / normalLength * (normalEnergy() - tangentialEnergy() * (1 - shear)),
            2 * tangentialEnergy() / (tangentialLength * tangentialLength) * (1 + x) * decay * shear};
  }
  /// phi [J/m^2] at a jump.
  double energy(double normalJump, double tangentialJump) const {
    const double x = normalJump / normalLength, y = tangentialJump / tangentialLength;
    return normalEnergy() - (1 + x) * std::exp(-x) * (normalEnergy() - tangentialEnergy() * (1 - std::exp(-y * y)));
  }
};

}  // namespace tushar::mpm::solid
