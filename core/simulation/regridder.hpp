#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "core/grid/block_tree.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// The blocks that marked cells require: blocks that must be refined, and blocks whose children must be preserved. Both
/// follow from the tree and the marks alone.
class MarkedBlocks {
 public:
  /// A mark applies to all blocks within the distance that signals travel in `interval` steps (one cell of the finest
  /// level per step) plus `dilation` cells.
  MarkedBlocks(const grid::Grid& grid, int interval, int dilation)
      : grid_(grid), interval_(std::min(interval, farthest)), dilation_(std::min(dilation, farthest)) {}

  /// Adds the mark of a cell; see refinementMark.
  void add(const grid::Level& level, const Index3& cell, int mark);
  /// Adds the marks of all cells of a patch.
  void add(const grid::Patch& patch, const int* marks, const grid::Box& stored);
  /// Adds a cell with particles: no coarser cells are allowed within the distance that the particles can travel plus
  /// `margin` cells of the finest level.
  void addParticles(const grid::Level& level, const Index3& cell, int margin);
  /// Merges the marks of all ranks. Collective.
  void unite(const mpi::Communicator& ranks);
  /// The tree that the marks require. Only refined blocks without refined children may be coarsened.
  grid::BlockTree tree() const;

 private:
  static constexpr int farthest = 1 << 28;  // cells: beyond any grid, and two of them are still a number

  /// Range of blocks along an axis: [lower, upper).
  using Range = std::pair<int, int>;

  /// Marks a block or, if it is a periodic image, its original.
  void ask(const grid::BlockId& image, int mark);
  grid::BlockId wrapped(grid::BlockId image) const;
  /// The blocks along an axis within a distance of a cell, on the grid or its periodic images.
  Range blocksAlong(const grid::Level& level, int axis, int cell, int distance) const;
  /// The blocks of a level within a distance of a cell of this level, on the grid or its periodic images.
  grid::Box blocksNear(const grid::Level& level, const Index3& cell, int distance) const;
  /// The number of cells of a level that signals can cross until the next regridding.
  int crossed(const grid::Level& level) const { return ((interval_ - 1) >> (grid_.levels() - 1 - level.number())) + 1; }

  const grid::Grid& grid_;
  int interval_, dilation_;
  std::set<std::array<int, 7>> near_particles_;  ///< level and corners of boxes of blocks near particles
  /// Blocks to refine, and blocks whose children to preserve; may contain duplicates.
  std::vector<grid::BlockId> wanted_, kept_;
};

/// Refines the grid of a run by its criteria. All ranks make the same calls.
class Regridder {
 public:
  explicit Regridder(RunState& run) : run_(run) {}

  /// Refines the grid for the initial state. Returns true if the grid has changed; it then has no values yet.
  bool refinedStart();
  /// Changes the grid between two steps and transfers the values, if this is due and the state requires it.
  void regridIfDue();

  int regrids() const { return regrids_; }
  double seconds() const { return seconds_; }

 private:
  /// Number of steps between regriddings; `finestStepsBetween`: the same period in steps of the finest level.
  int stepsBetween() const;
  int finestStepsBetween() const;
  grid::BlockTree wantedTree();
  void addMarks(MarkedBlocks& marked);
  void addParticles(MarkedBlocks& marked);
  void change(grid::BlockTree tree);

  RunState& run_;
  int starts_ = 0, regrids_ = 0;
  double seconds_ = 0;
};

}  // namespace tushar::simulation
