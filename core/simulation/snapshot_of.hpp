#pragma once

#include <vector>

#include "core/collect/gather.hpp"
#include "core/output/snapshot.hpp"
#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

/// The current state of a run, from all ranks: the particles of every material with p.x, and the requested variables.
/// Each rank has its own values; they are not copied, and valid until the state changes. All ranks call it.
output::Snapshot snapshotOf(RunState& run, const std::vector<SaveRequest>& requests);

/// The parts of the state that an analysis module samples, in the memory of rank 0; particles only for materials with
/// sampled particle variables. All ranks call it.
std::vector<output::Snapshot> partsOf(RunState& run, const Analysis& analysis);

}  // namespace tushar::simulation
