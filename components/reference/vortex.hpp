#pragma once

#include <string>

#include "components/reference/moving_frame.hpp"

namespace tushar::reference {

/// The settings that all vortices of gas share.
struct VortexProblem {
  double density = 1;   ///< rho0, kg/m^3
  double pressure = 1;  ///< p0, Pa
  double gamma = 1.4;   ///< ratio of specific heats
  double radius = 1;    ///< radius of the largest speed around the centre, m
  int axis = 2;         ///< 0, 1 or 2: the axis of rotation, along which nothing varies
  MovingFrame frame;    ///< its centre; the velocity is that of the flow

  /// Throws std::invalid_argument where a setting is out of range; `name` begins the sentence.
  void requireGas(const std::string& name) const;
};

}  // namespace tushar::reference
