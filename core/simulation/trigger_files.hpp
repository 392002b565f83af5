#pragma once

#include <filesystem>

namespace tushar::simulation {

/// Files with which a user can send requests to a run: `output_now` or `stop_now` in the folder of its archive.
class TriggerFiles {
 public:
  /// Removes files that an earlier run has left.
  explicit TriggerFiles(std::filesystem::path folder);

  /// The requests that were found.
  struct Found {
    bool output = false, stop = false;
  };
  /// Checks for the files, at most ten times per second, and removes those that it finds. `now` is the wall time, s.
  Found look(double now);

 private:
  bool take(const char* name) const;

  std::filesystem::path folder_;
  double next_ = 0;  ///< time of the next look, s
};

}  // namespace tushar::simulation
