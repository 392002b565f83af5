#pragma once

#include <Eigen/LU>
#include <type_traits>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// Computes the tangent dP/dF of the first Piola-Kirchhoff stress P = tau F^-T from the tangent of the Kirchhoff stress
/// tau [Pa].
///
/// `change(h)` is the change of tau [Pa] when F changes by dF = h F; it is linear in h. `change(k, l)`, which a model
/// may give instead, is that for h = e_k e_l. With its matrix c, dP_iJ / dF_kL = sum_jl F^-1_Jj (c_ijkl - tau_il
/// delta_jk) F^-1_Ll; Simo & Hughes, Computational Inelasticity (1998), section 7.1.
template <class Change>
Matrix9 nominalTangent(const Matrix3& f, const Matrix3& kirchhoffStress, Change&& change) {
  const auto along = [&](int k, int l) -> Matrix3 {
    if constexpr (std::is_invocable_v<Change, int, int>) {
      return change(k, l);
    } else {
      Matrix3 h = Matrix3::Zero();
      h(k, l) = 1;
      return change(h);
    }
  };
  const Matrix3 inverse = f.inverse();
  Matrix9 tangent;
  for (int k = 0; k < 3; ++k) {
    double half[3][9];  // dP for h = e_k e_l, by l
    for (int l = 0; l < 3; ++l) {
      Matrix3 changed = along(k, l);
      for (int i = 0; i < 3; ++i) changed(i, k) -= kirchhoffStress(i, l);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          half[l][3 * i + j] =
              changed(i, 0) * inverse(j, 0) + changed(i, 1) * inverse(j, 1) + changed(i, 2) * inverse(j, 2);
    }
    for (int row = 0; row < 9; ++row)
      for (int l = 0; l < 3; ++l)
        tangent(row, 3 * k + l) =
            inverse(l, 0) * half[0][row] + inverse(l, 1) * half[1][row] + inverse(l, 2) * half[2][row];
  }
  return tangent;
}

}  // namespace tushar::mpm::solid
