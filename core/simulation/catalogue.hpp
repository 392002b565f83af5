#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/input/tag_form.hpp"
#include "core/simulation/analysis.hpp"
#include "core/simulation/component.hpp"

namespace tushar::simulation {

/// Builds a component on a grid, with settings that have already been read from the scene.
using MakeComponent = std::function<std::unique_ptr<Component>(const grid::Level&)>;

/// A section that a component reads, for the schemas that editors use.
struct SectionForm {
  std::string name;
  const input::SchemaBase* schema = nullptr;  ///< schema of the section; null if it may contain anything
  bool required = true;
  std::vector<input::Demand> demands = {};  ///< further requirements for the schema to apply
};

/// A component's own types of boundary conditions.
struct ConditionWords {
  std::vector<std::string> vars = {};  ///< further values of the attribute `var` of BCType
  /// Tags of BoundaryConditions with values for these conditions.
  std::vector<SectionForm> sections = {};
  /// Translates a BCType of such a type into conditions; `sides` is the tag BoundaryConditions. Reports problems to the
  /// diagnostics.
  std::function<std::vector<grid::BoundaryCondition>(const input::Element& sides, const input::Element& condition,
                                                     input::Diagnostics&)>
      read = {};
};

/// The description of a component that sus can run.
struct ComponentKind {
  std::string name;                                    ///< the `type` of SimulationComponent that selects it
  std::string sentence;                                ///< description in one sentence
  std::vector<std::string> sections;                   ///< names of the tags below the root that the component reads
  std::vector<grid::BoundaryVariable> boundaryLabels;  ///< variables for which boundary conditions may be given
  ConditionWords conditionWords;                       ///< the component's own words for conditions
  /// Reads the component's sections from the root of the scene; reports every problem to the diagnostics.
  std::function<MakeComponent(const input::Element& root, input::Diagnostics&)> read;
  std::function<void(std::ostream&)> describe;  ///< writes the manual of the component
  /// Number of layers of nodes that the scene needs outside the grid; 0 if the function is empty.
  std::function<int(const input::Element& root)> nodesBeyond;
  /// The smallest number of cells of a block along an axis that the tasks of a scene allow (see
  /// tasks::fewestCellsOfBlock); 4 if the function is empty. Smaller blocks in a scene are replaced, with a note.
  std::function<int(const input::Element& root)> cellsOfBlocks;
  /// The sections of a scene, for each way to write it; if the function is empty, `sections` may contain anything.
  std::function<std::vector<std::vector<SectionForm>>()> forms;
  bool takesLevels = false;           ///< whether the component's tasks run on grids of several levels
  bool refinesByItself = false;       ///< whether <max_levels> above 1 makes the grid adaptive without a <Variable>
  bool takesPartsOfSides = false;     ///< whether parts of a side may have their own conditions
  bool takesFormulasAtSides = false;  ///< whether values of boundary conditions may be formulas
  /// Names of tags in AMR with thresholds for this component, in addition to the tag named after it.
  std::vector<std::string> amrSections;
  /// Paths of tags whose labelled shapes can be used by all siblings, even those above: `MaterialProperties/MPM`.
  std::vector<std::string> readFirst;
};

/// Builds an analysis module for a component; throws InputError if the component does not support it.
using MakeAnalysis = std::function<std::unique_ptr<Analysis>(const Component&, const grid::Level&)>;

/// The description of an analysis module, selected by `DataAnalysis/Module name=`.
struct AnalysisKind {
  std::string name;
  std::string sentence;
  std::function<MakeAnalysis(const input::Element& module, input::Diagnostics&)> read;
  std::function<void(std::ostream&)> describe;
  std::function<const input::SchemaBase*()> schema = {};  ///< schema of the tag; if empty, the tag may contain anything
};

/// The entry with this name, or null if there is none.
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

/// A shared library, and the names of its components and analyses; it is loaded when one of them is first needed.
struct Module {
  std::string name;
  std::vector<std::string> components, analyses;
};

/// The components and analyses that a scene can select.
class Catalogue {
 public:
  Catalogue() = default;
  Catalogue(const std::vector<ComponentKind>& components, const std::vector<AnalysisKind>& analyses);

  /// Adds the entries of another catalogue, except its modules. Throws std::invalid_argument if a name is already in
  /// use.
  void add(const Catalogue& other);
  /// `load` returns the contents of the module. Throws std::invalid_argument if a name is already in use.
  void addModule(const Module& module, std::function<Catalogue()> load);

  std::vector<std::string> componentNames() const;
  std::vector<std::string> analysisNames() const;
  /// The component with this name, valid as long as the catalogue exists; null if there is none. Loads its module.
  const ComponentKind* component(std::string_view name) const;
  /// The analysis with this name, valid as long as the catalogue exists; null if there is none. Loads its module.
  const AnalysisKind* analysis(std::string_view name) const;
  /// All components, sorted by name; loads all modules.
  std::vector<const ComponentKind*> components() const;
  std::vector<const AnalysisKind*> analyses() const;

 private:
  using LoadModule = std::function<Catalogue()>;
  /// A component or analysis, or the module that provides it.
  template <class Kind>
  using Entries = std::map<std::string, std::variant<Kind, std::shared_ptr<LoadModule>>, std::less<>>;

  template <class Kind>
  const Kind* find(const Entries<Kind>& entries, std::string_view name) const;
  template <class Kind>
  std::vector<const Kind*> all(const Entries<Kind>& entries) const;
  void take(const LoadModule& load) const;

  mutable Entries<ComponentKind> components_;
  mutable Entries<AnalysisKind> analyses_;
};

}  // namespace tushar::simulation
