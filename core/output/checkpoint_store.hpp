#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/output/checkpoint_manifest.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// The folder `checkpoints` of an archive. This class does not interpret the contents of a checkpoint.
///
///     sod.uda.001/checkpoints/LATEST     the name of the newest, `t00050`
///                             t00040/    the one before
///                             t00050/    files, and the manifest, with their checksums
///
/// A checkpoint is written under a temporary name, flushed to the disk, and then renamed. Only then is LATEST replaced
/// (also by a rename), and only after that is the oldest checkpoint removed. So if a run is killed, or the disk becomes
/// full, the earlier checkpoints stay intact. If checkpoints follow one another so fast that the disk would slow down
/// the run, some do not wait for the disk. The last checkpoint on the disk is then kept in addition, because the power
/// may fail before later ones have been flushed.
class CheckpointStore {
 public:
  /// How a checkpoint is written.
  struct Pace {
    bool waitsForDisk = true;  ///< whether it is on the disk when write() returns
    int lastOnDisk = -1;       ///< step of an earlier checkpoint, not removed if the new one is not yet on the disk
  };

  /// `cycle` is the number of checkpoints to keep, at least 1. No folder is made before the first write().
  explicit CheckpointStore(const std::filesystem::path& archive, int cycle, const Writers& writers = {});

  /// Writes a checkpoint: `fill` writes its files to the given folder, and returns those parts of them that are checked
  /// while they are read. All writing ranks call it. Throws FileError on a rank that fails, FailedElsewhere on the
  /// others, or any exception of `fill`, which must then throw on all ranks. After an exception, no part of the
  /// checkpoint remains.
  void write(int step, const std::function<std::vector<FilePart>(const std::filesystem::path& folder)>& fill,
             const Pace& pace) const;
  void write(int step, const std::function<std::vector<FilePart>(const std::filesystem::path& folder)>& fill) const {
    write(step, fill, Pace{});
  }
  /// Waits until a checkpoint that write() left in memory is on the disk; then removes those beyond the cycle.
  /// Collective.
  void bringToDisk(int step) const;
  /// Makes the checkpoint of a step the latest one, and removes all later checkpoints.
  void goBackTo(int step) const;

  /// The folder of the checkpoint of a step.
  std::filesystem::path folder(int step) const;
  /// Steps of the existing checkpoints, intact or not, ascending.
  std::vector<int> steps() const;
  /// The step in the file LATEST, or the step of the last checkpoint if there is no such file; -1 if there is no
  /// checkpoint.
  int latest() const;

 private:
  void setLatest(int step, bool waitsForDisk = true) const;
  void removeOldest(int except) const;
  void remove(int step) const;
  void removeLeftovers() const;

  std::filesystem::path folder_;
  int cycle_;
  Writers writers_;
};

}  // namespace tushar::output
