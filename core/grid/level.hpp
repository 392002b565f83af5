#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/grid/boundary.hpp"
#include "core/grid/box.hpp"
#include "core/grid/refinement.hpp"
#include "core/grid/several_boxes.hpp"

namespace tushar::grid {

class Grid;
template <class T>
class BoundarySides;

/// A uniform grid as described by a scene [m].
struct Domain {
  Vec3 lower = Vec3::Zero();
  Vec3 upper = Vec3::Ones();
  Index3 resolution{{1, 1, 1}};  ///< number of cells along x, y, z
  std::vector<Box> boxes;        ///< several boxes of these cells along x, y, z, if the grid has no others
  Index3 patches{{1, 1, 1}};     ///< number of patches along x, y, z
  bool mayRecut = false;         ///< whether the cuts between patches may follow the particles (see Grid::recut)
  Index3 periodic{};             ///< 1 for periodic axes, otherwise 0
  int nodesBeyond = 0;           ///< layers of nodes outside every side that is not periodic, for wide shape functions
  Refinement refinement;         ///< permitted refinement; none by default
  BoundaryConditions boundaries;
};

/// A grid of cells of one size: its geometry and its boundary conditions. The grid of a run has one or several levels,
/// each with half the cell width of the previous level (see Grid); on each level, cells and nodes are counted from 0.
///
/// Kernels use `dimension()` axes. An axis of the scene is omitted if it has no extent, or has one cell between two
/// symmetry planes or one periodic cell; the other axes keep their order.
///
/// Along a periodic axis, cell and node indices continue beyond both ends: outside the grid they refer to images of the
/// cells inside, and to ghosts of the patches there. The first and the last node of the grid are the same point; the
/// patches at both ends complete its values.
///
/// A level may consist of several boxes: then some of `cells()` are outside (see SeveralBoxes).
class Level {
 public:
  explicit Level(const Domain& domain) : Level(domain, 0, 1, nullptr) {}
  /// Constructs level `number` of the `levels` levels of `grid`, which must outlive it: `domain`'s cells are halved
  /// `number` times.
  Level(const Domain& domain, int number, int levels, const Grid* grid);
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;

  /// Index of the level; 0 is the coarsest.
  int number() const { return number_; }
  /// The grid to which this level belongs; only if there is one.
  const Grid& grid() const { return *grid_; }
  /// The finest level of the grid; this one if there are no finer levels.
  const Level& finest() const;
  int dimension() const { return static_cast<int>(axes_.size()); }
  /// The axis of the scene (0: x, 1: y, 2: z) that corresponds to a kernel axis.
  int axis(int kernelAxis) const { return axes_[kernelAxis]; }

  /// All cells of the grid on this level; the lower corner is always 0.
  const Box& cells() const { return cells_; }
  /// The boxes of which this level consists; null if it is one box.
  const SeveralBoxes* boxes() const { return boxes_.get(); }
  /// Whether a cell is one of `cells()` and, if the level consists of several boxes, in one of these.
  template <int D>
  bool isInside(const Index<D>& cell) const {
    return cells_.contains(cell) && (!boxes_ || boxes_->contains(wide(cell)));
  }
  /// Whether a node belongs to a cell that is inside.
  template <int D>
  bool isNodeInside(const Index<D>& node) const {
    return nodesOfCells().contains(node) && (!boxes_ || boxes_->isNode(wide(node)));
  }
  /// Number of cells that are inside.
  std::uint64_t cellsInside() const { return boxes_ ? boxes_->size() : cells_.size(); }
  /// All nodes, including those outside the grid.
  Box nodes() const;
  /// The nodes of the grid's cells.
  Box nodesOfCells() const { return cells_.nodes(dimension()); }
  /// The part of a box of cells that lies on the grid or, along periodic axes, on its periodic images.
  Box clipCells(const Box& cells) const { return clip(cells, cells_); }
  Box clipNodes(const Box& nodes) const { return clip(nodes, this->nodes()); }
  /// The description of the grid in the scene, with the cells of this level.
  const Domain& domain() const { return domain_; }

