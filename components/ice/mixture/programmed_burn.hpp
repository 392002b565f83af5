#pragma once

#include <algorithm>
#include <string>

#include "core/base/vec.hpp"
#include "core/input/schema.hpp"

namespace tushar::ice {

/// Uintah's LightTime: a detonation that runs through an explosive at a given speed D, from a point or a plane. A cell
/// at the distance d begins to burn at the time d / D. The burned fraction then rises to 1 in the time 1.5 h / D, where
/// h is the cube root of the cell's volume; from .96 on, it is set to 1. Source: M. L. Wilkins, Calculation of
/// Elastic-Plastic Flow, Methods Comput. Phys. 3 (1964) 211, for the idea.
struct ProgrammedBurn {
  Location where;  ///< in the scene
  std::string from, to;
  double speed = 0;               ///< speed D [m/s]
  double heat = 0;                ///< heat [J/kg]
  Vec3 start = Vec3::Zero();      ///< point of ignition [m]
  Vec3 direction = Vec3::Zero();  ///< normal of the plane of ignition; 0 for ignition at a point
  bool burnsInMixedCells = true;  ///< whether cells that contain another gas burn

  /// The fraction of a cell that has burned at a time [s], given its centre [m] and its width h [m].
  double reached(const Vec3& point, double time, double width) const {
    const double across = direction.norm();
    const double distance = across > 0 ? std::abs(direction.dot(point - start)) / across : (point - start).norm();
    const double fraction = (time * speed - distance) / (1.5 * width);
    return fraction > 0.96 ? 1 : std::max(fraction, 0.0);
  }
  /// Whether a cell may burn, given the fraction of it that the explosive and its product fill together.
  bool takesCell(double share) const { return burnsInMixedCells || share > 0.99; }
};

const input::Schema<ProgrammedBurn>& programmedBurnSchema();

}  // namespace tushar::ice
