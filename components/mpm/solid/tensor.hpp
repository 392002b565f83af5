#pragma once

#include <array>

#include "core/base/vec.hpp"

namespace tushar::mpm::solid {

/// A second-order tensor in x, y, z, row by row, of numbers or, for several tensors side by side, of Lanes. Always
/// three by three: a solid in one or two dimensions is in plane strain.
template <class Real>
using TensorOf = Eigen::Matrix<Real, 3, 3, Eigen::DontAlign | Eigen::RowMajor>;
using Matrix3 = TensorOf<double>;

/// A second-order tensor as stored in a State, row by row.
using Tensor = std::array<double, 9>;
inline Matrix3 matrixOf(const Tensor& tensor) { return Eigen::Map<const Matrix3>(tensor.data()); }
inline Tensor tensorOf(const Matrix3& matrix) {
  Tensor tensor;
  Eigen::Map<Matrix3>(tensor.data()) = matrix;
  return tensor;
}
inline constexpr Tensor identityTensor{1, 0, 0, 0, 1, 0, 0, 0, 1};

/// The derivative of one second-order tensor with respect to another, each as nine numbers row by row.
using Matrix9 = Eigen::Matrix<double, 9, 9, Eigen::DontAlign | Eigen::RowMajor>;
using Vector9 = Eigen::Matrix<double, 9, 1, Eigen::DontAlign>;

/// The deviatoric part of a tensor, which has no trace.
inline Matrix3 deviator(const Matrix3& a) {
  Matrix3 result = a;
  result.diagonal().array() -= a.trace() / 3;
  return result;
}

}  // namespace tushar::mpm::solid
