#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/lanes.hpp"
#include "core/data/particle_set.hpp"
#include "core/grid/level.hpp"

namespace tushar::tasks {

/// The bounds of one cell of a patch after the other, and of its neighbours on the grid.
template <int D>
class CellBounds {
 public:
  /// `nodes` contains nodesAround(level, cells).
  CellBounds(const grid::Level& level, const grid::Box& cells, const std::vector<double>& nodes)
      : level_(&level), nodes_(nodes.data() + 1), first_(cells.lower[0]) {}

  /// The positions of the nodes of rows of cells along the first axis, and of one more node on either side.
  static std::vector<double> nodesAround(const grid::Level& level, const grid::Box& cells) {
    std::vector<double> nodes;
    for (int node = cells.lower[0] - 1; node <= cells.upper[0] + 1; ++node) nodes.push_back(position(level, 0, node));
    return nodes;
  }

  /// Chooses the row of a cell.
  void chooseRow(const Index<D>& cell) {
    for (int d = 1; d < D; ++d) {
      below_[d] = position(*level_, d, cell[d] - 1);
      lower_[d] = position(*level_, d, cell[d]);
      upper_[d] = position(*level_, d, cell[d] + 1);
      above_[d] = position(*level_, d, cell[d] + 2);
    }
  }
  /// Chooses a cell of the row, by its index along the first axis.
  void choose(int cell) {
    const double* nodes = nodesOf(cell);
    below_[0] = nodes[-1];
    lower_[0] = nodes[0];
    upper_[0] = nodes[1];
    above_[0] = nodes[2];
  }

  /// Whether a position lies in the chosen cell or in one of its neighbours on the grid; if so, `step` becomes the way
  /// to it.
  bool isNear(const Vec<D>& x, Index<D>& step) const {
    bool isNear = true;
    for (int d = 0; d < D; ++d) {
      step[d] = int{x[d] >= upper_[d]} - int{x[d] < lower_[d]};
      isNear &= (x[d] >= below_[d]) & (x[d] < above_[d]);
    }
    return isNear;
  }
  /// Whether all of `count` consecutive positions lie in the chosen cell; `x` has `known` positions from there on.
  bool areInside(const Vec<D>* x, int count, int known) const {
    for (; count > 0 && known >= Lanes::count; x += Lanes::count, count -= Lanes::count, known -= Lanes::count) {
      const std::array<Lanes, D> at = tushar::unpack<D>(x->data());
      const Lanes::Mask inside = inRow(at) & (at[0] >= lower_[0]) & (at[0] < upper_[0]);
      if (!tushar::all(inside | (Lanes::of([](int lane) { return lane + 0.5; }) > count))) return false;
    }
    bool inside = true;
    for (int k = 0; inside && k < count; ++k)
      for (int d = 0; d < D; ++d) inside &= (x[k][d] >= lower_[d]) & (x[k][d] < upper_[d]);
    return inside;
  }
  /// Whether the particles of as many cells of the row as there are lanes, from `cell` on, move together: there is one
  /// in each cell, with consecutive indices, and all lie in their cells, or all in the same neighbours of these on the
  /// grid. If so, `step` becomes the way to these. `ranges` are the particles of the cells.
  bool moveTogether(int cell, const data::ParticleRange* ranges, const Vec<D>* x, Index<D>& step) const {
    const int first = ranges[0].first;
    for (int k = 0; k < Lanes::count; ++k)
      if (ranges[k].first != first + k || ranges[k].last != first + k + 1) return false;
    const double* nodes = nodesOf(cell);
    const std::array<Lanes, D> at = tushar::unpack<D>(x[first].data());
    bool together =
        findStep(at[0], Lanes::at(nodes - 1), Lanes::at(nodes), Lanes::at(nodes + 1), Lanes::at(nodes + 2), step[0]);
    for (int d = 1; d < D && together; ++d)
      together = findStep(at[static_cast<std::size_t>(d)], below_[d], lower_[d], upper_[d], above_[d], step[d]);
    return together;
  }

 private:
  /// The position of a node or, beyond a side of the grid, of the last one before it.
  static double position(const grid::Level& level, int d, int node) {
    return level.nodePosition(d, std::clamp(node, 0, level.cells().upper[d]));
  }
  /// Finds the interval in which all positions lie, from the one below the middle one to that above; whether there is
  /// one.
  static bool findStep(const Lanes& x, const Lanes& below, const Lanes& lower, const Lanes& upper, const Lanes& above,
                       int& step) {
    step = tushar::all(x >= upper) ? 1 : tushar::all(x < lower) ? -1 : 0;
    const Lanes from = step == 0 ? lower : step > 0 ? upper : below, to = step == 0 ? upper : step > 0 ? above : lower;
    return tushar::all((x >= from) & (x < to));
  }
  const double* nodesOf(int cell) const { return nodes_ + (cell - first_); }
  /// Which positions lie in the row, along the axes but the first.
  Lanes::Mask inRow(const std::array<Lanes, D>& at) const {
    Lanes::Mask inside = at[0] >= at[0];
    for (int d = 1; d < D; ++d) inside &= (at[d] >= lower_[d]) & (at[d] < upper_[d]);
    return inside;
  }

  const grid::Level* level_;
  const double* nodes_;                   ///< positions along the first axis
  int first_;                             ///< index of the first cell of each row
  Vec<D> below_, lower_, upper_, above_;  ///< bounds of the neighbour below, of the cell, and of the neighbour above
};

}  // namespace tushar::tasks
