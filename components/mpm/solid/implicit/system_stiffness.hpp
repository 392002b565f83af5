#pragma once

#include <Eigen/LU>

#include <map>

#include "components/mpm/solid/implicit/system.hpp"

// The tangent of ImplicitSystem: included by the files that instantiate it.

namespace tushar::mpm::solid::implicit {

/// The nine components of the displacement gradient for a unit displacement of each node near a point.
template <int D>
auto ImplicitSystem<D>::strainOf(std::size_t point) const -> Strain {
  const Level& level = map_.level();
  const NodeTouch<D>* touch = touchesOf(point);
  Strain strain = Strain::Zero(9, touches_ * D);
  for (int k = 0; k < touches_; ++k) {
    if (touch[k].node < 0) continue;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        strain(3 * sceneAxis<D>(level, i) + sceneAxis<D>(level, j), D * k + i) =
            touch[k].sign[i] * touch[k].gradient[j];
    strain(8, D * k) += touch[k].sign[0] * touch[k].hoop;
  }
  return strain;
}

/// Adds V0 Bᵀ a B / stretch, where B is strainOf and a_ijkl = sum_JL dP_iJ/dF_kL F_old_jJ F_old_lL. A column of B has
/// at most D non-zero numbers, and one more for the hoop strain; only these are multiplied.
template <int D>
void ImplicitSystem<D>::addStiffnessOf(const PointGroup& group, int k, const Matrix9& tangent, Local& stiffness) const {
  const std::size_t at = group.first + k;
  const Matrix3& f = group.oldDeformation[k];
  Matrix9 half;
  Eigen::Matrix<double, 9, 9, Eigen::RowMajor> whole;
  for (int c = 0; c < 3; ++c) half.middleCols<3>(3 * c) = tangent.middleCols<3>(3 * c) * f.transpose();
  for (int c = 0; c < 3; ++c) whole.middleRows<3>(3 * c) = f * half.middleRows<3>(3 * c);
  whole *= group.mass[k] / group.material->density / states_.stretch[at];
  std::array<int, D> axis;
  for (int d = 0; d < D; ++d) axis[d] = sceneAxis<D>(map_.level(), d);
  const NodeTouch<D>* touch = touchesOf(at);
  /// Returns `sum` plus the sum over k of `rows(k)` times B_kc, where c is the column of component i of a node.
  const auto times = [&](const NodeTouch<D>& node, int i, const auto& rows, auto sum) {
    for (int j = 0; j < D; ++j) sum += rows(3 * axis[i] + axis[j]) * node.gradient[j];
    if (i == 0 && node.hoop != 0) sum += rows(8) * node.hoop;
    sum *= node.sign[i];
    return sum;
  };
  for (int n = 0; n < touches_; ++n)
    for (int i = 0; i < D; ++i) {
      if (touch[n].node < 0) continue;
      using Row = Eigen::Matrix<double, 1, 9>;
      const Row force = times(
          touch[n], i, [&](int row) { return whole.row(row); }, Row(Row::Zero()));
      for (int m = 0; m < touches_; ++m)
        for (int j = 0; j < D; ++j)
          if (touch[m].node >= 0)
            stiffness(D * n + i, D * m + j) += times(
                touch[m], j, [&](int row) { return force[row]; }, 0.0);
    }
}

/// The change of ln det F for a unit displacement of each node near a point [1/m].
template <int D>
auto ImplicitSystem<D>::volumeRow(std::size_t point) const -> Rows {
  const Matrix3 inverse = (Matrix3::Identity() + states_.gradient[point]).inverse().transpose();
  return strainOf(point).transpose() * Eigen::Map<const Vector9>(inverse.data());
}

/// The nodal forces of a point for a unit change of ln det(stretch F) at its own F [N]: V0 Bᵀ q F_oldᵀ with q = (dP/dF
/// F / stretch - 2 P) / 3.
template <int D>
auto ImplicitSystem<D>::volumeForce(const PointGroup& group, int k, const Matrix9& tangent) const -> Rows {
  const std::size_t at = group.first + k;
  const Matrix3& f = states_.deformation[at];
  const Matrix3 nominal = f.determinant() * states_.stress[at] * f.inverse().transpose();
  const Vector9 along = tangent * Eigen::Map<const Vector9>(f.data()) / states_.stretch[at];
  const Matrix3 q = (Matrix3(Eigen::Map<const Matrix3>(along.data())) - 2 * nominal) / 3;
  const Matrix3 pushed = q * group.oldDeformation[k].transpose();
  return group.mass[k] / group.material->density *
         (strainOf(at).transpose() * Eigen::Map<const Vector9>(pushed.data()));
}

template <int D>
auto ImplicitSystem<D>::numbersOf(std::size_t point) const -> std::array<int, mostTouches<D>> {
  std::array<int, mostTouches<D>> numbers;
  for (int n = 0; n < touches_; ++n) numbers[n] = touchesOf(point)[n].node;
  return numbers;
}

template <int D>
void ImplicitSystem<D>::addStiffness(std::span<const int> numbers, Local& stiffness, solvers::Matrix& matrix) const {
  for (int n = 0; n < touches_; ++n)
    for (int d = 0; d < D; ++d) {
      const int node = numbers[n];
      if (node < 0 || !isPrescribed(node, d)) continue;
      stiffness.row(D * n + d).setZero();
      stiffness.col(D * n + d).setZero();
    }
  matrix.add(numbers, numbers, {stiffness.data(), static_cast<std::size_t>(stiffness.size())});
}

/// Adds the stiffness of the points of a run. Consecutive points that touch the same nodes are added together, such as
/// those of a cell with linear shape functions.
template <int D>
void ImplicitSystem<D>::addRunStiffness(const PointRun& run, solvers::Matrix& matrix) {
  const PointGroup& group = *run.group;
  const bool shares = states_.sharesVolume(run);
  std::vector<Rows> forces;
  Local stiffness(0, 0);
  std::array<int, mostTouches<D>> numbers;
  const std::span touched = std::span(numbers).first(touches_);
  states_.forEachTangent(run, [&](int k, const Matrix9& tangent) {
    const std::size_t at = group.first + k;
    const auto here = numbersOf(at);
    if (stiffness.size() == 0 || !std::equal(touched.begin(), touched.end(), here.begin())) {
      if (stiffness.size() > 0) addStiffness(touched, stiffness, matrix);
      numbers = here;
      stiffness.setZero(touches_ * D, touches_ * D);
    }
    addStiffnessOf(group, k, tangent, stiffness);
    if (!shares) return;
    forces.push_back(volumeForce(group, k, tangent));
    stiffness -= forces.back() * volumeRow(at).transpose();
  });
  if (stiffness.size() > 0) addStiffness(touched, stiffness, matrix);
  if (shares) addSharedStiffness(run, forces, matrix);
}

/// Adds the stiffness with which the points of a run resist a common change of volume.
template <int D>
void ImplicitSystem<D>::addSharedStiffness(const PointRun& run, const std::vector<Rows>& forces,
                                           solvers::Matrix& matrix) const {
  const PointGroup& group = *run.group;
  std::map<int, Vec<D>> common;
  double whole = 0;
  for (int k = run.from; k < run.from + run.count; ++k) {
    const std::size_t at = group.first + k;
    const double volume = group.mass[k] * states_.deformation[at].determinant();
    const Rows row = volumeRow(at);
    whole += volume;
    for (int n = 0; n < touches_; ++n)
      if (const int node = touchesOf(at)[n].node; node >= 0)
        common.try_emplace(node, Vec<D>::Zero()).first->second += volume * row.template segment<D>(D * n);
  }
  std::vector<int> columns;
  std::vector<double> change;
  for (const auto& [node, row] : common) {
    columns.push_back(node);
    for (int d = 0; d < D; ++d) change.push_back(isPrescribed(node, d) ? 0.0 : row[d] / whole);
  }
  std::vector<double> block;
  for (int k = run.from; k < run.from + run.count; ++k) {
    const auto all = numbersOf(group.first + k);
    const std::span rows = std::span(all).first(touches_);
    const Rows& force = forces[k - run.from];
    block.clear();
    for (int i = 0; i < touches_ * D; ++i) {
      const int node = rows[i / D];
      const bool free = node >= 0 && !isPrescribed(node, i % D);
      for (const double value : change) block.push_back(free ? force[i] * value : 0.0);
    }
    matrix.add(rows, columns, block);
  }
}

/// Adds inertia and weak springs and, for prescribed displacements, diagonal entries that are as stiff as the others.
template <int D>
void ImplicitSystem<D>::addDiagonals(solvers::Matrix& matrix) const {
  for (int k = 0; k < map_.owned(); ++k) {
    Eigen::Matrix<double, D, D> block;  // diagonal: the order of rows and columns does not matter
    block.setZero();
    const Node& node = node_[k];
    const double free = node.support + (how_.dynamic ? 4 * node.mass / (dt_ * dt_) : 0.0);
    for (int d = 0; d < D; ++d) block(d, d) = isPrescribed(k, d) ? stiffest_ : free;
    matrix.add({&k, 1}, {&k, 1}, {block.data(), D * D});
  }
}

template <int D>
void ImplicitSystem<D>::tangent(solvers::Matrix& matrix) {
  forEachRun([&](const PointSources<D>&, const PointRun& run) { addRunStiffness(run, matrix); });
  addDiagonals(matrix);
}

}  // namespace tushar::mpm::solid::implicit
