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

/// Builds a component on a grid, with the settings read from the scene before.
using MakeComponent = std::function<std::unique_ptr<Component>(const grid::Level&)>;

/// A section that a component reads, for the schemas of editors.
struct SectionForm {
  std::string name;
  const input::SchemaBase* schema = nullptr;  ///< null: the section may contain anything
  bool required = true;
  std::vector<input::Demand> demands = {};  ///< further conditions for the schema to apply
};

/// A component's own types of conditions at sides of the grid.
struct ConditionWords {
  std::vector<std::string> vars = {};  ///< further `var`s of a BCType
  /// Tags of BoundaryConditions with values for such conditions.
  std::vector<SectionForm> sections = {};
  /// The conditions that a BCType of such a type stands for; `sides` is its BoundaryConditions. Problems go to the
  /// diagnostics.
  std::function<std::vector<grid::BoundaryCondition>(const input::Element& sides, const input::Element& condition,
                                                     input::Diagnostics&)>
      read = {};
};

/// The description of a component that sus can run.
struct ComponentKind {
  std::string name;                                    ///< the `type` of SimulationComponent
  std::string sentence;                                ///< description in a sentence
  std::vector<std::string> sections;                   ///< tags below the root that the component reads
  std::vector<grid::BoundaryVariable> boundaryLabels;  ///< variables of its boundary conditions
  ConditionWords conditionWords;                       ///< the component's own words for conditions
  /// Reads the component's sections from the root of the scene; reports every problem to the diagnostics.
  std::function<MakeComponent(const input::Element& root, input::Diagnostics&)> read;
  std::function<void(std::ostream&)> describe;  ///< its manual
  /// Number of layers of nodes that the scene needs outside the grid; an empty function means none.
  std::function<int(const input::Element& root)> nodesBeyond;
  /// The smallest number of cells of a block along an axis that the tasks of a scene allow (see
  /// tasks::fewestCellsOfBlock); an empty function means 4. Smaller blocks of a scene are replaced, with a note.
  std::function<int(const input::Element& root)> cellsOfBlocks;
  /// The sections of a scene, for each way to write one; if the function is empty, `sections` may contain anything.
  std::function<std::vector<std::vector<SectionForm>>()> forms;
  bool takesLevels = false;           ///< whether its tasks run on grids of several levels
  bool refinesByItself = false;       ///< whether <max_levels> above 1 makes the grid adaptive without a <Variable>
  bool takesPartsOfSides = false;     ///< whether a part of a side may have its own conditions
  bool takesFormulasAtSides = false;  ///< whether values of its conditions may be formulas
  /// Tags of AMR with its thresholds, in addition to the one with its name.
  std::vector<std::string> amrSections;
  /// Paths of tags whose labelled shapes their siblings can use, even siblings further up: `MaterialProperties/MPM`.
  std::vector<std::string> readFirst;
};

/// Builds a module for a component; throws InputError if the component does not support it.
using MakeAnalysis = std::function<std::unique_ptr<Analysis>(const Component&, const grid::Level&)>;

/// The description of an on-the-fly analysis: a `DataAnalysis/Module name=`.
struct AnalysisKind {
  std::string name;
  std::string sentence;
  std::function<MakeAnalysis(const input::Element& module, input::Diagnostics&)> read;
  std::function<void(std::ostream&)> describe;
  std::function<const input::SchemaBase*()> schema =
      {};  ///< schema of the tag; if it is empty, the tag may contain anything
};

/// The entry with this name, or null.
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

/// A shared library with components and analyses, and their names; it is loaded when one of them is first needed.
struct Module {
  std::string name;
  std::vector<std::string> components, analyses;
};

/// The components and analyses that a scene can select.
class Catalogue {
 public:
  Catalogue() = default;
  Catalogue(const std::vector<ComponentKind>& components, const std::vector<AnalysisKind>& analyses);

  /// Adds the entries of another catalogue, except its modules. Throws std::invalid_argument if a name is taken.
  void add(const Catalogue& other);
  /// `load` returns the contents of the module. Throws std::invalid_argument if a name is taken.
  void addModule(const Module& module, std::function<Catalogue()> load);

  std::vector<std::string> componentNames() const;
  std::vector<std::string> analysisNames() const;
  /// The component of this name, valid as long as the catalogue exists; null if there is none. Loads its module.
  const ComponentKind* component(std::string_view name) const;
  /// The analysis of this name, like component().
  const AnalysisKind* analysis(std::string_view name) const;
  /// All entries in the order of their names; loads all modules.
  std::vector<const ComponentKind*> components() const;
  std::vector<const AnalysisKind*> analyses() const;

 private:
  using LoadModule = std::function<Catalogue()>;
  /// A kind, or the module that provides it.
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
