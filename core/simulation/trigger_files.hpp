#pragma once

#include <filesystem>

namespace tushar::simulation {

/// Files by which requests reach a run from outside: `output_now` or `stop_now` in the folder of its archive.
class TriggerFiles {
 public:
  /// Removes files that an earlier run has left.
  explicit TriggerFiles(std::filesystem::path folder);

  /// The requests that were found.
  struct Found {
    bool output = false, stop = false;
  };
  /// Looks for the files, at most ten times in a second, and takes away what it finds. `now` is the wall time, s.
  Found look(double now);

 private:
  bool take(const char* name) const;

  std::filesystem::path folder_;
  double next_ = 0;  ///< when to look again, s
};

}  // namespace tushar::simulation
