#include "components/reference/tilted_tube.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace tushar::reference {

TiltedTube::TiltedTube(const RiemannProblem& problem, const TubePlacement& placement)
    : tube_(problem), problem_(problem), placement_(placement) {
  if (!(std::abs(placement.normal.norm() - 1) < 1e-12))
    throw std::invalid_argument("The direction of a tube is not a unit vector.");
  if (placement.mirror && problem.diaphragm < *placement.mirror) side_ = -1;
  checkMirrors();
  findMeetingTime();
}

void TiltedTube::checkMirrors() const {
  if (!placement_.mirror) {
    if (placement_.period > 0)
      throw std::invalid_argument(
          "The grid is periodic along the tube, but the ends of the tube differ; with a <mirror>, each end meets its "
          "own image.");
    return;
  }
  const double distance = std::abs(problem_.diaphragm - *placement_.mirror), half = 0.5 * placement_.period;
  if (!(distance > 0) || (half > 0 && distance >= half))
    throw std::invalid_argument(fmt::format(
        "The diaphragm must lie between two mirrors, which are {:g} m apart along the tube, but it is {:g} m from "
        "the first.",
        half > 0 ? half : std::numeric_limits<double>::infinity(), distance));
  const RiemannState& near = side_ > 0 ? problem_.left : problem_.right;
  const RiemannState& far = side_ > 0 ? problem_.right : problem_.left;
  if (near.velocity != 0 || (half > 0 && far.velocity != 0))
    throw std::invalid_argument("The gas at a mirror is not at rest at the start.");
}

void TiltedTube::findMeetingTime() {
  meetingTime_ = std::numeric_limits<double>::infinity();
  if (!placement_.mirror) return;
  const double distance = std::abs(problem_.diaphragm - *placement_.mirror), half = 0.5 * placement_.period;
  const RiemannSolution& waves = tube_.solution();
  const double inwards = side_ > 0 ? -waves.leftWave.head : waves.rightWave.head;
  const double outwards = side_ > 0 ? waves.rightWave.head : -waves.leftWave.head;
  if (inwards > 0) meetingTime_ = distance / inwards;
  if (half > 0 && outwards > 0) meetingTime_ = std::min(meetingTime_, (half - distance) / outwards);
}

GasState TiltedTube::at(const Vec3& x, double t) const {
  if (t >= meetingTime_)
    throw std::domain_error(fmt::format(
        "A wave of the tube meets its image at t = {:g} s; from then on, such as at t = {:g} s, there is no exact "
        "solution.",
        meetingTime_, t));
  double s = placement_.normal.dot(x), direction = 1;
  if (placement_.mirror) {
    double away = s - *placement_.mirror;
    if (placement_.period > 0) away -= placement_.period * std::nearbyint(away / placement_.period);
    if (side_ * away < 0) direction = -1;
    s = *placement_.mirror + side_ * std::abs(away);
  }
  GasState gas = tube_.at(Vec3(s, 0, 0), t);
  gas.velocity = direction * gas.velocity[0] * placement_.normal;
  return gas;
}

GasState TiltedTube::average(const Vec3& lower, const Vec3& upper, double t) const {
  std::vector<Plane> planes;
  for (const double position : tube_.breaks(0, t)) addImages(position, lower, upper, planes);
  Vec3 end = upper;
  for (int d = 0; d < 3; ++d)
    if (placement_.normal[d] == 0 && upper[d] >= lower[d]) end[d] = lower[d];
  return piecewiseMean(*this, planes, lower, end, t);
}

void TiltedTube::addImages(double position, const Vec3& lower, const Vec3& upper, std::vector<Plane>& planes) const {
  const Vec3& n = placement_.normal;
  const double period = placement_.period;
  if (!(period > 0)) planes.push_back({n, position});
  if (!placement_.mirror) return;
  const double image = 2 * *placement_.mirror - position;
  if (!(period > 0)) return planes.push_back({n, image});
  const double middle = 0.5 * n.dot(lower + upper), reach = 0.5 * n.cwiseAbs().dot(upper - lower);
  for (const double first : {position, image})
    for (double k = std::ceil((middle - reach - first) / period); first + k * period < middle + reach; ++k)
      planes.push_back({n, first + k * period});
}

}  // namespace tushar::reference
