#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// A variable that a task writes and whose numbers must keep the bound of its label.
struct Bounded {
  int variable;
  data::Generation set;  ///< the particle set that the values follow once the task is done
};

/// Whether all that a task has written on a patch keeps its bounds.
bool keepsBounds(data::Warehouse& warehouse, const std::vector<Bounded>& written, const grid::Patch& patch);

/// The place in `written` of the first variable that breaks its bound on some patch of this rank; their number if none
/// does. With a level only its patches count.
std::size_t firstThatBreaks(data::Warehouse& warehouse, const std::vector<Bounded>& written, int level = -1);

/// A value that breaks its bound, in words.
struct BrokenValue {
  std::string label;
  int patch;
  std::string sentence;  ///< value, bound, particle, cell, position, the value before, those around it, how many broke
};

/// The first value that a task wrote and that breaks its bound, in the order of variables, cells and ids: the same for
/// any patches and ranks. None if all bounds hold. With a level only its patches count. Collective.
std::optional<BrokenValue> firstBroken(data::Warehouse& warehouse, const std::vector<Bounded>& written, int level = -1);

/// The first value of one variable that breaks `bound`, which need not be that of its label.
std::optional<BrokenValue> firstBroken(data::Warehouse& warehouse, const Bounded& written, data::Bound bound,
                                       int level = -1);

/// `cell (3, 4)`, or `node (3, 4)`.
std::string nameOf(const grid::Level& level, const Index3& at, const char* what = "cell");

}  // namespace tushar::tasks
