#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// Computes the tangent dP/dF of the first Piola-Kirchhoff stress P = tau F^-T from the tangent of the Kirchhoff stress
/// tau [Pa].
///
/// `change(h)` is the change of tau [Pa] when F changes by dF = h F; it is linear in h. With its matrix c,
/// dP_iJ / dF_kL = sum_jl F^-1_Jj (c_ijkl - tau_il delta_jk) F^-1_Ll;
/// Simo & Hughes, Computational Inelasticity (1998), section 7.1.
template <class Change>
Matrix9 nominalTangent(const Matrix3& f, const Matrix3& kirchhoffStress, Change&& change) {
  const Matrix3 inverse = f.inverse();
  Matrix9 tangent;
  for (int k = 0; k < 3; ++k) {
    std::array<Matrix3, 3> along;  // dP for h = e_k e_l
    for (int l = 0; l < 3; ++l) {
      Matrix3 h = Matrix3::Zero();
      h(k, l) = 1;
      const Matrix3 changed = change(h) - kirchhoffStress * h.transpose();
      along[l] = changed * inverse.transpose();
    }
    for (int l = 0; l < 3; ++l) {
      const Matrix3 column = inverse(l, 0) * along[0] + inverse(l, 1) * along[1] + inverse(l, 2) * along[2];
      tangent.col(3 * k + l) = Eigen::Map<const Vector9>(column.data());
    }
  }
  return tangent;
}

}  // namespace tushar::mpm::solid
