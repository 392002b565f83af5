#pragma once

#include <optional>
#include <string_view>

#include "core/base/vec.hpp"

namespace tushar::grid {

inline constexpr int cellsPerThread = 8192;  ///< with fewer cells, an additional thread does not pay off

/// How many threads, from 1 to `most`, pay off for a number of cells.
int usefulThreads(double cells, int cellsOfThread, int most);

/// The ranks and threads that work on a grid.
struct Workers {
  int threads = 1;          ///< number of threads of each rank
  bool mayBeFewer = false;  ///< whether to use only as many threads as pay off
  int ranks = 1;
  std::optional<Index3> layout;  ///< patches along x, y, z; overrides those of the scene

  /// Number of threads of each rank for a grid of `cells` along x, y, z: a thread with too few cells costs more than it
  /// saves.
  int threadsFor(const Index3& cells) const;
  /// Number of patches that share the work evenly: one if there is one worker.
  int patchesFor(const Index3& cells) const;
};

/// The division of a grid of `cells` along x, y, z into about `count` patches: of all divisions into `count` to 1.25
/// `count` patches, the one with the fewest cells and ghost cells in total, if each patch is as large as the largest.
/// No more patches along an axis than cells. Along x, where memory is contiguous, it is cut last.
Index3 choosePatches(const Index3& cells, int count);

/// Parses a layout such as `4x2x1`, patches along x, y, z; none unless it is three positive integers.
std::optional<Index3> parseLayout(std::string_view text);

}  // namespace tushar::grid
