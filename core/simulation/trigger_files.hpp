#pragma once

#include <filesystem>

namespace tushar::simulation {

/// Files by which a user can send requests to a run: `output_now` or `stop_now` in the folder of its archive.
class TriggerFiles {
 public:
  /// Removes request files left by an earlier run.
  explicit TriggerFiles(std::filesystem::path folder);

  /// The requests that were found.
  struct Found {
    bool output = false, stop = false;
  };
  /// Checks for the files, at most ten times per second, and removes those that it finds. `now` is the wall time [s].
  Found look(double now);

 private:
  bool take(const char* name) const;

  std::filesystem::path folder_;
  double next_ = 0;  ///< wall time of the next check [s]
};

}  // namespace tushar::simulation
