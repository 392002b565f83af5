#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/input/schema.hpp"
#include "core/scene/scene.hpp"

namespace tushar::scene {

/// Largest number of cells that can be indexed by an int.
inline constexpr double mostCells = 2147483647.0;

/// The tag `Box`.
struct GridBox {
  std::string label;
  Vec3 lower = Vec3::Zero(), upper = Vec3::Ones();  ///< lower and upper corner [m]
  std::optional<Index3> resolution;                 ///< number of cells along x, y, z
  std::optional<Index3> patches;
  std::optional<int> autoPatch;
  Index3 extraCells{};
};

/// The tag `Level`.
struct LevelSection {
  std::vector<GridBox> boxes;
  std::optional<Vec3> spacing;  ///< cell width [m]
  Index3 periodic{};
};

const input::Schema<LevelSection>& levelSchema();

/// The number of cells of a box along x, y and z; `element` is the tag of the box.
Index3 resolutionOf(const GridBox& box, const LevelSection& level, const input::Element& element,
                    input::Diagnostics& diagnostics);

/// Reads the refinement of a grid into `domain`, which already contains the first Level except its patches. `levels`
/// are all Levels of the section `grid`, including the first.
void readRefinement(const input::Element& grid, const std::vector<LevelSection>& levels, const AmrSettings& amr,
                    grid::Domain& domain, input::Diagnostics& diagnostics);

}  // namespace tushar::scene
