#pragma once

#include <memory>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/simulation/component.hpp"

namespace tushar::scene {

/// Reports problems with saved and sampled labels. Removes, with a note, labels of Uintah that no task computes.
void checkLabels(const simulation::Component& component,
                 const std::vector<std::unique_ptr<simulation::Analysis>>& analyses,
                 std::vector<simulation::SaveRequest>& saves, input::Diagnostics& diagnostics);

}  // namespace tushar::scene
