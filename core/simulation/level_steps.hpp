#pragma once

#include <optional>
#include <vector>

#include "core/simulation/run_state.hpp"
#include "core/tasks/kept_levels.hpp"

namespace tushar::simulation {

/// Performs the steps of a run in which finer levels take smaller steps.
///
/// A level makes its step from the old state. Then the next finer level makes steps up to the same time: two in
/// general, one if that is stable, three or more if signals have become faster in the meantime. Its ghosts in coarser
/// cells are interpolated between the old and the new values of these cells. Then the flux out of coarse cells is
/// replaced by the sum of the finer steps' fluxes, and the new state of the coarser level becomes its old one. After
/// each step of the coarsest level, all levels are at the same time. Source: M. J. Berger and P. Colella, J. Comput.
/// Phys. 82 (1989) 64; the number of finer steps is our own choice.
///
/// All ranks make the same calls.
class LevelSteps {
 public:
  explicit LevelSteps(RunState& run) : run_(run) {}

  /// The longest step of the coarsest level [s] such that each finer level is stable with two steps per step of the
  /// next coarser level, and the limit that determines this step.
  data::Minimum stable();
  /// Advances the old state of all levels by the step of the coarsest level, `whole.delT`, and finds the stable step of
  /// each level for the new state. If a task requests a smaller step, returns its factor and reason; in this case, and
  /// if a NumericalError is thrown, the old state is restored.
  std::optional<data::Minimum> advance(const tasks::StepInfo& whole);

  /// Number of steps of each level in the latest step of the coarsest level; 0 for levels without cells.
  const std::vector<int>& steps() const { return steps_; }

 private:
  /// Restores the old state of all levels. That of the coarsest level is where its new state was.
  void undo(const tasks::KeptLevels& before);
  /// Makes a step of a level, and the steps of finer levels within it.
  std::optional<data::Minimum> advanceLevel(const tasks::StepInfo& at);
  std::optional<data::Minimum> advanceFiner(const tasks::StepInfo& coarser);
  /// Computes the stable step for the state of a level, unless it is already known.
  std::optional<data::Minimum> findStable(const tasks::StepInfo& at);
  std::optional<data::Minimum> findStableOfAll(tasks::StepInfo at);
  /// The longest step of a level [s] with the scene's multiplier. Throws NumericalError if it is far shorter than
  /// `rest` [s], the remaining time of the coarser step.
  double longestStep(double rest, const tasks::StepInfo& next) const;
  int levelsWithCells() const;
  int number(const data::Label& label) { return run_.table.number(label, -1); }

  RunState& run_;
  std::optional<grid::BlockTree> tree_;               ///< tree of blocks for which `stable_` was computed
  int levels_ = 1;                                    ///< number of levels that have cells
  std::vector<std::optional<data::Minimum>> stable_;  ///< stable step of each level [s] for its current state, if known
  std::vector<int> steps_;
};

/// The number of equal steps that fill `rest` [s], the remaining time of a coarser step, if `stable` [s] is the longest
/// stable step. Steps may be up to an eighth longer than `stable`, because signals may have become faster since the
/// coarser step was chosen. If `isFirst`, the rest is the whole coarser step; a single step that fills it must not be
/// longer than `stable`.
int stepsThatFill(double rest, double stable, bool isFirst);

}  // namespace tushar::simulation
