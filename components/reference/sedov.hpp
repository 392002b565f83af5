#pragma once

#include <vector>

#include "components/reference/radial_reference.hpp"

namespace tushar::reference {

/// Energy released instantaneously in a plane, along a line or at a point of a uniform gas at rest.
struct SedovProblem {
  double density = 1;          ///< density of the gas at rest [kg/m^3]
  double pressure = 0;         ///< pressure of the gas [Pa]; the solution neglects its effect on the blast
  double energy = 1;           ///< total energy: of a plane (both sides of it) [J/m²], of a line [J/m], of a point [J]
  double gamma = 1.4;          ///< ratio of specific heats
  Vec3 centre = Vec3::Zero();  ///< centre [m]
  Vec3 round = Vec3(1, 1, 1);  ///< 1 along the 1, 2 or 3 axes in which the distance from the centre is measured
};

/// The self-similar blast wave of Sedov, Taylor and von Neumann in d = 1, 2 or 3 dimensions.
///
/// The shock is at R = (E t² / (alpha rho0))^(1/(d+2)). With lambda = r / R and the speed R' of the shock, the fields
/// are v = R' lambda w, rho = rho0 G, p = rho0 R'² lambda² G C. The energy integral gives C = (gamma-1)/2 w² (1-w) /
/// (gamma w - 1). The remaining two equations, for ln(gamma w - 1) and ln G as functions of ln lambda, are integrated
/// inwards from the shock and tabulated. alpha follows from the energy. For gamma = 1.4, it is 1.07749 in one dimension
/// (counting both sides of the plane), .984074 in two, and .851072 in three.
/// Source: L. I. Sedov, Similarity and Dimensional Methods in Mechanics (1959), chapter 4; L. D. Landau & E. M.
/// Lifshitz, Fluid Mechanics, section 106; J. Kamm & F. Timmes, LA-UR-07-2849 (2007).
class Sedov : public RadialReference {
 public:
  /// Throws std::invalid_argument if a setting is out of range; in three dimensions also if gamma >= 7, which leaves a
  /// void in the middle.
  explicit Sedov(const SedovProblem& problem);

  double shockRadius(double t) const override;
  RadialState atRadius(double r, double t) const override;
  /// Like the averages of other references, except that the internal energy is weighted by mass: it is the mean of p /
  /// (gamma-1) divided by that of rho. Its plain mean would be infinite at the centre, towards which it rises too fast.
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;

  double alpha() const { return alpha_; }

 private:
  /// ln(gamma w - 1) and ln G at a given ln lambda, or their derivatives.
  struct Shape {
    double y = 0, density = 0;
  };
  struct Node {
    Shape value, slope;
  };
  Shape slope(const Shape& at) const;
  void tabulate();
  Shape shapeAt(double logLambda) const;
  double pressureShape(double logLambda, const Shape& shape) const;
  double findAlpha() const;

  SedovProblem problem_;
  double step_ = 0;          ///< step of ln lambda from one node to the next, inwards: negative
  std::vector<Node> nodes_;  ///< nodes from the shock inwards
  double alpha_ = 0;
};

}  // namespace tushar::reference
