#pragma once

#include <string>
#include <vector>

#include "core/grid/choose_patches.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::scene {

/// The work of one of many ranks in a step, and the cost of this estimate: graph and messages are compiled as in a run,
/// but no other rank is there and no variable has memory.
struct DryRun {
  int rank = 0, ranks = 1;
  int patches = 0, patchesOfAll = 0;  ///< of this rank, and of the grid
  int tasks = 0, placements = 0;      ///< of a step: kept, and times patches and materials
  int neighbours = 0;                 ///< ranks that it sends ghosts to
  int messages = 0;                   ///< with ghosts and with particles that move on, sent in a step
  int agreements = 0;                 ///< of all ranks, in a step
  double bytes = 0;                   ///< in them but for particles, at most: as if all nodes were near particles
  double seconds = 0;                 ///< of the processor, to read the scene and compile
  double megabytes = 0;               ///< of memory that this took
};

/// Reads a scene as that of `workers.ranks` ranks would that has the middle of the grid. Throws what readScene throws.
DryRun dryRun(const std::string& scene, const std::vector<std::string>& overrides,
              const simulation::Catalogue& catalogue, const grid::Workers& workers);

/// The result as lines for a terminal.
std::string toText(const DryRun& result);

}  // namespace tushar::scene
