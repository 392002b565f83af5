#pragma once

#include <array>
#include <vector>

#include "core/grid/morton_curve.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// Cuts a grid of one level so that the particles of a small body in a large grid are shared by all threads and ranks.
///
/// The work of a patch is taken as its number of particles, plus its number of cells if any variables of cells outlive
/// a step. Where the largest patch has more than its share, cuts are moved to where they divide the work along each
/// axis evenly. Results do not depend on cuts. All ranks make the same calls.
class PatchCutter {
 public:
  explicit PatchCutter(RunState& run) : run_(run) {}

  /// Cuts the grid before the first step.
  void cutAtStart();
  /// Cuts it after a step, if it is time to look.
  void cutIfDue();

  /// How often the grid was cut.
  int times() const { return times_; }

 private:
  using Cuts = grid::MortonCurve::Cuts;

  /// Whether cuts may move: not if `--layout` gives them, not if values of nodes outlive a step, and not if a global
  /// solve would round differently.
  bool mayCut() const;
  /// Threads of all ranks that pay off for the cells of the grid, if there are enough patches.
  int workers() const;
  /// Work of a cell without particles.
  double workOfCell() const;
  /// Calls `visit(cell, work)` for the cells of a patch that take any time.
  template <class Visit>
  void forEachWork(const grid::Patch& patch, double ofCell, Visit&& visit) const;
  /// The work in each plane of cells, along each axis.
  std::array<std::vector<double>, 3> workAlongAxes(double ofCell) const;
  /// Work of the largest patch, as a multiple of the share of a worker; and the same with other cuts.
  double load(double ofCell) const;
  double load(double ofCell, const Cuts& cuts) const;
  double loadOf(std::vector<double>& ofPatches) const;
  /// Cuts the grid if the largest patch has too much work and other cuts make it smaller.
  void cut();

  static constexpr int soonest = 16, soonestOfRanks = 64;  ///< steps between two looks at the work of patches
  static constexpr int mostPatience = 64;

  RunState& run_;
  bool may_cut_ = false;
  int steps_ = 0, times_ = 0;
  int waited_ = 0, patience_ = 1;  ///< looks that found a patch too large since other cuts were tried, and until then
};

}  // namespace tushar::simulation
