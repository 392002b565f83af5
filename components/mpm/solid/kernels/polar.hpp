#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// R of F = R U, by Newton's iteration R <- (R + R^-T)/2; Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160.
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

/// A step as seen by an observer who turns with the material, so that rates of stress are those of Green & Naghdi.
struct Corotated {
  Matrix3 after;   ///< rotation at the end of the step
  Matrix3 strain;  ///< D dt, 1
  Matrix3 stress;  ///< at the begin, Pa

  Corotated(const Deformation& d, const Matrix3& oldStress) : after(rotationOf(d.deformationGradient)) {
    const Matrix3 before = rotationOf(d.oldDeformationGradient);
    const Matrix3 rate = 0.5 * d.timeStep * (d.velocityGradient + d.velocityGradient.transpose());
    strain = before.transpose() * rate * before;
    stress = before.transpose() * oldStress * before;
  }
  /// What the resting observer sees at the end of the step.
  Matrix3 turned(const Matrix3& tensor) const { return after * tensor * after.transpose(); }
};

/// The work of the mean stress in a step, J per m^3 of the volume at the start: D : (mean sigma) (mean J) dt.
inline double stressWork(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress) {
  const Matrix3 mean = 0.5 * (oldStress + stress);
  const double volume = 0.5 * (d.deformationGradient.determinant() + d.oldDeformationGradient.determinant());
  return d.velocityGradient.cwiseProduct(mean).sum() * volume * d.timeStep;
}

}  // namespace tushar::mpm::solid
