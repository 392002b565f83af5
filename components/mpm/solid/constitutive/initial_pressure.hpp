#pragma once

#include <cmath>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// Solves K/2 (J - 1/J) = -p for J: the relative volume of a neo-Hookean body under a pressure [Pa].
inline double volumeRatioUnder(double pressure, double bulkModulus) {
  const double q = pressure / bulkModulus;
  return std::sqrt(1 + q * q) - q;
}

/// Declares the tags for the initial pressure of a body.
template <class M>
void addInitialPressure(input::Schema<M>& tags) {
  tags.value("useInitialStress", &M::startsUnderPressure, false, "1",
             "the body starts under <initial_pressure>; its given size is that under pressure")
      .value("initial_pressure", &M::initialPressure, 0, "Pa", "pressure at the start, with <useInitialStress>");
}

}  // namespace tushar::mpm::solid
