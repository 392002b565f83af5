#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>

#include "core/input/schema.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::simulation {

/// Describes the analysis module `name` with its own tags, which `schema` reads; the schema must outlive the module.
/// `make(settings, tag of the module, component, grid)` constructs it.
template <class Settings, class Make>
AnalysisKind moduleMadeBy(std::string name, std::string sentence, const input::Schema<Settings>& schema, Make make) {
  const auto read = [&schema, make](const input::Element& module, input::Diagnostics& diagnostics) -> MakeAnalysis {
    return
        [settings = schema.read(module, diagnostics), module, make](
            const Component& component, const grid::Level& level) { return make(settings, module, component, level); };
  };
  return {std::move(name), std::move(sentence), read, [&schema](std::ostream& out) { schema.describe(out); },
          [&schema] { return &schema; }};
}

/// Like the function above, for a type A that is constructed from the settings and, optionally, the component and the
/// grid.
template <class A, class Settings>
AnalysisKind moduleWithTags(std::string name, std::string sentence, const input::Schema<Settings>& schema) {
  const auto make = [](const Settings& settings, const input::Element&, [[maybe_unused]] const Component& component,
                       [[maybe_unused]] const grid::Level& level) {
    if constexpr (std::is_constructible_v<A, Settings, const Component&, const grid::Level&>)
      return std::make_unique<A>(settings, component, level);
    else if constexpr (std::is_constructible_v<A, Settings, const grid::Level&>)
      return std::make_unique<A>(settings, level);
    else
      return std::make_unique<A>(settings);
  };
  return moduleMadeBy(std::move(name), std::move(sentence), schema, make);
}

/// Constructs a module with as many dimensions as the grid has axes in use.
template <template <int> class A, class... Arguments>
std::unique_ptr<Analysis> analysisByDimension(const grid::Level& level, const Arguments&... arguments) {
  if (level.dimension() == 1) return std::make_unique<A<1>>(arguments...);
  if (level.dimension() == 2) return std::make_unique<A<2>>(arguments...);
  return std::make_unique<A<3>>(arguments...);
}

}  // namespace tushar::simulation
