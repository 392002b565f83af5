#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/transfer/extent.hpp"
#include "core/base/quad.hpp"

namespace tushar::mpmice {

/// The box that represents a particle, by its centre and its edges along the axes, in cells. The centre is measured
/// from the lower corner of the cell in which the particle started the step.
template <int D>
struct ParticleBox {
  Vec<D> middle, edges;

  /// Lengths along an axis of the parts in four cells, given by the coordinates of their lower faces.
  Quad lengthsIn(int axis, const Quad& faces) const {
    const double half = 0.5 * edges[axis];
    const Quad lower = greater(faces, (middle[axis] - half) + Quad{});
    const Quad upper = lesser(faces + 1, (middle[axis] + half) + Quad{});
    return greater(upper - lower, Quad{});
  }
  /// Length along an axis of the part in cell `k`, in cells.
  double lengthIn(int axis, int k) const { return lengthsIn(axis, double(k) + Quad{})[0]; }
  /// Lengths along an axis of the parts above four faces.
  Quad lengthsAbove(int axis, const Quad& faces) const {
    return lesser(greater(middle[axis] + 0.5 * edges[axis] - faces, Quad{}), edges[axis] + Quad{});
  }
  /// Weights of four faces along an axis: 1 at the centre of the box, decreasing to 0 at a distance of one edge of the
  /// box. So adjacent boxes fully cover a face.
  Quad hatsAt(int axis, const Quad& faces) const {
    const Quad apart = faces - middle[axis];
    return greater(1 - greater(apart, -apart) / edges[axis], Quad{});
  }

  /// The cells into which the box may extend, or whose lower faces have a weight.
  Box reach() const {
    Box cells{{}, Index3::filled(1)};
    for (int d = 0; d < D; ++d) {
      cells.lower[d] = static_cast<int>(std::floor(middle[d] - edges[d]));
      cells.upper[d] = static_cast<int>(std::floor(middle[d] + edges[d])) + 1;
    }
    return cells;
  }

 private:
  static Quad greater(const Quad& a, const Quad& b) { return a > b ? a : b; }
  static Quad lesser(const Quad& a, const Quad& b) { return a < b ? a : b; }
};

/// Longest edge of a box, in cells; longer particles are treated as if they had this length.
inline constexpr double longestEdge = 1.5;

/// The edges, in cells, of the box of a particle that had the edges `size`, in cells, before it was deformed by F. If F
/// does not rotate, they are the edges stretched by F along the axes. Otherwise, they are |F S e_a| along each axis,
/// scaled to the volume det F.
template <int D>
Vec<D> edgesOf(const Level& level, const Vec<D>& size, const mpm::solid::Matrix3& deformation) {
  Eigen::Matrix<double, D, D> edges;
  bool isTurned = false;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      edges(i, j) = deformation(mpm::solid::sceneAxis<D>(level, i), mpm::solid::sceneAxis<D>(level, j)) * size[j];
      if (i == j) continue;
      isTurned |= edges(i, j) != 0;
      edges(i, j) *= level.spacing(j) * level.inverseSpacing(i);
    }
  Vec<D> lengths = edges.diagonal();
  if (isTurned) {
    for (int i = 0; i < D; ++i) lengths[i] = edges.row(i).norm();
    const double volume = std::abs(edges.determinant());
    const double ratio = volume / lengths.prod();
    lengths *= D == 1 ? ratio : D == 2 ? std::sqrt(ratio) : std::cbrt(ratio);
  }
  return lengths.cwiseAbs().cwiseMin(longestEdge);
}

}  // namespace tushar::mpmice
