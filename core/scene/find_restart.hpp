#pragma once

#include <optional>
#include <string>

#include "core/simulation/restart.hpp"

namespace tushar::scene {

/// The checkpoint of a `.uda` (the folder, or the link to it) to go on from: that of `step`, or the last that is whole.
/// Puts the scene back in its place where it is lost. Throws InputError where there is no such checkpoint, in a
/// sentence that says what there is.
simulation::Restart findRestart(const std::string& uda, std::optional<int> step);

}  // namespace tushar::scene