  /// Cell width along a kernel axis [m].
  double spacing(int kernelAxis) const { return spacing_[kernelAxis]; }
  /// Inverse cell width [1/m], which lets kernels convert metres to cells without a division.
  double inverseSpacing(int kernelAxis) const { return inverse_spacing_[kernelAxis]; }
  /// Cell width along an axis of the scene [m]; 0 if the grid has no extent along it.
  double cellWidth(int axis) const { return (domain_.upper[axis] - domain_.lower[axis]) / domain_.resolution[axis]; }
  /// The smallest cell width over all axes [m].
  double minSpacing() const;
  /// Volume of a cell [m³]; an axis without extent counts as 1 m.
  double cellVolume() const { return cellVolume_; }
  /// The ratio of the volume of a cell to that of a cell of the coarsest level, a power of two.
  double weight() const { return std::ldexp(1.0, -number_ * dimension()); }
  /// Position of a node along a kernel axis [m].
  double nodePosition(int kernelAxis, int node) const { return lower_[kernelAxis] + node * spacing(kernelAxis); }

  /// The centre of a cell [m].
  template <int D>
  Vec<D> cellCentre(const Index<D>& cell) const {
    Vec<D> centre;
    for (int d = 0; d < D; ++d) centre[d] = 0.5 * (nodePosition(d, cell[d]) + nodePosition(d, cell[d] + 1));
    return centre;
  }

  /// The index of the cell that contains coordinate x along a kernel axis: the c with nodePosition(c) <= x <
  /// nodePosition(c+1). The upper end of the grid belongs to the last cell. Outside the grid, returns -1 or the number
  /// of cells.
  int cellAlong(int kernelAxis, double x) const;
  template <int D>
  Index<D> cellOf(const Vec<D>& x) const {
    Index<D> cell;
    for (int d = 0; d < D; ++d) cell[d] = cellAlong(d, x[d]);
    return cell;
  }

  /// The cells of the grid near a box in space [m]: at least all cells that it touches.
  Box cellsNear(const Vec3& lower, const Vec3& upper) const;
  /// The axes that the grid does not use, as text such as `y, z`; empty if it uses all.
  std::string axesLeftOut() const;
  /// The periodic images of the grid that contain cells of a box, as shifts in cells: cell c + shift is an image of c.
  /// The zero shift is among them if the box contains cells of the grid itself.
  std::vector<Index3> imagesOverlapping(const Box& cells) const;
  /// The cell of the grid of which a given cell is a periodic image.
  template <int D>
  Index<D> wrapped(Index<D> cell) const {
    for (int d = 0; d < std::min(D, dimension()); ++d) {
      const int count = cells_.extent(d);
      if (isPeriodic(d)) cell[d] = (cell[d] % count + count) % count;
    }
    return cell;
  }
  /// Index of a cell in lexicographic order, x fastest, starting at 0; independent of the patches. If there are finer
  /// levels, returns the index of the first of the finest cells in this cell.
  template <int D>
  std::uint64_t cellNumber(const Index<D>& cell) const {
    std::uint64_t number = 0;
    for (int d = D - 1; d >= 0; --d)
      number = (number * static_cast<std::uint64_t>(cells_.extent(d)) << halvings_) +
               (static_cast<std::uint64_t>(cell[d]) << halvings_);
    return number;
  }

  /// The components of a scene's vector along the kernel axes.
  template <int D>
  Vec<D> reduce(const Vec3& v) const {
    Vec<D> reduced;
    for (int d = 0; d < D; ++d) reduced[d] = v[axis(d)];
    return reduced;
  }
  /// Converts a direction from kernel axes to x, y, z: zero along the unused axes.
  template <int D>
  Vec3 expandDirection(const Vec<D>& v) const {
    Vec3 full = Vec3::Zero();
    for (int d = 0; d < D; ++d) full[axis(d)] = v[d];
    return full;
  }
  /// Converts a point from kernel axes to x, y, z: the middle of the domain along the unused axes.
  template <int D>
  Vec3 expandPoint(const Vec<D>& x) const {
    Vec3 full = 0.5 * (domain_.lower + domain_.upper);
    for (int d = 0; d < D; ++d) full[axis(d)] = x[d];
    return full;
  }

