#pragma once

#include <array>
#include <vector>

#include "core/grid/morton_curve.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// Cuts a grid of one level so that the particles of a small body in a large grid are shared by all threads and ranks.
///
/// The work of a patch is estimated as its number of particles, plus its number of cells if any cell variables outlive
/// a step. If the largest patch has more than its share, the cuts are moved so that they divide the work along each
/// axis evenly. Results do not depend on the cuts. All ranks make the same calls.
class PatchCutter {
 public:
  explicit PatchCutter(RunState& run) : run_(run) {}

  /// Cuts the grid before the first step.
  void cutAtStart();
  /// Cuts the grid after a step, if a check is due and other cuts pay off.
  void cutIfDue();

  /// How often the grid was cut.
  int times() const { return times_; }

 private:
  using Cuts = grid::MortonCurve::Cuts;

  /// Whether cuts may move: not if `--layout` specifies them, not if node variables outlive a step, and not if there is
  /// a global solve, whose round-off would change.
  bool mayCut() const;
  /// Total number of threads, on all ranks, that pay off for the cells of the grid if there are enough patches.
  int workers() const;
  /// Work of a cell without particles.
  double workOfCell() const;
  /// Calls `visit(cell, work)` for the cells of a patch that have any work, possibly several times per cell.
  template <class Visit>
  void forEachWork(const grid::Patch& patch, double ofCell, Visit&& visit) const;
  /// The work in each plane of cells, along each axis.
  std::array<std::vector<double>, 3> workAlongAxes(double ofCell) const;
  /// The ratio of the largest patch's work to the mean work per worker; also for other cuts.
  double load(double ofCell) const;
  double load(double ofCell, const Cuts& cuts) const;
  double loadOf(std::vector<double>& ofPatches) const;
  /// Moves the cuts if the largest patch has too much work and other cuts would reduce it.
  void cut();

  static constexpr int soonest = 16,
                       soonestOfRanks = 64;  ///< number of steps between two checks of the work of patches
  static constexpr int mostPatience = 64;

  RunState& run_;
  bool may_cut_ = false;
  int steps_ = 0, times_ = 0;
  int waited_ = 0,
      patience_ = 1;  ///< checks since the last attempt that found too large a patch, and how many lead to the next one
};

}  // namespace tushar::simulation
