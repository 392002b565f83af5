#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/output/archive.hpp"
#include "core/output/folder_lock.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// What a run saves in the folder of its archive: outputs, globals, and the samples of analysis modules. Every rank
/// calls what it calls on them; the first writes.
class Outputs {
 public:
  /// A new archive will be made in this folder; empty: the current one.
  Outputs(RunState& run, std::filesystem::path parent);

  /// Locks the folder of the run that this one goes on from. Throws FileError if another process has it.
  void lockArchive();
  /// Makes an archive where the scene asks for outputs, globals or checkpoints, or goes on in that of the run before,
  /// whose checkpoint has been read. Throws FileError.
  void open();
  /// The globals and, where the scene asks for it, the output of the start.
  void saveStart();
  /// The globals and the samples that are due after a step.
  void saveGlobals();
  /// The output that is due after a step, if any.
  void saveIfDue();
  /// Writes an output, where the scene asks for any and this step has none.
  void save();
  /// Brings what is kept in memory to the archive.
  void flush();

  /// The output times up to now have been passed in the run before.
  void passMilestones() { times_.pass(run_.time.time()); }
  /// The next output time, s; infinity where the scene gives no interval.
  double nextTime() const { return times_.next(); }
  /// The folder of the archive; empty where there is none.
  const std::string& folder() const { return folder_; }
  /// The archive; null where there is none, and on every rank but the first.
  output::Archive* archive() const { return archive_.get(); }
  /// Wall time spent collecting and writing, s.
  double seconds() const { return seconds_; }

 private:
  void makeArchive(const output::ArchiveOptions& how);
  void reopenArchive(const output::ArchiveOptions& how);
  bool isDue() const;
  /// Whether some analysis module looks at particles while the run goes on.
  bool samples() const;
  void sample(Analysis& analysis);
  void appendGlobals();

  RunState& run_;
  std::filesystem::path parent_;
  std::optional<output::FolderLock> lock_;    ///< on the archive's folder
  std::unique_ptr<output::Archive> archive_;  ///< of the first rank
  std::string folder_;
  Milestones times_;
  int last_ = -1;       ///< step of the last output
  bool saves_ = false;  ///< whether the scene asks for outputs, globals or samples
  double seconds_ = 0;
};

}  // namespace tushar::simulation
