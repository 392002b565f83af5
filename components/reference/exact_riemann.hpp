#pragma once

#include <optional>
#include <vector>

#include "components/reference/gas_reference.hpp"
#include "components/reference/riemann_solution.hpp"

namespace tushar::reference {

/// Two uniform bodies of gas that meet at a plane at t = 0.
struct RiemannProblem {
  RiemannState left;               ///< below the diaphragm
  RiemannState right;              ///< above it
  GasLaw gas;                      ///< the law of both gases, or of the left one
  std::optional<GasLaw> rightGas;  ///< the law of the right gas, if it differs
  double diaphragm = 0.5;          ///< its position along `axis`, m
  int axis = 0;                    ///< 0, 1 or 2: the normal of the plane
  /// Velocities along the other axes, m/s: carried along with each gas, so that they jump at the contact alone.
  Vec3 leftTransverse = Vec3::Zero();
  Vec3 rightTransverse = Vec3::Zero();
};

/// The exact solution of a Riemann problem in space and time: shock tubes, Noh's plane wall, gas into vacuum.
///
/// In vacuum density, pressure and energy are 0 and the velocity is that of the nearer front.
/// The internal energy is (p + gamma p_inf) / ((gamma - 1) rho).
/// Source: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., chapter 4.
class ExactRiemann : public GasReference {
 public:
  /// Throws std::invalid_argument as solveRiemann does, and for an impossible axis or diaphragm.
  explicit ExactRiemann(const RiemannProblem& problem);

  GasState at(const Vec3& x, double t) const override;
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;
  std::vector<double> breaks(int axis, double t) const override;

  /// Its pressures are p + p_inf, with the lesser p_inf of two gases.
  const RiemannSolution& solution() const { return solution_; }

 private:
  /// The lesser p_inf, Pa.
  double leastStiffness() const;

  RiemannProblem problem_;
  RiemannSolution solution_;
};

}  // namespace tushar::reference
