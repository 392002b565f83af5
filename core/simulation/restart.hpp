#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/output/checkpoint_store.hpp"

namespace tushar::simulation {

/// The file of a checkpoint that holds the whole state.
inline constexpr const char* stateFile = "state.h5";

/// The archive and the checkpoint from which a run continues.
struct Restart {
  std::filesystem::path archive;   ///< the folder of the run before, `sod.uda.001`
  int step = 0;                    ///< of the checkpoint
  std::vector<std::string> notes;  ///< sentences on what was found damaged on the way

  /// The scene of the earlier run.
  std::filesystem::path scene() const { return archive / "input.xml"; }
  /// The checkpoint's file.
  std::filesystem::path state() const { return output::CheckpointStore(archive, 1).folder(step) / stateFile; }
};

}  // namespace tushar::simulation
