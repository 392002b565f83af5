#pragma once

#include <Eigen/Eigenvalues>

#include "components/mpm/solid/constitutive/arenisca/elasticity.hpp"
#include "components/mpm/solid/constitutive/arenisca/yield_surface.hpp"
#include "components/mpm/solid/constitutive/root_between.hpp"

namespace tushar::mpm::solid::arenisca {

/// A stress given by its invariants, in the axes of its deviator.
struct Invariants {
  double i1, rootJ2;  ///< I1 and sqrt J2 [Pa]
  LodeAngle theta;

  explicit Invariants(const Matrix3& stress) : i1(stress.trace()) {
    const Matrix3 s = deviator(stress);
    const double j2 = 0.5 * s.squaredNorm();
    rootJ2 = j2 > 1e-16 * (i1 * i1 + j2) ? std::sqrt(j2) : 0.0;
    theta = 0;
    if (rootJ2 > 0) {
      const double sine = -0.5 * s.determinant() * std::sqrt(27 / (j2 * j2 * j2));
      theta = std::asin(std::clamp(sine, -1.0, 1.0)) / 3;
    }
  }
  Invariants(double i1_, double rootJ2_, LodeAngle theta_) : i1(i1_), rootJ2(rootJ2_), theta(theta_) {}
};

/// The root of an increasing function f, by bisection to all but the last few bits; an end of the interval if there is
/// no root.
template <class F>
double crossing(double low, double high, const F& f) {
  const double width = 1e-14 * std::max(std::abs(low), std::abs(high));
  while (high - low > width) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The minimum of a unimodal function f, by golden-section search.
template <class F>
double least(double low, double high, const F& f) {
  constexpr double golden = std::numbers::phi - 1;
  double a = high - golden * (high - low), b = low + golden * (high - low), fa = f(a), fb = f(b);
  for (int k = 0; k < 45; ++k) {
    if (fa < fb) {
      high = b;
      b = a;
      fb = fa;
      fa = f(a = high - golden * (high - low));
    } else {
      low = a;
      a = b;
      fa = fb;
      fb = f(b = low + golden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

/// The point of a yield surface nearest to a stress outside it, in the space of z = I1 / sqrt 3 and r = beta sqrt(3/2
/// K/G) sqrt(2 J2): for beta = 1 the return of associated plasticity with the moduli K and G. Homel, Guilkey & Brannon,
/// Comput. Mech. 56 (2015) 565. The source searches from within the surface by bisection and rotation. Here, the
/// distance to the sections of the surface normal to the axis is minimised by bisection of its derivative along the
/// axis; the distance is convex because the surface is.
class ClosestPoint {
 public:
  ClosestPoint(const Constants& c, const Moduli& moduli, const YieldSurface& surface)
      : surface_(surface), stretch_(c.flowFactor * std::sqrt(3 * moduli.bulk / moduli.shear)) {}

  /// The point of the surface that is closest to a trial stress; both are given by their invariants.
  Invariants operator()(const Invariants& trial) const {
    const double at = (trial.i1 - surface_.zeta()) / root3, radius = stretch_ * trial.rootJ2;
    if (surface_.capLength() > 0) return onCone(at, radius, trial.theta);
    const double first = surface_.end() / root3, last = surface_.vertex() / root3;
    const double near = std::clamp(at, first, last);
    const double distance = std::hypot(at - near, radius);
    const double z = crossing(std::max(first, at - distance), std::min(last, at + distance), [&](double place) {
      const double gap = gapOf(place, radius, trial.theta);
      return place - at - (gap > 0 ? gap * stretch_ * root3 * surface_.slope(root3 * place) : 0.0);
    });
    const double i = root3 * z, reach = surface_.radius(i);
    const LodeAngle theta = nearestAngle(stretch_ * reach, radius, trial.theta);
    return {i + surface_.zeta(), surface_.lodeFactor(theta) * reach, theta};
  }

 private:
  static constexpr double root3 = std::numbers::sqrt3;

  /// The closest point on a cone with a tangent cap: a point of the line r = B (z_vertex - z), in closed form, the
  /// vertex, or a point of the ellipse.
  Invariants onCone(double at, double radius, LodeAngle theta) const {
    const double vertex = surface_.vertex() / root3, steepness = -surface_.slope(surface_.vertex()) * root3 * stretch_;
    const double ahead = (vertex - at + steepness * radius) / (1 + steepness * steepness);  // of the foot
    if (ahead <= 0) return {surface_.vertex() + surface_.zeta(), 0, theta};
    const double z = vertex - ahead;
    const bool isOutside = radius > steepness * (vertex - at);
    if (!isOutside || root3 * z < surface_.branch()) return onEllipse(at, radius, theta);
    return {root3 * z + surface_.zeta(), steepness * ahead / stretch_, theta};
  }
  /// The closest point on the elliptic cap, which is (-a cos phi, b sin phi) relative to its centre: the point at which
  /// the distance stops decreasing with phi.
  Invariants onEllipse(double at, double radius, LodeAngle theta) const {
    const double a = surface_.capLength() / root3, b = surface_.capHeight() * stretch_;
    const double middle = surface_.end() / root3 + a, away = at - middle;
    const double touch = std::acos(std::clamp((middle - surface_.branch() / root3) / a, -1.0, 1.0));
    const auto slope = [&](double phi) {
      const double sine = std::sin(phi), cosine = std::cos(phi);
      return (b * b - a * a) * sine * cosine - away * a * sine - radius * b * cosine;
    };
    double phi = 0;
    if (radius > 0) phi = slope(touch) <= 0 ? touch : rootBetween(slope, 0, touch);
    return {root3 * (middle - a * std::cos(phi)) + surface_.zeta(), b * std::sin(phi) / stretch_, theta};
  }
  /// The distance of the trial point from the section at z, outside the section, times d(r)/d(radius) of the nearest
  /// point there.
  double gapOf(double z, double trialRadius, LodeAngle trialTheta) const {
    const double radius = stretch_ * surface_.radius(root3 * z);
    if (trialRadius <= radius * surface_.lodeFactor(trialTheta)) return 0;
    const LodeAngle theta = nearestAngle(radius, trialRadius, trialTheta);
    const double factor = surface_.lodeFactor(theta);
    return (trialRadius * std::cos(theta - trialTheta) - radius * factor) * factor;
  }
  /// The Lode angle of the point of a section that is nearest to the trial point.
  LodeAngle nearestAngle(double radius, double trialRadius, LodeAngle trialTheta) const {
    if (surface_.isRound() || radius == 0) return trialTheta;
    constexpr double sixth = std::numbers::pi / 6;
    return least(-sixth, sixth, [&](double theta) {
      const double r = radius * surface_.lodeFactor(theta);
      return r * (r - 2 * trialRadius * std::cos(theta - trialTheta));
    });
  }

  const YieldSurface& surface_;
  double stretch_;  ///< ratio of r to sqrt J2
};

/// The stress with the given invariants and the axes of `trial`.
inline Matrix3 stressWith(const Invariants& invariants, const Matrix3& trial, const Invariants& before) {
  const Matrix3 mean = invariants.i1 / 3 * Matrix3::Identity();
  if (before.rootJ2 == 0) return mean;
  if (invariants.theta == before.theta) return mean + invariants.rootJ2 / before.rootJ2 * deviator(trial);
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(trial).eigenvectors();
  Eigen::Vector3d s;
  for (int k = 0; k < 3; ++k)
    s[k] =
        2 / std::numbers::sqrt3 * invariants.rootJ2 * std::sin(invariants.theta + (k - 1) * 2 * std::numbers::pi / 3);
  return mean + Matrix3(axes * s.asDiagonal() * axes.transpose());
}

}  // namespace tushar::mpm::solid::arenisca
