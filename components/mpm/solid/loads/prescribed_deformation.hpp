#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/mpm/solid/tensor.hpp"
#include "core/input/diagnostics.hpp"

namespace tushar::mpm::solid {

/// A prescribed deformation, homogeneous in space: F(t) is linear between points in time, and from each point to the
/// next the body also rotates by an angle about an axis. Beyond the first and the last point, the deformation is
/// extrapolated linearly.
class PrescribedDeformation {
 public:
  struct Point {
    double time = 0;                            ///< time [s]
    Matrix3 deformation = Matrix3::Identity();  ///< F without the rotation [1]
    double angle = 0;                           ///< angle of the rotation since the previous point [degrees]
    Vec3 axis = Vec3::UnitX();                  ///< axis of this rotation, with length 1
  };

  /// Constructs a deformation from at least two points, in order of time.
  explicit PrescribedDeformation(std::vector<Point> points);

  /// Computes F = Q Q_0 F_s at a time: F_s from the points, Q the rotation since the previous point, Q_0 all earlier
  /// ones.
  Matrix3 deformation(double time) const;
  /// Computes L = dF/dt F^-1 at a time [1/s].
  Matrix3 velocityGradient(double time) const;

 private:
  struct Moment;
  Moment at(double time) const;

  std::vector<Point> points_;
  std::vector<Matrix3> turned_;  ///< Q_0 from each point on, that is, the product of all earlier rotations
};

/// Reads points of 14 numbers: time [s], the components of F row by row, an angle [degrees] and its axis. Reports
/// problems to the diagnostics with file and line, and problems of the whole file at the tag that names the file.
std::optional<PrescribedDeformation> readPrescribedDeformation(const std::string& path, const Location& named,
                                                               input::Diagnostics& diagnostics);

}  // namespace tushar::mpm::solid
