#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/input/geometry/piece.hpp"
#include "core/input/schema.hpp"

namespace tushar::input {

/// A hollow cylinder whose particles follow its surface, in rings around the axis and layers along it. Uintah's
/// `smoothcyl`.
struct SmoothCylinder : GeometryPiece {
  enum class Scheme { pieSlices, constantVolumes };
  /// A particle of the cylinder.
  struct Particle {
    Vec3 at;  ///< position [m]
    /// Edge vectors as columns: around the axis, outwards, and along the axis [m].
    Eigen::Matrix<double, 3, 3, Eigen::DontAlign> edges;
    double volume;  ///< volume [m^3]
  };

  Scheme scheme = Scheme::pieSlices;
  Vec3 bottom = Vec3::Zero(), top = Vec3::Zero();  ///< centres of the ends [m]
  double innerRadius = 0, outerRadius = 0;         ///< inner and outer radius [m]
  int radial = 0, axial = 0;                       ///< numbers of rings and of layers
  std::optional<int> angular;                      ///< number of particles in a ring
  double startAngle = 0, endAngle = 360;           ///< start and end of the arc [degrees]

  bool contains(const Vec3& point) const override;
  Box3 bounds() const override;
  /// The particles of the cylinder. A ring has fewer pie slices than the scene specifies if a slice would otherwise
  /// have less than a twentieth of `cellVolume` [m^3].
  std::vector<Particle> particles(double cellVolume) const;
  static const Schema<SmoothCylinder>& schema();

 private:
  void addRing(const Vec3& center, int ring, int count, std::vector<Particle>& particles) const;
  int particlesOfRing(int ring, double cellVolume) const;
  /// Cross-section of a particle in a ring of `count` particles [m^2].
  double areaOf(int ring, int count) const;
  /// Angle of the arc [rad].
  double angle() const;
  /// Width of a ring, and height of a layer [m].
  double width() const { return (outerRadius - innerRadius) / radial; }
  double height() const { return (top - bottom).norm() / axial; }
};

}  // namespace tushar::input
