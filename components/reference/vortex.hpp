#pragma once

#include <string>

#include "components/reference/moving_frame.hpp"

namespace tushar::reference {

/// The settings that are common to all vortices of gas.
struct VortexProblem {
  double density = 1;   ///< density rho0 [kg/m^3]
  double pressure = 1;  ///< pressure p0 [Pa]
  double gamma = 1.4;   ///< ratio of specific heats
  double radius = 1;    ///< radius at which the speed around the centre is largest [m]
  int axis = 2;         ///< axis of rotation, along which nothing varies: 0, 1 or 2
  MovingFrame frame;    ///< position and velocity of the centre; the velocity is that of the flow

  /// Throws std::invalid_argument if a setting is out of range; `name` begins the message.
  void requireGas(const std::string& name) const;
};

}  // namespace tushar::reference
