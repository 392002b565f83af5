#pragma once

#include <optional>
#include <string_view>

#include "core/base/vec.hpp"

namespace tushar::grid {

/// Smallest number of cells per thread for which an additional thread pays off.
inline constexpr int cellsPerThread = 8192;

/// The number of threads, from 1 to `most`, that pay off for `cells` cells if each thread needs at least
/// `cellsOfThread`.
int usefulThreads(double cells, int cellsOfThread, int most);

/// The ranks and threads that work on a grid.
struct Workers {
  int threads = 1;          ///< number of threads of each rank
  bool mayBeFewer = false;  ///< whether to use fewer threads if not all pay off
  int ranks = 1;
  std::optional<Index3> layout;  ///< patches along x, y, z; overrides the patches in the scene

  /// Number of threads of each rank for a grid of `cells` along x, y, z: a thread with too few cells costs more than it
  /// saves.
  int threadsFor(const Index3& cells) const;
  /// Number of patches with which the work is distributed evenly; 1 for a single worker.
  int patchesFor(const Index3& cells) const;
};

/// The division of a grid of `cells` along x, y, z into about `count` patches: of all divisions into `count` to 1.25
/// `count` patches, the cheapest one, assuming that each patch is as large as the largest: cells, ghost cells, and rows
/// of cells along x, where memory is contiguous, cost time. Never more patches along an axis than cells.
Index3 choosePatches(const Index3& cells, int count);

/// Parses a layout such as `4x2x1` (patches along x, y, z); returns none unless it consists of three positive integers.
std::optional<Index3> parseLayout(std::string_view text);

}  // namespace tushar::grid
