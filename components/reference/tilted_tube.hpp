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
/// With s = normal . x, the fields at x are those of ExactRiemann at the position s. If there is a mirror, the tube is
/// on the side of the diaphragm, and its image on the other side. With a period, there is a second mirror half a period
/// away. Valid until a wave reaches a mirror.
class TiltedTube : public GasReference {
 public:
  /// The diaphragm of `problem` is a distance from the origin along the tube. Throws the std::invalid_argument of
  /// ExactRiemann, and one if the normal is not a unit vector, the diaphragm is not between the mirrors, a period has
  /// no mirror, or gas moves at a mirror.
  TiltedTube(const RiemannProblem& problem, const TubePlacement& placement);

  /// Throws std::domain_error at times after a wave has reached a mirror.
  GasState at(const Vec3& x, double t) const override;
  bool holdsAt(double t) const override { return t >= 0 && t < meetingTime_; }
  /// Uses piecewiseMean with one piece between any two waves; there is no quadrature along axes perpendicular to the
  /// tube.
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;

 private:
  void checkMirrors() const;
  void findMeetingTime();
  /// Adds the plane at `position` along the tube and, if the tube has a mirror, its image; if they repeat, adds those
  /// repetitions of both that cut the box.
  void addImages(double position, const Vec3& lower, const Vec3& upper, std::vector<Plane>& planes) const;

  ExactRiemann tube_;
  RiemannProblem problem_;
  TubePlacement placement_;
  double side_ = 1;         ///< 1 if the tube is above its mirror, -1 if it is below
  double meetingTime_ = 0;  ///< meeting time [s]
};

}  // namespace tushar::reference
