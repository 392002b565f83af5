#pragma once

#include <optional>

#include "components/reference/exact_riemann.hpp"
#include "components/reference/piecewise_mean.hpp"

namespace tushar::reference {

/// The placement of a tube in space.
struct TubePlacement {
  Vec3 normal = Vec3::UnitX();   ///< unit vector along the tube
  std::optional<double> mirror;  ///< distance from the origin, along the tube, of a plane at which it is mirrored [m]
  double period = 0;             ///< length along the tube after which it and its image repeat [m]; 0: never
};

/// The exact solution of a Riemann problem in a tube with an arbitrary direction.
///
/// With s = normal . x, the fields are those of ExactRiemann at s along x. If there is a mirror, the tube is on the
/// same side of it as the diaphragm; its image is beyond. With a period, there is a second mirror half a period away.
/// Valid until a wave reaches a mirror.
class TiltedTube : public GasReference {
 public:
  /// `problem` is along x; its diaphragm is a distance from the origin along the tube. Throws std::invalid_argument as
  /// ExactRiemann does, and if the normal is not a unit vector, the diaphragm is not between the mirrors, a period has
  /// no mirror, or gas moves at a mirror.
  TiltedTube(const RiemannProblem& problem, const TubePlacement& placement);

  /// Throws std::domain_error from the time on at which a wave reaches a mirror.
  GasState at(const Vec3& x, double t) const override;
  bool holdsAt(double t) const override { return t >= 0 && t < meetingTime_; }
  /// Uses piecewiseMean with one piece between any two waves; there is no quadrature along the axes across the tube.
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;

 private:
  void checkMirrors() const;
  void findMeetingTime();
  /// Adds the planes at which a plane at `position` along the tube and its images cut the box.
  void addImages(double position, const Vec3& lower, const Vec3& upper, std::vector<Plane>& planes) const;

  ExactRiemann tube_;
  RiemannProblem problem_;
  TubePlacement placement_;
  double side_ = 1;         ///< 1 if the tube is above its mirror, -1 if it is below
  double meetingTime_ = 0;  ///< meeting time [s]
};

}  // namespace tushar::reference
