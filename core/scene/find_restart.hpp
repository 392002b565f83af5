#pragma once

#include <optional>
#include <string>

#include "core/base/mpi.hpp"
#include "core/simulation/restart.hpp"

namespace tushar::scene {

/// The checkpoint of a `.uda` (the folder, or a link to it) from which to continue: that of `step`, or the last one
/// that is intact, as far as is known without reading its large variables. Puts the scene back in its place where it is
/// lost. Ranks share the checking of what checkpoints hold. Collective. Throws InputError on rank 0 if there is no such
/// checkpoint, in a sentence that says what there is, and FailedElsewhere on the others.
simulation::Restart findRestart(const std::string& uda, std::optional<int> step,
                                const mpi::Communicator& ranks = mpi::Communicator::alone());

}  // namespace tushar::scene
