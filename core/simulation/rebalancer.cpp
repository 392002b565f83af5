#include "core/simulation/rebalancer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/trace.hpp"

namespace tushar::simulation {

void Rebalancer::balanceAtStart() {
  if (run_.ranks.isAlone()) return;
  std::vector<double> costs;
  for (const grid::Patch& patch : run_.problem.grid->patches()) {
    int particles = 0;
    for (int material = 0; material < run_.materials(); ++material)
      particles += run_.warehouse.particles(data::Generation::old, material, patch.id()).owned();
    costs.push_back(Balance::costOf(patch.cells().size(), particles));
  }
  balance(costs);
}

void Rebalancer::balanceIfDue() {
  if (balance_.isDue()) balance(run_.scheduler.takeCosts());
}

void Rebalancer::balance(const std::vector<double>& costs) {
  grid::Grid& grid = *run_.problem.grid;
  std::vector<double> all(grid.patchCount());
  std::copy(costs.begin(), costs.end(), all.begin() + grid.firstPatch());
  run_.ranks.max(all);
  const auto offsets = balance_.better(all, grid.rankOffsets(), run_.time.step());
  if (!offsets) return;
  const auto started = Clock::now();
  const trace::Span span(trace::Kind::message, "give patches to other ranks");
  tasks::migratePatches(grid, run_.warehouse, run_.migratedVariables(), *offsets);
  run_.scheduler.forgetLayout();
  balance_.noteChange(run_.ranks.max(secondsSince(started)));
  const Rebalancing& change = balance_.report();
  run_.progress.line(
      fmt::format("step {:>6}  patches change ranks: the load of the busiest rank changes from {:.2f} to {:.2f} times "
                  "the mean load",
                  run_.time.step(), change.before, change.after));
}

}  // namespace tushar::simulation
