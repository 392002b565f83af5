#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/output/checkpoint_store.hpp"

namespace tushar::simulation {

/// The name of the checkpoint file that contains the whole state.
inline constexpr const char* stateFile = "state.h5";

/// The archive and the checkpoint from which a run continues.
struct Restart {
  std::filesystem::path archive;  ///< folder of the earlier run, such as `sod.uda.001`
  int step = 0;                   ///< step of the checkpoint
  /// Whether the user chose the checkpoint; otherwise it is the newest intact one.
  bool isChosen = false;
  std::vector<std::string> notes;         ///< messages about damaged checkpoints that were found
  std::vector<std::uint64_t> others;      ///< steps of checkpoints to try if this one is damaged, in this order
  std::vector<output::FilePart> parts{};  ///< parts of the file that are checked when they are read

  /// The scene file of the earlier run.
  std::filesystem::path scene() const { return archive / "input.xml"; }
  /// The state file of the checkpoint.
  std::filesystem::path state() const { return output::CheckpointStore(archive, 1).folder(step) / stateFile; }
};

// All ranks call these functions, with the same arguments.

/// Adds a note that the checkpoint is damaged.
void noteDamage(Restart& restart, const std::string& damage);
/// Selects the next checkpoint that is intact, as far as can be checked now, and notes the damage to the checkpoints
/// that it skips. Returns false if none is intact. If a checkpoint was written by a newer version, throws InputError on
/// rank 0, and FailedElsewhere on the others.
bool takeNext(Restart& restart, const mpi::Communicator& ranks);
/// Throws InputError on rank 0, with all notes, and FailedElsewhere on the others.
[[noreturn]] void refuseDamaged(const Restart& restart, const mpi::Communicator& ranks);
/// The steps of checkpoints in words: `available: steps 4, 6`.
std::string listedSteps(const std::vector<int>& steps);
/// The notes, followed by the sentence that names the checkpoint in use.
std::string continuesFrom(const Restart& restart);

}  // namespace tushar::simulation
