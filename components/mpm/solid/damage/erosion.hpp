#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// What happens to failed particles.
struct Erosion {
  enum class Algorithm {
    none,            ///< nothing changes
    allowNoTension,  ///< only pressure remains
    zeroStress,      ///< no stress remains, and the particle does not deform any more
    allowNoShear,    ///< only mean stress remains
    preserveStress   ///< all stress remains: the particle is only marked
  };
  Algorithm algorithm = Algorithm::none;
  /// Decay time of the lost stress [s]. It is exact for stresses that are functions of F; stresses that a model
  /// increments decay anew in each step.
  double relaxationTime = 1e-99;

  bool acts() const { return algorithm != Algorithm::none; }
  /// Whether failed particles keep their stress.
  bool keepsStress() const { return algorithm == Algorithm::preserveStress || algorithm == Algorithm::none; }

  /// Remaining stress of a particle [Pa]; `sinceFailure` is the time since its failure [s].
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
  /// Reduces the deformation of a failed particle in a step to its change of volume or, if it has no stress, to none.
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
