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

/// A cell or node variable that a module samples, of one material or of none. The scene replaces Uintah's names of
/// variable and material by those used here.
struct SampledVariable {
  SaveRequest request;
  std::string called;  ///< its name in the scene
  int material = 0;    ///< the index of the material in the scene
};

/// A file of the archive that a module writes, or a folder.
struct OwnFile {
  std::string path;  ///< path in the archive; for files of each output, the part that does not change
  Location where;    ///< the place in the scene that requires it
};

/// A `DataAnalysis/Module`, which measures the state of a run with diagnostic tasks.
class Analysis {
 public:
  virtual ~Analysis() = default;
  /// Adds diagnostic tasks. They see the state as old.
  virtual void schedule(tasks::TaskList& tasks) const = 0;
  /// Sets the time of the state [s] and the time since the start [s]. Called before the tasks run.
  virtual void setTime(double time, double sinceStart) = 0;
  /// The errors that the tasks measure at the end of the run.
  virtual std::vector<MeasuredError> errors() const { return {}; }
  /// The terms of the energy budget, which the report adds up.
  virtual std::vector<EnergyTerm> energies() const { return {}; }
  /// Why errors are not valid at the current time; empty if they are.
  virtual std::string whyUnmeasured() const { return {}; }
  /// Variables that sample() needs, and their positions in the scene.
  virtual std::vector<SaveRequest> samples() const { return {}; }
  /// The variables among samples() in which the scene replaces Uintah's names, and from which it removes those that no
  /// task computes. Null if there are none.
  virtual std::vector<SampledVariable>* variables() { return nullptr; }
  /// Uintah's names of the module's own variables, where they differ.
  virtual OtherNames otherNames() const { return {}; }
  /// The layers of the grid in which sample() needs the variables, without particles; if empty, everywhere.
  virtual std::vector<collect::Layer> layers() const { return {}; }
  /// The windows of the grid in which sample() needs the variables, likewise.
  virtual std::vector<collect::Window> windows() const { return {}; }
  /// The parts for which sample() needs snapshots of minima, maxima and sums instead.
  virtual std::optional<collect::SummaryOver> summary() const { return {}; }
  /// Whether to call sample() after this step, at the current time.
  virtual bool isSampleDue(int /*step*/) const { return false; }
  /// Processes the variables of samples(): in each of the layers() and windows(), as a summary(), or everywhere.
  /// Files of its own go to the folder of the archive.
  virtual void sample(const std::vector<output::Snapshot>&, const std::filesystem::path&) {}
  /// The files that sample() writes. Each belongs to one module. Called once the names of variables() are settled.
  virtual std::vector<OwnFile> files() const { return {}; }
  /// Completes the files, so that a run that continues from here finds all samples so far. Called on the first rank
  /// before each checkpoint is written, and at the end of the run. May throw FileError.
  virtual void flush() {}
  /// A table of exact values to plot with the result, one array per column, `x` first; empty if there is none.
  virtual std::vector<output::Array> exactProfile(const grid::Level&) const { return {}; }
};

}  // namespace tushar::simulation
