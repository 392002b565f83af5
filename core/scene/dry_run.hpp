#pragma once

#include <string>
#include <vector>

#include "core/grid/choose_patches.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::scene {

/// The work of one of many ranks in a step, and the cost of this estimate: graph and messages are compiled as in a run,
/// but without the other ranks and without memory for variables.
struct DryRun {
  int rank = 0, ranks = 1;
  int patches = 0, patchesOfAll = 0;  ///< number of patches of this rank, and of the grid
  int tasks = 0, placements = 0;      ///< per step: number of tasks, and of their runs over patches and materials
  int neighbours = 0;                 ///< number of ranks to which it sends ghosts
  int messages = 0;                   ///< number of messages sent per step, with ghosts or migrating particles
  int agreements = 0;                 ///< number of reductions over all ranks per step
  double bytes = 0;      ///< size of messages: an upper bound without particles, as if all nodes were near particles
  double seconds = 0;    ///< processor time to read the scene and compile
  double megabytes = 0;  ///< memory that this takes, MB
};

/// Reads a scene as if this rank were the one of `workers.ranks` that has the centre of the grid. Throws what readScene
/// throws.
DryRun dryRun(const std::string& scene, const std::vector<std::string>& overrides,
              const simulation::Catalogue& catalogue, const grid::Workers& workers);

/// The result as lines for a terminal.
std::string toText(const DryRun& result);

}  // namespace tushar::scene
