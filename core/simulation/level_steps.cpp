#include "core/simulation/level_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/tasks/reflux.hpp"

namespace tushar::simulation {

int stepsThatFill(double rest, double stable, bool isFirst) {
  constexpr double band = 1.125, rounding = 1e-9;
  const double exact = rest / stable;
  const double fewest = std::ceil(exact / band - rounding);
  return static_cast<int>(std::max({1.0, fewest, isFirst ? std::min(2.0, std::ceil(exact - rounding)) : 1.0}));
}

int LevelSteps::levelsWithCells() const {
  const grid::Grid& grid = *run_.problem.grid;
  int levels = 1;
  for (const grid::BlockId& leaf : grid.tree().leaves()) levels = std::max(levels, leaf.level + 1);
  return levels;
}

data::Minimum LevelSteps::stable() {
  const grid::BlockTree& tree = run_.problem.grid->tree();
  if (tree_ != tree) {
    tree_ = tree;
    levels_ = levelsWithCells();
    stable_.assign(static_cast<std::size_t>(levels_), std::nullopt);
  }
  findStableOfAll({.step = run_.time.step() + 1, .time = run_.time.time()});
  data::Minimum least;
  for (int level = 0; level < levels_; ++level) {
    data::Minimum ofLevel = *stable_[static_cast<std::size_t>(level)];
    ofLevel.value = std::ldexp(ofLevel.value, level);
    least.merge(ofLevel);
  }
  return least;
}

std::optional<data::Minimum> LevelSteps::findStable(const tasks::StepInfo& at) {
  std::optional<data::Minimum>& known = stable_[static_cast<std::size_t>(at.level)];
  if (known) return std::nullopt;
  run_.warehouse.resetReduction(run_.delT);
  if (auto asked = run_.scheduler.run(run_.phases.stableTimeStep, at)) return asked;
  known = run_.warehouse.reduction<data::Minimum>(run_.delT);
  return std::nullopt;
}

std::optional<data::Minimum> LevelSteps::findStableOfAll(tasks::StepInfo at) {
  for (at.level = 0; at.level < levels_; ++at.level)
    if (auto asked = findStable(at)) return asked;
  return std::nullopt;
}

std::optional<data::Minimum> LevelSteps::advance(const tasks::StepInfo& whole) {
  const tasks::TaskGraph& graph = run_.phases.timeAdvance;
  const tasks::KeptLevels before(run_.warehouse, graph.results());
  const auto stableBefore = stable_;
  steps_.assign(static_cast<std::size_t>(run_.problem.grid->levels()), 0);
  tasks::StepInfo coarsest = whole;
  coarsest.level = 0;
  std::optional<data::Minimum> asked;
  try {
    asked = advanceLevel(coarsest);
    coarsest.time += whole.delT;
    if (!asked) asked = findStableOfAll(coarsest);  // what leaves no stable step is repeated, or refused, with its step
  } catch (const NumericalError&) {
    undo(before);
    stable_ = stableBefore;
    throw;
  }
  if (asked) {
    undo(before);
    stable_ = stableBefore;
  }
  run_.scheduler.forgetNew(graph);
  run_.warehouse.reduction<data::Minimum>(run_.delT).value = whole.delT;
  return asked;
}

void LevelSteps::undo(const tasks::KeptLevels& before) {
  if (steps_.front() > 0) run_.scheduler.exchangeLevel(run_.phases.timeAdvance, 0);
  before.restore();
}

std::optional<data::Minimum> LevelSteps::advanceLevel(const tasks::StepInfo& at) {
  run_.warehouse.reduction<data::Minimum>(run_.delT).value = at.delT;
  run_.warehouse.reduction<data::Minimum>(number(tasks::partOfStep)).value = at.part;
  if (auto asked = run_.scheduler.run(run_.phases.timeAdvance, at)) return asked;
  if (at.level + 1 < levels_) {
    if (auto asked = advanceFiner(at)) return asked;
    if (auto asked = run_.scheduler.run(run_.phases.refluxing, at)) return asked;
  }
  if (at.level == 0)
    run_.scheduler.exchangeLevel(run_.phases.timeAdvance, 0);  // so that it can be undone
  else
    run_.scheduler.commitLevel(run_.phases.timeAdvance, at.level);
  stable_[static_cast<std::size_t>(at.level)].reset();
  ++steps_[static_cast<std::size_t>(at.level)];
  return std::nullopt;
}

std::optional<data::Minimum> LevelSteps::advanceFiner(const tasks::StepInfo& coarser) {
  tasks::StepInfo at = coarser;
  ++at.level;
  for (double done = 0; done < coarser.delT; done += at.delT) {
    const double rest = coarser.delT - done;
    at.time = coarser.time + done;
    at.part = done / coarser.delT;
    if (auto asked = findStable(at)) return asked;
    const int steps = stepsThatFill(rest, longestStep(rest, at), at.part == 0);
    at.delT = rest / steps;
    if (auto asked = advanceLevel(at)) return asked;
    if (steps == 1) break;
  }
  return std::nullopt;
}

double LevelSteps::longestStep(double rest, const tasks::StepInfo& next) const {
  constexpr double most = 1000;  // steps in one of the coarser level: signals do not get so much faster
  const double stable = run_.problem.time.timestepMultiplier * stable_[static_cast<std::size_t>(next.level)]->value;
  if (!(stable * most > rest))
    throw NumericalError(fmt::format("the time step of level {} fell to {:.6g} s, while {:.6g} s of the next coarser "
                                     "level's step remain (step {}, time {:.6g} s)",
                                     next.level, stable, rest, next.step, next.time),
                         "a setting that keeps speeds finite, or useLockStep true in <AMR>");
  return stable;
}

}  // namespace tushar::simulation
