#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/output/checkpoint_store.hpp"

namespace tushar::simulation {

/// The file of a checkpoint with everything in it.
inline constexpr const char* stateFile = "state.h5";

/// Where a run goes on.
struct Restart {
  std::filesystem::path archive;   ///< the folder of the run before, `sod.uda.001`
  int step = 0;                    ///< of the checkpoint
  std::vector<std::string> notes;  ///< sentences on what was found damaged on the way

  /// The scene as the run before had it.
  std::filesystem::path scene() const { return archive / "input.xml"; }
  /// The checkpoint's file.
  std::filesystem::path state() const { return output::CheckpointStore(archive, 1).folder(step) / stateFile; }
};

}  // namespace tushar::simulation
