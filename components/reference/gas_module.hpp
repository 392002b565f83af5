#pragma once

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "components/reference/module_tags.hpp"
#include "components/reference/riemann_solution.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::reference {

using ReferencePointer = std::shared_ptr<const GasReference>;

/// Makes the analysis that compares a component's gas with the solution that `build` makes for a grid; if the tags give
/// a region, only within that region. Throws InputError with the location of the module if the component solves for no
/// gas or for other gases than `gases`, or if `build` throws std::invalid_argument.
simulation::MakeAnalysis measureAgainst(std::function<ReferencePointer(const grid::Level&)> build, const GasTags& tags,
                                        const std::vector<GasLaw>& gases, const input::Element& module);

/// The gas of a solution with a single gas, as given by the tags.
inline std::vector<GasLaw> gasOfTags(const GasTags& read) { return {{read.gamma, read.pInfinity}}; }

/// Describes the module `name`, which measures errors relative to the solution `build(read, level)` for the gases
/// `gasesOf(read)`. `read` has a type S derived from GasTags; `schema()` reads it and lives as long as the program.
template <class S, class Build, class GasesOf = decltype(&gasOfTags)>
simulation::AnalysisKind gasModule(std::string name, std::string sentence, const input::Schema<S>& (*schema)(),
                                   Build build, GasesOf gasesOf = gasOfTags) {
  simulation::AnalysisKind kind{std::move(name), std::move(sentence), {}, {}};
  kind.describe = [schema](std::ostream& out) { schema().describe(out); };
  kind.schema = [schema]() -> const input::SchemaBase* { return &schema(); };
  kind.read = [schema, build, gasesOf](const input::Element& module,
                                       input::Diagnostics& diagnostics) -> simulation::MakeAnalysis {
    const std::size_t before = diagnostics.size();
    const S read = schema().read(module, diagnostics);
    if (diagnostics.size() > before) return {};
    return measureAgainst([read, build](const grid::Level& level) { return ReferencePointer(build(read, level)); },
                          read, gasesOf(read), module);
  };
  return kind;
}

}  // namespace tushar::reference
