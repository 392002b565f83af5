#pragma once

#include <memory>
#include <stdexcept>

#include "components/reference/module_tags.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::reference {

using ReferencePointer = std::shared_ptr<const GasReference>;

/// Makes the analysis that measures a component's gas against what `build` makes for a grid, within a region if one is
/// given. The analysis is refused, with an InputError of the module, for a component that solves for no gas, and where
/// `build` throws std::invalid_argument.
simulation::MakeAnalysis measureAgainst(std::function<ReferencePointer(const grid::Level&)> build,
                                        const std::optional<Region>& within, const input::Element& module);

/// Reads a module (S: GasTags and more) whose exact solution does not depend on the grid; what `build(read)` refuses
/// becomes a problem of the module.
template <class S, class Build>
simulation::MakeAnalysis readModule(const input::Schema<S>& schema, const input::Element& module,
                                    input::Diagnostics& diagnostics, const Build& build) {
  const std::size_t before = diagnostics.size();
  const S read = schema.read(module, diagnostics);
  if (diagnostics.size() > before) return {};
  try {
    return measureAgainst([exact = ReferencePointer(build(read))](const grid::Level&) { return exact; }, read.within,
                          module);
  } catch (const std::invalid_argument& error) {
    diagnostics.error(module, error.what());
    return {};
  }
}

/// Reads a module whose exact solution `build(read, level)` depends on the grid.
template <class S, class Build>
simulation::MakeAnalysis readModuleOfGrid(const input::Schema<S>& schema, const input::Element& module,
                                          input::Diagnostics& diagnostics, const Build& build) {
  const std::size_t before = diagnostics.size();
  const S read = schema.read(module, diagnostics);
  if (diagnostics.size() > before) return {};
  return measureAgainst([read, build](const grid::Level& level) { return ReferencePointer(build(read, level)); },
                        read.within, module);
}

}  // namespace tushar::reference
