#pragma once

#include <Eigen/LU>

#include <map>

#include "components/mpm/solid/implicit/system.hpp"

// The tangent of ImplicitSystem: included by the files that instantiate it.

namespace tushar::mpm::solid::implicit {

template <int D>
void ImplicitSystem<D>::findSlopes(std::size_t point, Slopes& slopes) const {
  slopes.count = 0;
  slopes.hasHoop = false;
  const NodeTouch<D>* touch = touchesOf(point);
  for (int k = 0; k < touches_; ++k) {
    if (touch[k].node < 0) continue;
    const int n = slopes.count++;
    slopes.numbers[n] = touch[k].node;
    for (int i = 0; i < D; ++i) {
      for (int j = 0; j < D; ++j) slopes.along[j][i][n] = touch[k].sign[i] * touch[k].gradient[j];
      slopes.hoop[i][n] = i == 0 ? touch[k].sign[0] * touch[k].hoop : 0.0;
    }
    slopes.hasHoop = slopes.hasHoop || touch[k].hoop != 0;
  }
  for (int n = slopes.count; n < slopes.padded(); ++n)
    for (int i = 0; i < D; ++i) {
      for (int j = 0; j < D; ++j) slopes.along[j][i][n] = 0;
      slopes.hoop[i][n] = 0;
    }
}

/// V0 a_ijkl / stretch with a_ijkl = sum_JL dP_iJ/dF_kL F_old_jJ F_old_lL, for the components that the nodes cause.
template <int D>
auto ImplicitSystem<D>::spatialTangent(const PointGroup& group, int k, const Matrix9& tangent, bool hasHoop) const
    -> Spatial {
  constexpr int most = D * D + 1;
  const int count = hasHoop ? most : D * D;
  const Matrix3& f = group.oldDeformation[k];
  const double factor = group.mass[k] / group.material->undeformedDensity() / states_.stretch[group.first + k];
  std::array<int, most> first, second;  // the axes of each component; the last is the hoop strain
  for (int c = 0; c < D * D; ++c) {
    first[c] = sceneAxis<D>(map_.level(), c / D);
    second[c] = sceneAxis<D>(map_.level(), c % D);
  }
  first[D * D] = second[D * D] = 2;
  Eigen::Matrix<double, 9, most> half;
  for (int c = 0; c < count; ++c) {
    const Eigen::RowVector3d along = factor * f.row(second[c]);
    const int column = 3 * first[c];
    half.col(c) =
        tangent.col(column) * along[0] + tangent.col(column + 1) * along[1] + tangent.col(column + 2) * along[2];
  }
  Spatial a;
  for (int r = 0; r < count; ++r)
    for (int c = 0; c < count; ++c) {
      double sum = 0;
      for (int j = 0; j < 3; ++j) sum += f(second[r], j) * half(3 * first[r] + j, c);
      a[r][c] = sum;
    }
  return a;
}

/// Adds what the hoop strain contributes to the stresses for a unit displacement of a node.
template <int D>
void ImplicitSystem<D>::addHoopForce(const Spatial& a, const Slopes& slopes, int i, int n,
                                     std::array<double, D * D + 1>& force) const {
  constexpr int hoop = D * D;
  for (int j = 0; j < D; ++j) force[hoop] += slopes.along[j][i][n] * a[D * i + j][hoop];
  for (int c = 0; c <= hoop; ++c) force[c] += slopes.hoop[i][n] * a[hoop][c];
}

/// Adds B^T a B, where the columns of B are the slopes.
template <int D>
void ImplicitSystem<D>::addStiffnessOf(const Spatial& a, Local& local) const {
  constexpr int hoop = D * D;
  const Slopes& slopes = local.slopes[local.latest];
  const int padded = slopes.padded();
  for (int n = 0; n < slopes.count; ++n)
    for (int i = 0; i < D; ++i) {
      std::array<double, hoop + 1> force{};
      for (int j = 0; j < D; ++j)
        for (int c = 0; c < hoop; ++c) force[c] += slopes.along[j][i][n] * a[D * i + j][c];
      if (slopes.hasHoop) addHoopForce(a, slopes, i, n, force);
      for (int k = 0; k < D; ++k) {
        double* const row = local.rows[D * n + i][k].data();
        for (int m = 0; m < padded; m += lanes_)
          for (int lane = m; lane < m + lanes_; ++lane) {
            double sum = 0;
            for (int l = 0; l < D; ++l) sum += force[D * k + l] * slopes.along[l][k][lane];
            row[lane] += sum;
          }
        if (!slopes.hasHoop || k > 0) continue;
        for (int m = 0; m < padded; ++m) row[m] += force[hoop] * slopes.hoop[0][m];
      }
    }
}

/// For each component of each node, the sum over i, j of its gradient times `with`.
template <int D>
auto ImplicitSystem<D>::contracted(const Slopes& slopes, const Matrix3& with) const -> Rows {
  const Level& level = map_.level();
  Rows rows;
  for (int i = 0; i < D; ++i)
    for (int n = 0; n < slopes.padded(); ++n) {
      rows[i][n] = slopes.hoop[i][n] * with(2, 2);
      for (int j = 0; j < D; ++j)
        rows[i][n] += slopes.along[j][i][n] * with(sceneAxis<D>(level, i), sceneAxis<D>(level, j));
    }
  return rows;
}

/// The change of ln det F for a unit displacement of each node near a point [1/m].
template <int D>
auto ImplicitSystem<D>::volumeRow(std::size_t point, const Slopes& slopes) const -> Rows {
  return contracted(slopes, (Matrix3::Identity() + states_.gradient[point]).inverse().transpose());
}

/// The nodal forces of a point for a unit change of ln det(stretch F) at its own F [N]: V0 Bᵀ q F_oldᵀ with q = (dP/dF
/// F / stretch - 2 P) / 3.
template <int D>
auto ImplicitSystem<D>::volumeForce(const PointGroup& group, int k, const Matrix9& tangent, const Slopes& slopes) const
    -> Rows {
  const std::size_t at = group.first + k;
  const Matrix3& f = states_.deformation[at];
  const Matrix3 nominal = f.determinant() * states_.stress[at] * f.inverse().transpose();
  const Vector9 along = tangent * Eigen::Map<const Vector9>(f.data()) / states_.stretch[at];
  const Matrix3 q = (Matrix3(Eigen::Map<const Matrix3>(along.data())) - 2 * nominal) / 3;
  return contracted(slopes,
                    group.mass[k] / group.material->undeformedDensity() * (q * group.oldDeformation[k].transpose()));
}

template <int D>
void ImplicitSystem<D>::addStiffness(Local& local, solvers::Matrix& matrix) const {
  const Slopes& slopes = local.slopes[local.latest];
  const int count = slopes.count;
  const std::span<const int> numbers(slopes.numbers.data(), count);
  local.values.resize(std::size_t(D * count) * (D * count));
  double* value = local.values.data();
  for (int n = 0; n < count; ++n)
    for (int i = 0; i < D; ++i) {
      const bool isFree = !isPrescribed(numbers[n], i);
      const Rows& row = local.rows[D * n + i];
      for (int m = 0; m < count; ++m)
        for (int k = 0; k < D; ++k) *value++ = isFree && !isPrescribed(numbers[m], k) ? row[k][m] : 0.0;
    }
  matrix.add(numbers, numbers, local.values);
}

/// Adds the stiffness of the points of a run. Consecutive points that touch the same nodes are added together, such as
/// those of a cell with linear shape functions.
template <int D>
void ImplicitSystem<D>::addRunStiffness(const PointRun& run, solvers::Matrix& matrix) {
  const PointGroup& group = *run.group;
  const bool shares = states_.sharesVolume(run);
  std::vector<Rows> forces;
  Local& local = local_;
  bool isFirst = true;
  states_.forEachTangent(run, [&](int k, const Matrix9& tangent) {
    const std::size_t at = group.first + k;
    Slopes& slopes = local.slopes[1 - local.latest];
    findSlopes(at, slopes);
    if (isFirst || !slopes.hasSameNodes(local.slopes[local.latest])) {
      if (!isFirst) addStiffness(local, matrix);
      for (int row = 0; row < D * slopes.count; ++row)
        for (int i = 0; i < D; ++i) std::fill_n(local.rows[row][i].begin(), slopes.padded(), 0.0);
    }
    isFirst = false;
    local.latest = 1 - local.latest;
    addStiffnessOf(spatialTangent(group, k, tangent, slopes.hasHoop), local);
    if (!shares) return;
    forces.push_back(volumeForce(group, k, tangent, slopes));
    const Rows change = volumeRow(at, slopes);
    for (int n = 0; n < slopes.count; ++n)
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
          for (int m = 0; m < slopes.count; ++m) local.rows[D * n + i][j][m] -= forces.back()[i][n] * change[j][m];
  });
  if (!isFirst) addStiffness(local, matrix);
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
    const Slopes slopes = slopesOf(at);
    const Rows row = volumeRow(at, slopes);
    whole += volume;
    for (int n = 0; n < slopes.count; ++n) {
      Vec<D>& sum = common.try_emplace(slopes.numbers[n], Vec<D>::Zero()).first->second;
      for (int d = 0; d < D; ++d) sum[d] += volume * row[d][n];
    }
  }
  std::vector<int> columns;
  std::vector<double> change;
  for (const auto& [node, row] : common) {
    columns.push_back(node);
    for (int d = 0; d < D; ++d) change.push_back(isPrescribed(node, d) ? 0.0 : row[d] / whole);
  }
  std::vector<double> block;
  for (int k = run.from; k < run.from + run.count; ++k) {
    const Slopes slopes = slopesOf(group.first + k);
    const Rows& force = forces[k - run.from];
    block.clear();
    for (int n = 0; n < slopes.count; ++n)
      for (int i = 0; i < D; ++i) {
        const bool isFree = !isPrescribed(slopes.numbers[n], i);
        for (const double value : change) block.push_back(isFree ? force[i][n] * value : 0.0);
      }
    matrix.add({slopes.numbers.data(), static_cast<std::size_t>(slopes.count)}, columns, block);
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
