#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/input/tag_form.hpp"
#include "core/simulation/analysis.hpp"
#include "core/simulation/component.hpp"

namespace tushar::simulation {

/// Builds a component on a grid, from what was read of the scene before.
using MakeComponent = std::function<std::unique_ptr<Component>(const grid::Level&)>;

/// A section that a component reads, for the schemas of editors.
struct SectionForm {
  std::string name;
  const input::SchemaBase* schema = nullptr;  ///< null: anything may stand in it
  bool required = true;
  std::vector<input::Demand> demands = {};  ///< what else it takes for the schema to read it
};

/// A component that sus knows: one line of the table in components/components.cpp.
struct ComponentKind {
  std::string name;                                    ///< the `type` of SimulationComponent
  std::string sentence;                                ///< what it is
  std::vector<std::string> sections;                   ///< tags below the root that it reads
  std::vector<grid::BoundaryVariable> boundaryLabels;  ///< that it has conditions for
  /// Reads its sections from the root of the scene; every problem goes to the diagnostics.
  std::function<MakeComponent(const input::Element& root, input::Diagnostics&)> read;
  std::function<void(std::ostream&)> describe;  ///< its manual
  /// Layers of nodes that the scene needs beyond the sides of the grid; none where it is empty.
  std::function<int(const input::Element& root)> nodesBeyond;
  /// The sections of a scene in each of the ways to write one; where it is empty, anything may stand in `sections`.
  std::function<std::vector<std::vector<SectionForm>>()> forms;
};

/// Builds a module for a component; throws InputError if the two do not go together.
using MakeAnalysis = std::function<std::unique_ptr<Analysis>(const Component&, const grid::Level&)>;

/// An on-the-fly analysis that sus knows: a `DataAnalysis/Module name=`.
struct AnalysisKind {
  std::string name;
  std::string sentence;
  std::function<MakeAnalysis(const input::Element& module, input::Diagnostics&)> read;
  std::function<void(std::ostream&)> describe;
  std::function<const input::SchemaBase*()> schema = {};  ///< of the tag; where it is empty, anything may stand in it
};

/// Everything that a scene can pick.
struct Catalogue {
  std::vector<ComponentKind> components;
  std::vector<AnalysisKind> analyses;
};

/// The entry of that name, or null.
template <class Kind>
const Kind* findKind(const std::vector<Kind>& kinds, std::string_view name) {
  for (const Kind& kind : kinds)
    if (kind.name == name) return &kind;
  return nullptr;
}
template <class Kind>
std::vector<std::string> namesOf(const std::vector<Kind>& kinds) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

}  // namespace tushar::simulation
