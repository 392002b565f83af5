#pragma once

#include <filesystem>

#include "core/output/archive.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

// A checkpoint's file.
//
//     /                  attributes format, step, time, delT, dropped, version, component
//     /grid              attributes lower, spacing, cells, dimension
//     /scene             the scene with its overrides
//     /archive/index, xdmf    what index.xml and the XDMF file of the archive said
//     /totals/<name>     mass, momentum and energy at the very start, for the drift of the report
//     and the state: see core/collect/stored_state.hpp

/// A place for the file of a checkpoint, and what it holds beside the state.
struct CheckpointTarget {
  std::filesystem::path path;
  output::ArchivePoint point;  ///< how far the archive is
  long dropped = 0;            ///< particles that have left the grid, on all ranks
};

/// Writes the state of a run as it is now. Every rank calls it; the first hands over the target, the others null.
void writeCheckpoint(RunState& run, const CheckpointTarget* target);

/// Makes the checkpoint that a run goes on from its state: the variables, step and time, dropped particles and totals
/// at the start. Throws InputError for one of another format, component or grid. Every rank calls it.
void readCheckpoint(RunState& run);

/// How far the archive was when the checkpoint that a run goes on from was written; the run has read it.
output::ArchivePoint archivePointOf(const RunState& run);

}  // namespace tushar::simulation
