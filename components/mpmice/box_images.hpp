#pragma once

#include <array>
#include <utility>

#include "components/mpmice/particle_box.hpp"

namespace tushar::mpmice {

/// Number of layers of cells in front of a symmetry plane in which particles have boxes that may cover the plane, or
/// images that may reach the grid.
inline constexpr int imageReach = 2;

/// Whether a side of a level is a plane beyond which gas and bodies have mirror images.
inline bool isPlane(const Level& level, int axis, int side) {
  return !level.isPeriodic(axis) && level.isSymmetry(axis, side);
}
/// Whether any upper side of a level is such a plane.
inline bool hasUpperPlane(const Level& level) {
  bool any = false;
  for (int d = 0; d < level.dimension(); ++d) any |= isPlane(level, d, 1);
  return any;
}

/// The symmetry planes of a level, and the mirror images beyond them of the boxes of particles. Together with its
/// images, half of a symmetric body leaves as much of each cell and face free as the whole body.
template <int D>
class BoxImages {
 public:
  /// Without planes.
  BoxImages() = default;
  explicit BoxImages(const Level& level) : grid_(level.cells()) {
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) any_ |= has_[d][side] = isPlane(level, d, side);
  }

  /// Whether the upper end of some cells along an axis is that of the grid, and a plane.
  bool endsAtPlane(const Box& cells, int axis) const { return has_[axis][1] && cells.upper[axis] == grid_.upper[axis]; }

  /// Whether a cell is so close to a plane that images of boxes in it may reach the grid.
  bool areNear(const Index<D>& cell) const {
    bool near = false;
    for (int d = 0; d < D && any_; ++d) {
      near |= has_[d][0] && cell[d] < grid_.lower[d] + imageReach;
      near |= has_[d][1] && cell[d] >= grid_.upper[d] - imageReach;
    }
    return near;
  }

  /// Calls `visit(cell, images)` for the mirror images of some boxes, whose coordinates are relative to the cell
  /// `origin`, if one of them or a face that it covers may be on the grid; the coordinates of the images are relative
  /// to `cell`. Images beyond an edge or a corner are mirrored along several axes, but along each only once.
  template <std::size_t N, class Visit>
  void forEachOf(const Index<D>& origin, const std::array<ParticleBox<D>, N>& boxes, Visit&& visit) const {
    if (!any_) return;
    std::array<std::array<bool, 2>, D> reaches{};
    bool any = false;
    for (int d = 0; d < D; ++d)
      for (const ParticleBox<D>& box : boxes) {
        const double middle = origin[d] + box.middle[d], edge = box.edges[d];
        any |= reaches[d][0] |= has_[d][0] && middle - edge < grid_.lower[d];
        any |= reaches[d][1] |= has_[d][1] && middle + edge > grid_.upper[d];
      }
    if (!any) return;
    Box ways{{}, Index3::filled(1)};  // along each axis: not mirrored, or mirrored at the lower or the upper side
    for (int d = 0; d < D; ++d) ways.upper[d] = 3;
    forEach<D>(ways, [&](const Index<D>& way) {
      Index<D> cell = origin;
      std::array<ParticleBox<D>, N> images = boxes;
      bool is = false, may = true;
      for (int d = 0; d < D; ++d) {
        if (way[d] == 0) continue;
        is = true;
        may = may && reaches[d][way[d] - 1];
        cell[d] = (way[d] == 1 ? 2 * grid_.lower[d] : 2 * grid_.upper[d]) - 1 - origin[d];
        for (ParticleBox<D>& image : images) image.middle[d] = 1 - image.middle[d];
      }
      if (is && may) visit(std::as_const(cell), std::as_const(images));
    });
  }

 private:
  Box grid_;
  std::array<std::array<bool, 2>, D> has_{};
  bool any_ = false;
};

}  // namespace tushar::mpmice
