#pragma once

#include <vector>

#include "core/simulation/balance.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// Moves the patches of a run to other ranks when Balance decides so. All ranks make the same calls.
class Rebalancer {
 public:
  explicit Rebalancer(RunState& run) : run_(run), balance_(run.ranks.size()) {}

  /// Balances according to the number of cells and particles of each patch, before the first step.
  void balanceAtStart();
  /// Balances according to the time that tasks have taken on each patch, after a step.
  void balanceIfDue();

  const Rebalancing& report() const { return balance_.report(); }

 private:
  /// `costs` are the costs of this rank's patches.
  void balance(const std::vector<double>& costs);

  RunState& run_;
  Balance balance_;
};

}  // namespace tushar::simulation
