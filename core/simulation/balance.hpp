#pragma once

#include <optional>
#include <vector>

#include "core/grid/shares.hpp"
#include "core/report/report.hpp"

namespace tushar::simulation {

using report::Rebalancing;

/// Decides when patches move between ranks.
///
/// At the start the decision is based on cells and particles; later, on the measured time of tasks on each patch,
/// evaluated after 8, 16, 32 and then every 64 steps: patches move if another distribution would have saved more time
/// over the measured steps than the previous move took.
class Balance {
 public:
  explicit Balance(int ranks) : ranks_(ranks) {}

  /// The estimated cost of a patch at the start, in units of the cost of a cell.
  static double costOf(std::size_t cells, int particles) {
    return static_cast<double>(cells) + particleCost * particles;
  }

  /// Counts a step. Returns whether the costs are to be measured now.
  bool isDue() { return ranks_ > 1 && ++steps_ >= next_; }
  /// Returns a new distribution if it pays off: according to `costs`, which has an entry for each patch of the grid, it
  /// must reduce the load of the busiest rank by at least a tenth, and this must save more time than the change takes.
  std::optional<grid::RankOffsets> better(const std::vector<double>& costs, const grid::RankOffsets& now, int step);
  /// Records how long the change took on the slowest rank [s].
  void noteChange(double seconds) { change_ = seconds; }

  const Rebalancing& report() const { return report_; }

 private:
  static constexpr double particleCost = 1;  ///< cost of a particle, in units of the cost of a cell
  static constexpr int soonest = 8, latest = 64;

  int ranks_;
  int steps_ = 0, next_ = soonest;
  double change_ = 0;
  Rebalancing report_;
};

}  // namespace tushar::simulation
