#pragma once

#include <cmath>

namespace tushar::mpm::solid {

/// A step of a Maxwell element, a spring and a dashpot in series, ds/dt = rate - s/tau, exact for a constant rate:
/// s <- kept s + gained rate dt; Simo & Hughes, Computational Inelasticity (1998), section 10.3.
struct MaxwellStep {
  double kept;    ///< factor exp(-dt/tau) of the initial stress [1]
  double gained;  ///< factor (1 - exp(-dt/tau)) tau/dt of the stress increment [1]

  /// `steps` is dt/tau; 0 for a spring without dashpot.
  explicit MaxwellStep(double steps) : kept(std::exp(-steps)), gained(steps > 0 ? -std::expm1(-steps) / steps : 1) {}
};

}  // namespace tushar::mpm::solid
