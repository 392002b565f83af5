#pragma once

#include <limits>
#include <numbers>

#include "components/mpm/solid/constitutive/arenisca/constants.hpp"

namespace tushar::mpm::solid::arenisca {

/// A Lode angle [rad]: pi/6 in triaxial compression, -pi/6 in extension; sin 3 theta = -J3/2 (3/J2)^(3/2).
using LodeAngle = double;

/// The yield surface sqrt J2 <= Gamma(theta) F_f(I) f_c(I) with I = I1 - zeta between `end` and the vertex: a strength
/// limit F_f = a1 - a3 exp(a2 I) - a4 I, closed by an elliptic cap f_c; Gamma is that of Gudehus, that of Mohr and
/// Coulomb, or 1. Alternatively, sqrt J2 <= F_f(I) closed by a tangent ellipse.
class YieldSurface {
 public:
  YieldSurface(const Constants& c, double end, double zeta)
      : zeta_(zeta), end_(end), vertex_(c.peakI1), lode_type_(c.lodeType), lode_ratio_(c.lodeRatio) {
    branch_ = vertex_ - c.capRatio * (vertex_ - end_);
    const double high = c.strength - c.pressureSlope * c.peakI1;
    if (c.strength == 0) {
      a1_ = c.peakI1 * c.vertexSlope;
      a4_ = c.vertexSlope;
    } else {
      a1_ = c.strength;
      a2_ = (c.vertexSlope - c.pressureSlope) / high;
      a3_ = c.vertexSlope > 0 ? high * std::exp(-a2_ * c.peakI1) : 0.0;
      a4_ = c.pressureSlope;
    }
    if (c.hasTangentCap()) closeByTangent(c);
  }

  double zeta() const { return zeta_; }
  double end() const { return end_; }
  double vertex() const { return vertex_; }
  /// I at the start of the cap [Pa].
  double branch() const { return branch_; }
  bool isRound() const { return lode_type_ == 0; }
  /// Semi-axes of a tangent ellipse along I1 and sqrt J2 [Pa]; 0 if there is none.
  double capLength() const { return length_; }
  double capHeight() const { return height_; }

  /// The radius F_f f_c at I [Pa].
  double radius(double i) const {
    if (length_ > 0 && i < branch_) return height_ * std::sqrt(std::max(0.0, ellipseSquare(i)));
    return limit(i) * std::sqrt(std::max(0.0, capSquare(i)));
  }
  /// The derivative of the radius with respect to I; infinite at the end of the cap.
  double slope(double i) const {
    const double limitSlope = -a3_ * a2_ * std::exp(a2_ * i) - a4_;
    if (i >= branch_) return limitSlope;
    if (length_ > 0) {
      const double part = ellipseSquare(i), share = (i - end_ - length_) / length_;
      return part > 0 ? -height_ * share / length_ / std::sqrt(part) : std::numeric_limits<double>::infinity();
    }
    const double square = capSquare(i), length = branch_ - end_;
    if (square <= 0) return std::numeric_limits<double>::infinity();
    const double factor = std::sqrt(square);
    return limitSlope * factor + limit(i) * ((branch_ - i) / length / length) / factor;
  }
  /// The factor Gamma.
  double lodeFactor(LodeAngle theta) const {
    if (lode_type_ == 1) {
      const double s = std::sin(3 * theta);
      return 0.5 * (1 + s + (1 - s) / lode_ratio_);
    }
    if (lode_type_ == 3) {
      const double sinPhi = 3 * (1 - lode_ratio_) / (1 + lode_ratio_);
      return 2 * std::numbers::sqrt3 / (3 - sinPhi) *
             (std::cos(theta) - sinPhi * std::sin(theta) / std::numbers::sqrt3);
    }
    return 1;
  }
  bool contains(double i1, double rootJ2, LodeAngle theta) const {
    const double i = i1 - zeta_;
    return i >= end_ && i <= vertex_ && rootJ2 <= lodeFactor(theta) * radius(i);
  }

 private:
  /// The ellipse from X with semi-axes in the ratio CR, in the space of z = I1 / sqrt 3 and r = sqrt(3 K/G) sqrt J2,
  /// that touches the cone, r = B (z_vertex - z). With q = sqrt(1 + (CR/B)^2) its semi-axis along z is
  /// (z_vertex - z_X) / (1 + q), and it touches at z_X + (z_vertex - z_X) / q.
  void closeByTangent(const Constants& c) {
    const double stretch = std::sqrt(3 * c.b0 / c.g0), steepness = c.vertexSlope * stretch * std::numbers::sqrt3;
    const double q = std::hypot(1.0, c.capShape / steepness);
    length_ = (vertex_ - end_) / (1 + q);
    height_ = c.capShape * length_ / std::numbers::sqrt3 / stretch;
    branch_ = end_ + (vertex_ - end_) / q;
  }
  double ellipseSquare(double i) const {
    const double share = (i - end_) / length_;
    return share * (2 - share);
  }
  double limit(double i) const { return a1_ - a3_ * std::exp(a2_ * i) - a4_ * i; }
  double capSquare(double i) const {
    if (i >= branch_) return 1;
    const double share = (branch_ - i) / (branch_ - end_);
    return 1 - share * share;
  }

  double zeta_, end_, vertex_, branch_;
  double a1_ = 0, a2_ = 0, a3_ = 0, a4_ = 0;
  double length_ = 0, height_ = 0;  ///< semi-axes of a tangent ellipse along I1 and sqrt J2 [Pa]; 0 if there is none
  int lode_type_;
  double lode_ratio_;
};

}  // namespace tushar::mpm::solid::arenisca
