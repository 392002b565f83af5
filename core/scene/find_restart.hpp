#pragma once

#include <optional>
#include <string>

#include "core/base/mpi.hpp"
#include "core/simulation/restart.hpp"

namespace tushar::scene {

/// The checkpoint of a `.uda` (the folder, or a link to it) from which to continue: that of `step`, or the last one
/// that is intact, as far as can be determined without reading its large variables. Restores the scene file if it is
/// missing. Ranks divide the checks among themselves. Collective. Throws InputError on rank 0 if there is no such
/// checkpoint, with a message that lists the existing ones, and FailedElsewhere on the others.
simulation::Restart findRestart(const std::string& uda, std::optional<int> step,
                                const mpi::Communicator& ranks = mpi::Communicator::alone());

}  // namespace tushar::scene
