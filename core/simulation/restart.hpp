#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/output/checkpoint_store.hpp"

namespace tushar::simulation {

/// The file of a checkpoint that holds the whole state.
inline constexpr const char* stateFile = "state.h5";

/// The archive and the checkpoint from which a run continues.
struct Restart {
  std::filesystem::path archive;          ///< the folder of the run before, `sod.uda.001`
  int step = 0;                           ///< of the checkpoint
  bool isChosen = false;                  ///< by the user; else it is the newest that is whole
  std::vector<std::string> notes;         ///< sentences on what was found damaged on the way
  std::vector<std::uint64_t> others;      ///< steps of checkpoints to take if this is damaged, in that order
  std::vector<output::FilePart> parts{};  ///< of its file, which are checked when they are read

  /// The scene of the earlier run.
  std::filesystem::path scene() const { return archive / "input.xml"; }
  /// The checkpoint's file.
  std::filesystem::path state() const { return output::CheckpointStore(archive, 1).folder(step) / stateFile; }
};

// All ranks call these, with the same.

/// Notes a damage of the checkpoint.
void noteDamage(Restart& restart, const std::string& damage);
/// Selects the next intact one of the others, as far as it is read now, and notes the damage of those before it.
/// False if none is. If a newer version wrote one, throws InputError on rank 0, and FailedElsewhere on the others.
bool takeNext(Restart& restart, const mpi::Communicator& ranks);
/// Throws InputError on the first rank, with all that was noted, and FailedElsewhere on the others.
[[noreturn]] void refuseDamaged(const Restart& restart, const mpi::Communicator& ranks);
/// `there are those of steps 4, 6`.
std::string listedSteps(const std::vector<int>& steps);
/// The sentence that says so, after what was noted.
std::string continuesFrom(const Restart& restart);

}  // namespace tushar::simulation
