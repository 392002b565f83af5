#pragma once

#include <string>
#include <vector>

#include "core/grid/choose_patches.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::scene {

/// An estimate of the work of one of many ranks in a step, and the cost of this estimate. Task graphs and messages are
/// compiled as in a run, but the other ranks do not exist, and variables get no memory.
struct DryRun {
  int rank = 0, ranks = 1;
  int patches = 0, patchesOfAll = 0;  ///< number of patches of this rank, and of the whole grid
  /// In a step: number of tasks kept, and number of their calls on all patches and materials.
  int tasks = 0, placements = 0;
  int neighbours = 0;  ///< number of ranks to which it sends ghosts
  int messages = 0;    ///< number of messages sent in a step, with ghosts and with migrating particles
  int agreements = 0;  ///< number of collective operations of all ranks in a step
  /// Whether criteria change the grid during the run; the numbers then describe the initial grid.
  bool isAdaptive = false;
  bool hasSmallerSteps = false;  ///< whether finer levels take several smaller steps, each with a ghost exchange
  /// Upper bound on the memory of variables [bytes], without particles: computed as if all nodes were near particles.
  double bytes = 0;
  double seconds = 0;    ///< processor time spent reading the scene and compiling the graphs [s]
  double megabytes = 0;  ///< memory used for this estimate [MB]
};

/// Reads a scene as if there were `workers.ranks` ranks and this rank owned the centre of the grid. Throws the
/// exceptions of readScene.
DryRun dryRun(const std::string& scene, const std::vector<std::string>& overrides,
              const simulation::Catalogue& catalogue, const grid::Workers& workers);

/// The result as lines for a terminal.
std::string toText(const DryRun& result);

}  // namespace tushar::scene
