#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/output/archive.hpp"
#include "core/output/archive_snapshot.hpp"
#include "core/output/folder_lock.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// The archive of a run and the contents of its folder: outputs, globals, and the samples of analysis modules. All
/// ranks make the same calls. Rank 0 writes the files; the writers of the run write outputs together with it.
class Outputs {
 public:
  /// `parent` is the folder in which a new archive will be made; if it is empty, the current folder is used.
  Outputs(RunState& run, std::filesystem::path parent);
  /// If a run ends by an exception, finishes the output in progress, provided that rank 0 can do so alone or that all
  /// ranks reach this destructor.
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  void setWarning(std::function<void(const std::string&)> warn) { warn_ = std::move(warn); }
  /// Locks the folder of the run that is continued. Throws FileError if another process has locked it.
  void lockArchive();
  /// Creates an archive if the scene has outputs, globals, samples or checkpoints. A restarted run, which has read its
  /// checkpoint, continues its previous archive. Throws FileError.
  void open();
  /// Saves the globals and, if requested, an output at the start.
  void saveStart();
  /// Saves the globals, and takes samples that are due, after a step.
  void saveGlobals();
  /// Begins an output after a step if one is due; completes the previous output if it has been written.
  void saveIfDue();
  /// Begins to write an output, if the scene has outputs and this step has none yet; further steps may run meanwhile.
  void save();
  /// If rank 0 alone has failed since the ranks last agreed on the wall time, throws its exception on rank 0 and
  /// FailedElsewhere on the others.
  void throwIfFailed();
  /// Waits for the output in progress.
  void finishOutput();
  /// Like finishOutput(); also updates the lists of the archive and the files of analysis modules.
  void flush();
  /// Like flush(), for a checkpoint; returns the current extent of the archive.
  output::ArchivePoint sync(bool waitsForDisk);

  /// Skips the output times up to the current time.
  void passMilestones() { times_.pass(run_.time.time()); }
  /// The next output time [s]; infinity if the scene gives no interval.
  double nextTime() const { return times_.next(); }
  /// The folder of the archive; empty if there is none.
  const std::string& folder() const { return folder_; }
  /// The archive; null if there is none, and on all ranks except rank 0.
  output::Archive* archive() const { return archive_.get(); }
  /// Wall time spent on collecting and writing [s], apart from writing during steps.
  double seconds() const { return seconds_; }
  /// The part of seconds() spent waiting for the output in progress [s].
  double waited() const { return behind_.waited(); }
  /// Time and size of compression on this rank.
  const output::PackingUse& packing() const { return packing_; }
  /// Increase of this rank's peak memory caused by collecting and writing [bytes].
  double memory() const { return memory_; }

 private:
  /// An output that is being written.
  struct OnItsWay {
    output::SnapshotInFlight file;
    output::Snapshot listed;  ///< the snapshot without its values
  };
  /// Renames the output in progress to its final name once it is written, and lists it; `ranks` as for
  /// SnapshotInFlight::finish().
  void finish(const mpi::Communicator& ranks);
  void finishIfWritten();
  /// Calls a function with the archive on rank 0. If it fails, throwIfFailed() later throws on all ranks.
  void onArchive(const std::function<void(output::Archive&)>& action);
  std::size_t mostBehind(std::uint64_t bytes) const;
  void makeArchive(const output::ArchiveOptions& how);
  void reopenArchive(const output::ArchiveOptions& how);
  bool isDue() const;
  /// Whether some analysis module samples variables during the run.
  bool samples() const;
  void sample(Analysis& analysis);
  void flushAnalyses();
  void appendGlobals(output::Archive& archive) const;

  RunState& run_;
  mpi::Communicator meeting_;  ///< the ranks of the run, which synchronise at its end
  std::filesystem::path parent_;
  std::optional<output::FolderLock> lock_;    ///< lock on the archive's folder
  std::unique_ptr<output::Archive> archive_;  ///< the archive; only on rank 0
  std::string folder_;
  Milestones times_;
  output::Behind behind_;
  std::optional<OnItsWay> on_its_way_;
  std::function<void(const std::string&)> warn_;
  std::exception_ptr failure_;  ///< exception of rank 0
  int last_ = -1;               ///< step of the last output
  bool saves_ = false;          ///< whether the scene has outputs, globals or samples
  double seconds_ = 0, memory_ = 0;
  output::PackingUse packing_;
};

}  // namespace tushar::simulation
