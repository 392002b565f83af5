#pragma once

#include <optional>
#include <vector>

#include "components/reference/gas_reference.hpp"
#include "components/reference/riemann_solution.hpp"

namespace tushar::reference {

/// Two uniform bodies of gas that meet at a plane at t = 0.
struct RiemannProblem {
  RiemannState left;               ///< state below the diaphragm
  RiemannState right;              ///< state above the diaphragm
  GasLaw gas;                      ///< law of both gases, or of the left gas
  std::optional<GasLaw> rightGas;  ///< law of the right gas, if it differs
  double diaphragm = 0.5;          ///< position of the diaphragm along `axis` [m]
  int axis = 0;                    ///< axis normal to the plane: 0, 1 or 2
  /// Velocities along the other axes [m/s]. They move with each gas, so they jump only at the contact.
  Vec3 leftTransverse = Vec3::Zero();
  Vec3 rightTransverse = Vec3::Zero();
};

/// The exact solution of a Riemann problem in space and time: shock tubes, Noh's plane wall, gas into vacuum.
///
/// In vacuum, density, pressure and energy are 0, and the velocity is that of the nearer front. The internal energy is
/// (p + gamma p_inf) / ((gamma - 1) rho). Source: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics,
/// 3rd ed., chapter 4.
class ExactRiemann : public GasReference {
 public:
  /// Throws the std::invalid_argument of solveRiemann, and one for an impossible axis or diaphragm.
  explicit ExactRiemann(const RiemannProblem& problem);

  GasState at(const Vec3& x, double t) const override;
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override;
  std::vector<double> breaks(int axis, double t) const override;

  /// The solution; its pressures are p + p_inf, with the smaller p_inf of the two gases.
  const RiemannSolution& solution() const { return solution_; }

 private:
  /// The smaller p_inf of the two gases [Pa].
  double leastStiffness() const;

  RiemannProblem problem_;
  RiemannSolution solution_;
};

}  // namespace tushar::reference
