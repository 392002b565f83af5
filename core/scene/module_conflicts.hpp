#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/simulation/analysis.hpp"

// Conflicts between two modules of a scene.

namespace tushar::scene {

/// The quantities that earlier modules of the scene already measure and compute.
struct TakenByModules {
  std::set<std::string> measured, computed;
};

/// Throws InputError for a module that measures or computes the same quantity as an earlier one; otherwise adds the
/// quantities of this module to `taken`. A report has only one place for the errors of a field and one for an energy
/// budget, and only one task may compute a variable.
void refuseTwice(const simulation::Analysis& analysis, const input::Element& module, TakenByModules& taken);

/// Reports files that would be written by two modules, or by a module and the archive itself.
void refuseSharedFiles(const std::vector<std::unique_ptr<simulation::Analysis>>& analyses,
                       const std::vector<simulation::SaveRequest>& saves, input::Diagnostics& diagnostics);

}  // namespace tushar::scene
