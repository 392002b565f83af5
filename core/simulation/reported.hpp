#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/data/label.hpp"

namespace tushar::simulation {

/// A number of the whole run that the report shows. It follows from a reduction; it does not change the results.
struct Reported {
  /// How the number follows from the values of the reduction.
  enum class Over {
    end,   ///< the value at the end of the run, from scheduleDiagnostics
    sum,   ///< the sum over all steps, from scheduleTimeAdvance, like the following two
    time,  ///< the integral over time: the sum over all steps of the value times the time step
    least  ///< the least value of any step
  };
  std::string key;   ///< name in the JSON report
  std::string text;  ///< what it is, in a few words
  std::string unit;
  const data::Label* label;  ///< the reduction, which a task of this scene computes
  Over over;
  bool onlyIfSaved = false;  ///< for costly numbers: the report shows it only if the scene saves the reduction

  bool isOfSteps() const { return over != Over::end; }
};

/// The number of iterations of all linear solves of a run; `label` counts those of a step.
inline Reported iterationsOfRun(const data::Label& label) {
  return {"linear_iterations", "iterations of linear solves", "1", &label, Reported::Over::sum};
}

/// The numbers that the report shows if the given reductions are saved.
std::vector<Reported> shownOf(std::vector<Reported> all, const std::vector<std::string>& saved);
/// The names of the reductions of numbers over steps, or of those at the end of the run.
std::set<std::string, std::less<>> reductionsOf(const std::vector<Reported>& reported, bool ofSteps);

/// What a number of the report amounts to so far. It is unknown if the run continues from a checkpoint that does not
/// contain it, and in runs in which finer levels take smaller steps.
struct ReportedSoFar {
  int reduction = -1;  ///< index of the reduction; -1 if no task computes it
  bool isKnown = true;
  std::vector<double> value;  ///< the components; empty before the first step

  /// Takes account of the values of the reduction after a step of length `dt` [s].
  void addStep(Reported::Over over, const std::vector<double>& values, double dt);
};

}  // namespace tushar::simulation
