#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "components/mpm/solid/constitutive/model.hpp"

namespace tushar::mpm::solid::testing {

/// A rotation about (1, 2, 3) by an angle [rad].
inline Matrix3 rotation(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

/// A deformation gradient without symmetries: a rotation and strains of the order of `strain`.
inline Matrix3 generalDeformation(double strain) {
  Matrix3 gradient;
  gradient << 1.0, 0.5, -0.3, 0.2, -0.8, 0.4, -0.6, 0.1, 0.7;
  return rotation(0.4) * (Matrix3::Identity() + strain * gradient);
}

/// A material point and its step: calls updateStress with a deformation gradient for the end of the step.
template <class M>
struct MaterialPoint {
  M model;
  Matrix3 oldDeformation = Matrix3::Identity();
  Matrix3 oldStress = Matrix3::Zero();
  double timeStep = 1e-3;
  double temperature = 300;
  typename M::State oldState = model.initialState();

  Deformation step(const Matrix3& f) const {
    const Matrix3 velocityGradient = (f * oldDeformation.inverse() - Matrix3::Identity()) / timeStep;
    return {f, oldDeformation, velocityGradient, timeStep, temperature};
  }
  Matrix3 stress(const Matrix3& f) const {
    typename M::State state = oldState;
    return model.updateStress(step(f), oldStress, state);
  }
  typename M::State state(const Matrix3& f) const {
    typename M::State state = oldState;
    model.updateStress(step(f), oldStress, state);
    return state;
  }
  /// P = J sigma F^-T
  Matrix3 nominalStress(const Matrix3& f) const { return f.determinant() * stress(f) * f.inverse().transpose(); }
  double energy(const Matrix3& f) const {
    typename M::State state = oldState;
    const Matrix3 after = model.updateStress(step(f), oldStress, state);
    return model.strainEnergyDensity(step(f), oldStress, after, state);
  }
  /// Ends the step with the deformation gradient F.
  void advance(const Matrix3& f) {
    const Deformation deformation = step(f);
    oldStress = model.updateStress(deformation, oldStress, oldState);
    oldDeformation = f;
  }
};

/// d f(F) / dF by fourth-order differences with steps of `h`; one column per component of F, row by row.
template <class Function>
auto derivative(const Function& f, const Matrix3& at, double h = 1e-3) {
  constexpr int rows = int(sizeof(f(at)) / sizeof(double));
  Eigen::Matrix<double, rows, 9> result;
  for (int k = 0; k < 9; ++k) {
    const auto moved = [&](double by) {
      Matrix3 there = at;
      there(k / 3, k % 3) += by;
      const auto value = f(there);
      return Eigen::Matrix<double, rows, 1>(
          Eigen::Map<const Eigen::Matrix<double, rows, 1>>(reinterpret_cast<const double*>(&value)));
    };
    result.col(k) = (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
  }
  return result;
}

}  // namespace tushar::mpm::solid::testing
