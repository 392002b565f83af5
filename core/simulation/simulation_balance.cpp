#include <fmt/format.h>

#include "core/simulation/simulation.hpp"
#include "core/tasks/patch_migration.hpp"

// How patches change ranks in a run.

namespace tushar::simulation {

void Simulation::balanceAtStart() {
  if (ranks_->isAlone()) return;
  std::vector<double> costs;
  for (const grid::Patch& patch : problem_.level->patches()) {
    int particles = 0;
    for (int material = 0; material < static_cast<int>(phases_.materials().size()); ++material)
      particles += warehouse_.particles(data::Generation::old, material, patch.id()).owned();
    costs.push_back(Balance::costOf(patch.cells().size(), particles));
  }
  balance(costs);
}

void Simulation::balanceIfDue() {
  if (balance_.isDue()) balance(scheduler_.takeCosts());
}

/// `costs`: of the patches of this rank.
void Simulation::balance(const std::vector<double>& costs) {
  grid::Level& level = *problem_.level;
  std::vector<double> all(static_cast<std::size_t>(level.patchCount()));
  std::copy(costs.begin(), costs.end(), all.begin() + level.firstPatch());
  ranks_->max(all);
  const auto offsets = balance_.better(all, level.rankOffsets(), time_.step());
  if (!offsets) return;
  const auto started = Clock::now();
  const trace::Span span(trace::Kind::message, "give patches to other ranks");
  tasks::migratePatches(level, warehouse_, migratedVariables(), *offsets);
  scheduler_.forgetLayout();
  balance_.noteChange(ranks_->max(since(started)));
  const Rebalancing& change = balance_.report();
  progress_.line(
      fmt::format("step {:>6}  patches change ranks: the busiest had {:.2f} times its share, and has {:.2f} now",
                  time_.step(), change.before, change.after));
}

tasks::MigratedVariables Simulation::migratedVariables() const {
  tasks::MigratedVariables migrated{static_cast<int>(phases_.materials().size()), {}};
  for (const std::string& name : phases_.lasting())
    for (int material = -1; material < migrated.materials; ++material)
      if (const int number = table_.find(name, material);
          number >= 0 && table_[number].label->centring != data::Centring::reduction)
        migrated.variables.push_back(number);
  return migrated;
}

}  // namespace tushar::simulation
