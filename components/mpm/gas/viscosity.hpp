#pragma once

namespace tushar::mpm::gas {

/// Coefficients of the artificial viscosity of Monaghan & Pongracic, Appl. Numer. Math. 1 (1985) 187.
struct Viscosity {
  double quadratic = 0.6;  ///< C_q
  double linear = 2.75;    ///< C_l
};

}  // namespace tushar::mpm::gas
