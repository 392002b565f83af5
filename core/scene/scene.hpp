#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/grid/choose_patches.hpp"
#include "core/input/document.hpp"
#include "core/simulation/catalogue.hpp"
#include "core/simulation/problem.hpp"

namespace tushar::scene {

/// Reads a scene, applies the overrides of the command line (`PATH=VALUE`), checks everything, and builds the grid, the
/// component and the analysis modules. If the scene does not specify patches, the grid gets as many as `workers` need.
/// Throws one InputError with all problems of the scene. Writes no files.
simulation::Problem readScene(const std::string& path, const std::vector<std::string>& overrides,
                              const simulation::Catalogue& catalogue, const grid::Workers& workers = {},
                              grid::Share share = {});

/// Writes the manual of the sections that all components share: Time, DataArchiver, Grid and AMR. The manual of AMR
/// includes the parts that belong to individual components.
void describeSharedSections(std::ostream& out, const simulation::Catalogue& catalogue);

/// Reads the `Time` section.
simulation::TimeSettings readTime(const input::Element& section, input::Diagnostics& diagnostics);
/// Reports an error at `element` if `interval` [s] is no longer than the resolution of the times of the run, unless it
/// is 0; `what` precedes the message.
void checkInterval(double interval, const simulation::TimeSettings& time, const input::Element& element,
                   const std::string& what, input::Diagnostics& diagnostics);
/// Reads the `DataArchiver` section.
simulation::ArchiveSettings readArchive(const input::Element& section, input::Diagnostics& diagnostics);
/// The `AMR` section, read before the grid is known.
struct AmrSettings {
  simulation::RegridSettings regrid;
  std::optional<int> maxLevels;               ///< number of levels, including the coarsest
  std::optional<Index3> block;                ///< number of cells of a block along x, y, z
  int fewestCellsOfBlock = 4;                 ///< smallest number of cells of a block along an axis in use; even
  std::optional<std::vector<Index3>> ratios;  ///< ratios of cell widths from level to level
  std::optional<input::Element> tag;          ///< the tag `AMR`, if given; used in messages
  std::optional<Location> smallerSteps;       ///< the tag that makes finer levels take smaller steps
};
/// Reads the `AMR` section. `kind` is the component of the scene; null if it is unknown.
AmrSettings readAmr(const input::Element& section, const simulation::ComponentKind* kind,
                    input::Diagnostics& diagnostics);
/// Determines when and where to refine the grid: by the criteria of the scene or, if it has none, by those of the
/// component. Reports criteria for variables that the component lacks.
simulation::RegridSettings settled(AmrSettings amr, const simulation::Component& component,
                                   input::Diagnostics& diagnostics);
/// Removes node variables from `saves`, with a note, because they are not defined between levels.
void dropSavedNodes(std::vector<simulation::SaveRequest>& saves, input::Diagnostics& diagnostics);
/// What a component supports as boundary conditions.
struct SideWords {
  std::vector<grid::BoundaryVariable> labels = {};
  bool takesParts = false;     ///< whether parts of a side may have their own conditions
  bool takesFormulas = false;  ///< whether Dirichlet values may be formulas
  simulation::ConditionWords own = {};
};
/// Reads the `Grid` section.
grid::Domain readGrid(const input::Element& section, const SideWords& words, const grid::Workers& workers,
                      const AmrSettings& amr, input::Diagnostics& diagnostics);

void describeTime(std::ostream& out);
void describeArchive(std::ostream& out);
void describeGrid(std::ostream& out);
void describeAmr(std::ostream& out, const simulation::Catalogue& catalogue);

/// The schemas of the shared sections, for editors. The schema of Grid contains the boundary labels and words of a
/// component, and the schema of AMR its name.
const input::SchemaBase& metaForm();
const input::SchemaBase& timeForm();
const input::SchemaBase& archiveForm();
const input::SchemaBase& amrForm(const simulation::ComponentKind& kind);
const input::SchemaBase& gridForm(const simulation::ComponentKind& kind);
/// The schema of the tag SimulationComponent, whose `type` selects the component.
const input::SchemaBase& componentForm();

/// Uintah's sections that have no effect in Tushar, with the reasons.
const std::vector<std::pair<std::string, std::string>>& idleSections();

}  // namespace tushar::scene
