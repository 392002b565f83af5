#pragma once

#include <filesystem>
#include <vector>

#include "core/output/archive.hpp"
#include "core/output/checkpoint_manifest.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

// A checkpoint's file.
//
//     /                  attributes format, step, time, delT, dropped, version, component
//     /grid              attributes lower, spacing, cells, dimension
//     /scene             the scene with its overrides
//     /archive/index     the text of the archive's index.xml
//     /totals/<name>     mass, momentum and energy at the very start, for the drift of the report
//     /reported/<key>    numbers of the report that accumulate step by step
//     /removed           number of removed particles; `dropped` counts those that left the grid
//     and the state: see core/collect/stored_state.hpp

/// The location of a checkpoint file, and its content apart from the variables.
struct CheckpointTarget {
  std::filesystem::path path;
  output::ArchivePoint point;  ///< extent of the archive; on rank 0 only
  tasks::LostParticles lost;   ///< numbers of particles lost on all ranks
};

/// Writes the current state of a run; returns the parts of the file that contain its values. Collective. Throws
/// FileError on a rank that cannot write, and FailedElsewhere on the others.
std::vector<output::FilePart> writeCheckpoint(RunState& run, const CheckpointTarget& target);

/// Restores a run from the checkpoint that its Problem names: the variables, step and time, the number of dropped
/// particles, the totals at the start and the numbers of the report so far. Throws InputError for a checkpoint of
/// another format, step, component or grid, and DamageError if values have changed since the checkpoint was written.
/// All ranks call it.
void readCheckpoint(RunState& run);

/// The extent that the archive had when the checkpoint of a restarted run was written. Call it after readCheckpoint().
output::ArchivePoint archivePointOf(const RunState& run);

}  // namespace tushar::simulation
