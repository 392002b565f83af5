#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/constitutive/tensor_lanes.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

/// Stresses of particles that are contiguous in memory: stored stresses, or those that follow from F.
struct StressSource {
  const Matrix3* stress = nullptr;       ///< stress [Pa]; null if the stress is a function of F alone
  const double* volume = nullptr;        ///< volume [m^3]; null if and only if `stress` is
  const Matrix3* deformation = nullptr;  ///< F [1]; null if and only if `stress` is not
};

/// Computes V sigma [N m] of `count` particles starting with `first`; `startVolume(p)` is V0 [m^3], for stresses that
/// follow from F.
template <class StartVolume>
void stressMoments(const Material& material, const StressSource& from, int first, int count, StartVolume&& startVolume,
                   Matrix3* moments) {
  if (from.stress) {
    for (int k = 0; k < count; ++k) moments[k] = from.volume[first + k] * from.stress[first + k];
    return;
  }
  material.model->kirchhoffStress(from.deformation + first, count, moments);
  for (int k = 0; k < count; ++k) moments[k] *= startVolume(first + k);
}

/// Computes sigma [Pa] of `count` particles whose stress is a function of F alone.
inline void cauchyStress(const Material& material, const Matrix3* deformation, int count, Matrix3* stress) {
  material.model->kirchhoffStress(deformation, count, stress);
  for (int k = 0; k < count; k += Lanes::count) {
    const Lanes j = determinant(lanesOf(deformation + k, count - k));
    TensorOf<Lanes> of = lanesOf(stress + k, count - k);
    for (int i = 0; i < 3; ++i)
      for (int l = 0; l < 3; ++l) of(i, l) /= j;
    storeLanes(of, stress + k, count - k);
  }
}

}  // namespace tushar::mpm::solid
