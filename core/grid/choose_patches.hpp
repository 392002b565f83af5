#pragma once

#include "core/base/vec.hpp"

namespace tushar::grid {

/// How to divide a grid of `cells` along x, y, z into about `count` patches: of all ways to make `count` to 1.25 `count`
/// of them, that with the least cells and ghost cells of all patches together, each as large as the largest. No more
/// patches along an axis than cells. Along x, where memory is contiguous, it is cut last.
Index3 choosePatches(const Index3& cells, int count);

/// How many patches are worth having for threads to share: one where there is one thread.
int usefulPatches(const Index3& cells, int threads);

/// How many threads are worth having for a grid, at most `most`: a thread with little to do costs more than it gains.
int usefulThreads(const Index3& cells, int most);

}  // namespace tushar::grid
