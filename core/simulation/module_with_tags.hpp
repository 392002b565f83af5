#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>

#include "core/input/schema.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::simulation {

/// The module `name` with tags of its own, which `schema` reads; that must outlive it. An `A` is made from the settings
/// and, if it takes them, the component and the grid.
template <class A, class Settings>
AnalysisKind moduleWithTags(std::string name, std::string sentence, const input::Schema<Settings>& schema) {
  const auto read = [&schema](const input::Element& module, input::Diagnostics& diagnostics) -> MakeAnalysis {
    return [settings = schema.read(module, diagnostics)]([[maybe_unused]] const Component& component,
                                                         const grid::Level& level) {
      if constexpr (std::is_constructible_v<A, Settings, const Component&, const grid::Level&>)
        return std::make_unique<A>(settings, component, level);
      else if constexpr (std::is_constructible_v<A, Settings, const grid::Level&>)
        return std::make_unique<A>(settings, level);
      else
        return std::make_unique<A>(settings);
    };
  };
  return {std::move(name), std::move(sentence), read, [&schema](std::ostream& out) { schema.describe(out); },
          [&schema] { return &schema; }};
}

}  // namespace tushar::simulation
