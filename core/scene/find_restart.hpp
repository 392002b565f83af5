#pragma once

#include <optional>
#include <string>

#include "core/simulation/restart.hpp"

namespace tushar::scene {

/// The checkpoint of a `.uda` (the folder, or the link to it) from which to continue: that of `step`, or the last
/// intact one. Puts the scene back in its place where it is lost. Throws InputError where there is no such checkpoint,
/// in a sentence that says what there is.
simulation::Restart findRestart(const std::string& uda, std::optional<int> step);

}  // namespace tushar::scene
