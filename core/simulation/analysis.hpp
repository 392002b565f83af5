#pragma once

#include <filesystem>
#include <optional>
#include <string>
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

/// A cell or node variable that a module samples, of one material or of none. When the scene is read, Uintah's names of
/// the variable and the material are replaced by Tushar's.
struct SampledVariable {
  SaveRequest request;
  std::string called;  ///< name of the variable in the scene
  int material = 0;    ///< index of the material in the scene
};

/// A file or folder of the archive that a module writes.
struct OwnFile {
  /// Path in the archive; for files written at each output, the part of the path that does not change.
  std::string path;
  Location where;  ///< location of the tag that requires the file
};

/// A `DataAnalysis/Module`, which measures the state of a run with diagnostic tasks.
class Analysis {
 public:
  virtual ~Analysis() = default;
  /// Whether the module can run on a level of several boxes, in which cells and nodes outside the boxes hold nothing.
  virtual bool takesSeveralBoxes() const { return false; }
  /// Adds diagnostic tasks. They read the current state as the old one.
  virtual void schedule(tasks::TaskList& tasks) const = 0;
  /// Adds tasks that run after each step, with the state after the step as the old one, and that follow the
  /// diagnostics: they may read those as new. What they compute, variables of cells without a material, is kept until
  /// the next step, when they read it as old, and is part of checkpoints; at the start of a run it is 0. So sums over
  /// time are made.
  virtual void scheduleAfterStep(tasks::TaskList&) const {}
  /// Whether the tasks of scheduleAfterStep have something to do after a step that ends at this time [s].
  virtual bool isDueAfterStep(double /*time*/) const { return false; }
  /// Sets the time of the state [s] and the time since the start [s]. Called before the tasks run.
  virtual void setTime(double time, double sinceStart) = 0;
  /// The errors that the tasks measure at the end of the run.
  virtual std::vector<MeasuredError> errors() const { return {}; }
  /// The terms of the energy budget that this module computes; the report adds them up.
  virtual std::vector<EnergyTerm> energies() const { return {}; }
  /// The reason why errors are not valid at the current time; empty if they are valid.
  virtual std::string whyUnmeasured() const { return {}; }
  /// Variables that sample() needs, and their locations in the scene.
  virtual std::vector<SaveRequest> samples() const { return {}; }
  /// Those of samples() whose names may be Uintah's. When the scene is read, these names are replaced by
  /// Tushar's, and variables that no task computes are removed from the list. Null if there is no such list.
  virtual std::vector<SampledVariable>* variables() { return nullptr; }
  /// Pairs of names, Uintah's and Tushar's, for variables of this module that have another name in Uintah.
  virtual OtherNames otherNames() const { return {}; }
  /// The layers of the grid in which sample() needs the variables, without particles; if empty, it needs the whole
  /// grid.
  virtual std::vector<collect::Layer> layers() const { return {}; }
  /// The windows of the grid in which sample() needs the variables; if empty, it needs the whole grid.
  virtual std::vector<collect::Window> windows() const { return {}; }
  /// If given, sample() receives minima, maxima and sums over these parts of the grid instead of values.
  virtual std::optional<collect::SummaryOver> summary() const { return {}; }
  /// Whether sample() is to be called after this step, at the current time.
  virtual bool isSampleDue(int /*step*/) const { return false; }
  /// Processes the variables of samples(): their values in the layers(), in the windows() or on the whole grid, or
  /// their summary(). Writes the module's own files to the given folder of the archive.
  virtual void sample(const std::vector<output::Snapshot>&, const std::filesystem::path&) {}
  /// The files that sample() writes. Each belongs to one module. Called once the names of variables() are settled.
  virtual std::vector<OwnFile> files() const { return {}; }
  /// Completes the files, so that a run that continues from this point finds all samples so far. Called on the first
  /// rank before each checkpoint is written, and at the end of the run. May throw FileError.
  virtual void flush() {}
  /// A table of exact values to plot with the result, one array per column, `x` first; empty if there is none.
  virtual std::vector<output::Array> exactProfile(const grid::Level&) const { return {}; }
};

}  // namespace tushar::simulation
