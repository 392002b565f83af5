#pragma once

#include <optional>
#include <string>

#include "core/base/mpi.hpp"
#include "core/simulation/restart.hpp"

namespace tushar::scene {

/// Finds the checkpoint from which to continue the run of a `.uda` (the folder, or a link to it): the checkpoint of
/// `step` or, if no step is given, the last intact one. The large variables of a checkpoint are not read, so damage in
/// them is not found here. Restores the scene file of the `.uda` if it is missing. Ranks divide the checks among
/// themselves. Collective. Throws InputError on rank 0 if there is no such checkpoint, with a message that lists the
/// existing ones, and FailedElsewhere on the others.
simulation::Restart findRestart(const std::string& uda, std::optional<int> step,
                                const mpi::Communicator& ranks = mpi::Communicator::alone());

}  // namespace tushar::scene
