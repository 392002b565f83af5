#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/collect/gather.hpp"
#include "core/collect/summary.hpp"
#include "core/output/snapshot.hpp"
#include "core/report/measured.hpp"
#include "core/simulation/settings.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::simulation {

using report::EnergyTerm;
using report::MeasuredError;

/// A variable of cells or nodes that a module looks at, of one material or of none. The scene puts the names in place
/// that variable and material have here.
struct SampledVariable {
  SaveRequest request;
  std::string called;  ///< its name in the scene
  int material = 0;    ///< the number of the material in the scene
};

/// A `DataAnalysis/Module`: it looks at the state of a run through diagnostic tasks.
class Analysis {
 public:
  virtual ~Analysis() = default;
  /// Adds diagnostic tasks. They see the state as old.
  virtual void schedule(tasks::TaskList& tasks) const = 0;
  /// The state is now that of `time` [s], `sinceStart` [s] after that of the start. Called before the tasks run.
  virtual void setTime(double time, double sinceStart) = 0;
  /// What the tasks measure; they are run at the end of the run.
  virtual std::vector<MeasuredError> errors() const { return {}; }
  /// What comes and goes of the energy; the report sets it off.
  virtual std::vector<EnergyTerm> energies() const { return {}; }
  /// Why errors mean nothing at the time that is set, in a sentence; empty where they do.
  virtual std::string whyUnmeasured() const { return {}; }
  /// Variables that sample() wants to see, and where the scene asks for them.
  virtual std::vector<SaveRequest> samples() const { return {}; }
  /// The variables among samples() whose names the scene puts in place: as Uintah calls them, they come with another
  /// name, and those that nobody computes here are taken out. Null where there are none.
  virtual std::vector<SampledVariable>* variables() { return nullptr; }
  /// What Uintah calls the variables that the module itself computes, and their names here.
  virtual std::vector<std::pair<std::string, std::string>> otherNames() const { return {}; }
  /// The layers of the grid in which it wants to see them, without particles; where there are none: all.
  virtual std::vector<collect::Layer> layers() const { return {}; }
  /// The parts of a grid of one level in which it wants to see them, likewise.
  virtual std::vector<collect::Window> windows() const { return {}; }
  /// Whether it wants to see the least and the greatest of the values and their sum instead: a snapshot of each.
  virtual std::optional<collect::SummaryOver> summary() const { return {}; }
  /// Whether sample() is to be called after this step, at the time that is set.
  virtual bool isSampleDue(int /*step*/) const { return false; }
  /// Looks at what samples() asks for: in each of the layers() and windows(), as a summary(), or all. Files of its own
  /// go to the folder of the archive.
  virtual void sample(const std::vector<output::Snapshot>&, const std::filesystem::path&) {}
  /// Completes its files, so that a run that goes on from here finds in them what was sampled so far. Called on the
  /// first rank before each checkpoint is written, and at the end of the run. May throw FileError.
  virtual void flush() {}
  /// A table of exact values to draw beside the result, one column an array, `x` first; empty where there is none.
  virtual std::vector<output::Array> exactProfile(const grid::Level&) const { return {}; }
};

}  // namespace tushar::simulation
