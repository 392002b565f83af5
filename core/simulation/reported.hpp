#pragma once

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

/// What a number of the report amounts to so far. It is unknown if the run continues from a checkpoint that does not
/// contain it, and in runs in which finer levels take smaller steps.
struct ReportedSoFar {
  bool isKnown = true;
  std::vector<double> value;  ///< the components; empty before the first step

  /// Takes account of the values of the reduction after a step of length `dt` [s].
  void addStep(Reported::Over over, const std::vector<double>& values, double dt);
};

}  // namespace tushar::simulation
