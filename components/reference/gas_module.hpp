#pragma once

#include <memory>
#include <stdexcept>

#include "components/reference/module_tags.hpp"
#include "components/reference/riemann_solution.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::reference {

using ReferencePointer = std::shared_ptr<const GasReference>;

/// Makes the analysis that measures a component's gas against what `build` makes for a grid, within a region if one is
/// given. The analysis is refused, with an InputError of the module, for a component that solves for no gas or not for
/// `gases`, and where `build` throws std::invalid_argument.
simulation::MakeAnalysis measureAgainst(std::function<ReferencePointer(const grid::Level&)> build, const GasTags& tags,
                                        const std::vector<GasLaw>& gases, const input::Element& module);

/// Reads a module (S: GasTags and more) whose exact solution on a grid is `build(read, level)`, of the gases
/// `gasesOf(read)`.
template <class S, class Build, class GasesOf>
simulation::MakeAnalysis readModule(const input::Schema<S>& schema, const input::Element& module,
                                    input::Diagnostics& diagnostics, const Build& build, const GasesOf& gasesOf) {
  const std::size_t before = diagnostics.size();
  const S read = schema.read(module, diagnostics);
  if (diagnostics.size() > before) return {};
  return measureAgainst([read, build](const grid::Level& level) { return ReferencePointer(build(read, level)); }, read,
                        gasesOf(read), module);
}

/// The same of one gas, that of the tags.
template <class S, class Build>
simulation::MakeAnalysis readModule(const input::Schema<S>& schema, const input::Element& module,
                                    input::Diagnostics& diagnostics, const Build& build) {
  return readModule(schema, module, diagnostics, build, [](const S& read) {
    return std::vector{GasLaw{read.gamma, read.pInfinity}};
  });
}

}  // namespace tushar::reference
