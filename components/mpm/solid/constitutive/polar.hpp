#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// The rotation R of F = R U, by Newton's iteration R <- (R + R^-T)/2; Higham, SIAM J. Sci. Stat. Comput. 7 (1986)
/// 1160.
inline Matrix3 rotationOf(const Matrix3& f) {
  Matrix3 rotation = f;
  for (int step = 0; step < 50; ++step) {
    const Matrix3 next = 0.5 * (rotation + rotation.inverse().transpose());
    const double change = (next - rotation).squaredNorm();
    rotation = next;
    if (change < 1e-30) break;
  }
  return rotation;
}

/// The spin W = dR Rᵀ of F = V R when F changes by h F: h V = dV + V W, dV symmetric. With axial vectors, (tr V I - V)
/// w = a, where A = h V - V hᵀ.
inline Matrix3 spinOf(const Matrix3& h, const Matrix3& stretch) {
  const Matrix3 a = h * stretch - stretch * h.transpose();
  const Matrix3 lever = stretch.trace() * Matrix3::Identity() - stretch;
  const Eigen::Vector3d w = lever.inverse() * Eigen::Vector3d(a(2, 1), a(0, 2), a(1, 0));
  Matrix3 spin;
  spin << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  return spin;
}

/// A step in axes that rotate with the material, so that stress rates are those of Green & Naghdi.
struct Corotated {
  Matrix3 before;  ///< rotation at the start of the step
  Matrix3 after;   ///< rotation at the end of the step
  Matrix3 strain;  ///< strain of the step, D dt [1]
  Matrix3 stress;  ///< stress at the start of the step, in the rotated axes [Pa]

  Corotated(const Deformation& d, const Matrix3& oldStress)
      : before(rotationOf(d.oldDeformationGradient)), after(rotationOf(d.deformationGradient)) {
    const Matrix3 rate = 0.5 * d.timeStep * (d.velocityGradient + d.velocityGradient.transpose());
    strain = seen(rate);
    stress = seen(oldStress);
  }
  /// The components in the rotated axes of a tensor given at the start of the step.
  Matrix3 seen(const Matrix3& tensor) const { return before.transpose() * tensor * before; }
  /// The components in fixed axes, at the end of the step, of a tensor given in the rotated axes.
  Matrix3 turned(const Matrix3& tensor) const { return after * tensor * after.transpose(); }
};

/// The work of the mean stress in a step, D : (mean sigma) (mean J) dt [J per m^3 of the initial volume].
inline double stressWork(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress) {
  const Matrix3 mean = 0.5 * (oldStress + stress);
  const double volume = 0.5 * (d.deformationGradient.determinant() + d.oldDeformationGradient.determinant());
  return d.velocityGradient.cwiseProduct(mean).sum() * volume * d.timeStep;
}

}  // namespace tushar::mpm::solid
