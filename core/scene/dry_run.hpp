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
  int patches = 0, patchesOfAll = 0;  ///< of this rank, and of the grid
  int tasks = 0, placements = 0;      ///< of a step: tasks kept, and their runs over patches and materials
  int neighbours = 0;                 ///< ranks that it sends ghosts to
  int messages = 0;                   ///< sent in a step, with ghosts and with particles that move
  int agreements = 0;                 ///< of all ranks, in a step
  bool isAdaptive = false;            ///< criteria change the grid during the run, and this is the initial grid
  bool hasSmallerSteps = false;       ///< finer levels take several smaller steps, each with a ghost exchange
  double bytes = 0;                   ///< upper bound, without particles: computed as if all nodes were near particles
  double seconds = 0;                 ///< processor time to read the scene and compile
  double megabytes = 0;               ///< memory taken by this
};

/// Reads a scene as if this rank were the one of `workers.ranks` that owns the centre of the grid. Throws what
/// readScene throws.
DryRun dryRun(const std::string& scene, const std::vector<std::string>& overrides,
              const simulation::Catalogue& catalogue, const grid::Workers& workers);

/// The result as lines for a terminal.
std::string toText(const DryRun& result);

}  // namespace tushar::scene