  /// The condition that the scene gives for a variable of a material on a part of a side of the grid, or on the rest of
  /// the side; none if the scene gives none. `side` 0: lower, 1: upper.
  template <class T>
  std::optional<BoundaryValue<T>> boundary(int kernelAxis, int side, const BoundaryLabel<T>& variable, int material = 0,
                                           int part = restOfSide) const {
    const BoundaryCondition* found = condition(kernelAxis, side, variable, material, part);
    return found ? std::optional(BoundaryValue<T>::of(*found)) : std::nullopt;
  }
  /// Looks up the conditions for a variable on all sides, for kernels that visit the cells of a patch.
  template <class T>
  BoundarySides<T> sides(const BoundaryLabel<T>& variable, int material = 0) const;
  /// The parts of a side that have their own conditions.
  const std::vector<ConditionsOfPart>& parts(int kernelAxis, int side) const {
    return domain_.boundaries.parts[2 * axis(kernelAxis) + side];
  }
  /// The index of the part of a side that contains the centre of a cell's face; restOfSide if none does. The distance
  /// of the cell from the side does not matter. A cell beyond the grid counts as the nearest one, or as its image.
  template <int D>
  int partAt(int kernelAxis, int side, const Index<D>& cell) const {
    return parts(kernelAxis, side).empty() ? restOfSide
                                           : partOf(kernelAxis, side, middleOfSide<D>(kernelAxis, side, cell));
  }
  /// The centre of a cell's face, projected onto a side of the grid [m].
  template <int D>
  Vec3 middleOfSide(int kernelAxis, int side, const Index<D>& cell) const {
    Index<D> nearest = wrapped<D>(cell);
    for (int d = 0; d < std::min(D, dimension()); ++d) nearest[d] = std::clamp(nearest[d], 0, cells_.upper[d] - 1);
    Vec<D> middle = cellCentre<D>(nearest);
    middle[kernelAxis] = nodePosition(kernelAxis, side == 0 ? 0 : cells_.upper[kernelAxis]);
    return expandPoint<D>(middle);
  }
  bool isPeriodic(int kernelAxis) const { return domain_.periodic[axis(kernelAxis)] != 0; }
  bool isPeriodic() const { return is_periodic_; }
  /// The period along a kernel axis [m].
  double period(int kernelAxis) const {
    return nodePosition(kernelAxis, cells_.upper[kernelAxis]) - nodePosition(kernelAxis, 0);
  }
  bool isSymmetry(int kernelAxis, int side, int material = 0, int part = restOfSide) const {
    return condition(kernelAxis, side, symmetric, material, part) != nullptr;
  }

 private:
  const BoundaryCondition* condition(int kernelAxis, int side, const BoundaryVariable& variable, int material,
                                     int part) const;
  int partOf(int kernelAxis, int side, const Vec3& x) const;
  template <int D>
  static Index3 wide(const Index<D>& index) {
    Index3 wide;
    for (int d = 0; d < D; ++d) wide[d] = index[d];
    return wide;
  }
  void chooseAxes();
  Box clip(const Box& box, const Box& grid) const;
  void measure();
  void takeBoxes();

  int number_ = 0, halvings_ = 0;  ///< index of this level, and the number of halvings from here to the finest level
  const Grid* grid_ = nullptr;
  Domain domain_;
  std::vector<int> axes_;
  std::array<double, 3> lower_{}, spacing_{}, inverse_spacing_{};
  double cellVolume_ = 1;
  bool is_periodic_ = false;
  Box cells_;
  std::unique_ptr<const SeveralBoxes> boxes_;
};

/// The conditions for one variable at both sides of each kernel axis, looked up once; see Level::sides.
template <class T>
class BoundarySides {
 public:
  BoundarySides(const Level& level, const BoundaryLabel<T>& variable, int material) : level_(&level) {
    for (int d = 0; d < level.dimension(); ++d)
      for (const int side : {0, 1}) {
        Side& at = sides_[numberOf(d, side)];
        at.rest = level.boundary(d, side, variable, material);
        for (int part = 0; part < std::ssize(level.parts(d, side)); ++part)
          at.parts.push_back(level.boundary(d, side, variable, material, part));
      }
  }

  /// The condition on the rest of a side, outside its parts.
  const std::optional<BoundaryValue<T>>& operator()(int kernelAxis, int side) const {
    return sides_[numberOf(kernelAxis, side)].rest;
  }
  /// The condition on a cell's face that lies on a side of the grid.
  template <int D>
  const std::optional<BoundaryValue<T>>& operator()(int kernelAxis, int side, const Index<D>& cell) const {
    const Side& at = sides_[numberOf(kernelAxis, side)];
    const int part = at.parts.empty() ? restOfSide : level_->partAt<D>(kernelAxis, side, cell);
    return part == restOfSide ? at.rest : at.parts[part];
  }

 private:
  struct Side {
    std::optional<BoundaryValue<T>> rest;
    std::vector<std::optional<BoundaryValue<T>>> parts;
  };
  static int numberOf(int kernelAxis, int side) { return 2 * kernelAxis + side; }

  const Level* level_;
  std::array<Side, 6> sides_;
};

template <class T>
BoundarySides<T> Level::sides(const BoundaryLabel<T>& variable, int material) const {
  return {*this, variable, material};
}

}  // namespace tushar::grid
