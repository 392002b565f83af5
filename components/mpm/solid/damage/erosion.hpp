#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// What becomes of a particle that has failed.
struct Erosion {
  enum class Algorithm {
    none,            ///< nothing
    allowNoTension,  ///< it bears pressure only
    zeroStress,      ///< it bears nothing and is not deformed further
    allowNoShear,    ///< it bears mean stress only
    preserveStress   ///< it is only marked
  };
  Algorithm algorithm = Algorithm::none;
  double relaxationTime =
      1e-99;  ///< in which lost stress of a function of F fades to 1/e, s; others fade anew each step

  bool acts() const { return algorithm != Algorithm::none; }

  /// The stress that a particle which failed some seconds ago still bears, Pa.
  Matrix3 bearable(const Matrix3& stress, double sinceFailure) const {
    const double mean = stress.trace() / 3, faded = std::exp(-sinceFailure / relaxationTime);
    switch (algorithm) {
      case Algorithm::allowNoTension:
        return mean > 0 ? Matrix3(faded * stress) : Matrix3(mean * Matrix3::Identity());
      case Algorithm::zeroStress:
        return faded * stress;
      case Algorithm::allowNoShear:
        return mean * Matrix3::Identity();
      default:
        return stress;
    }
  }
  /// What a failed particle keeps of a step's deformation: its volume only or, without stress, nothing.
  void restrain(const Matrix3& oldDeformation, Matrix3& deformation, Matrix3& velocityGradient) const {
    if (algorithm == Algorithm::zeroStress) {
      deformation = oldDeformation;
      velocityGradient.setZero();
    } else if (algorithm == Algorithm::allowNoTension || algorithm == Algorithm::allowNoShear) {
      deformation = std::cbrt(deformation.determinant()) * Matrix3::Identity();
      velocityGradient = Matrix3(velocityGradient.trace() / 3 * Matrix3::Identity());
    }
  }
};

}  // namespace tushar::mpm::solid
