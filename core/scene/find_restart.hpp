#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tushar::simulation {

/// Where a run goes on.
struct Restart {
  std::filesystem::path archive;   ///< the folder of the run before, `sod.uda.001`
  int step = 0;                    ///< of the checkpoint
  std::vector<std::string> notes;  ///< sentences on what was found damaged on the way

  /// The scene as the run before had it.
  std::filesystem::path scene() const { return archive / "input.xml"; }
  /// The checkpoint's file.
  std::filesystem::path state() const;
};

/// The file of a checkpoint with everything in it.
inline constexpr const char* stateFile = "state.h5";

/// The checkpoint of a `.uda` (the folder, or the link to it) to go on from: that of `step`, or the last that is whole.
/// Puts the scene back in its place where it is lost. Throws InputError where there is no such checkpoint, in a
/// sentence that says what there is.
Restart findRestart(const std::string& uda, std::optional<int> step);

}  // namespace tushar::simulation
