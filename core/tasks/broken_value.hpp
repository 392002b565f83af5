#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// A variable that a task writes and whose values must satisfy the bound of its label.
struct Bounded {
  int variable;
  data::Generation set;  ///< the particle set to which the values belong after the task
};

/// Whether all values that a task has written on a patch satisfy their bounds.
bool keepsBounds(data::Warehouse& warehouse, const std::vector<Bounded>& written, const grid::Patch& patch);

/// The index in `written` of the first variable that violates its bound on some patch of this rank; the size of
/// `written` if none does. If a level is given, only its patches count.
std::size_t firstThatBreaks(data::Warehouse& warehouse, const std::vector<Bounded>& written, int level = -1);

/// A description of a value that violates its bound.
struct BrokenValue {
  std::string label;
  int patch;
  std::string
      sentence;  ///< value, bound, particle, cell, position, previous value, values around it, number of invalid values
};

/// Finds the first value that violates its bound among the values that a task has written, in the order of variables,
/// cells and ids, which does not depend on the layout. Returns none if all bounds hold. If a level is given, only its
/// patches count. Collective.
std::optional<BrokenValue> firstBroken(data::Warehouse& warehouse, const std::vector<Bounded>& written, int level = -1);

/// The first value of one variable that violates `bound`, which may differ from the bound of its label.
std::optional<BrokenValue> firstBroken(data::Warehouse& warehouse, const Bounded& written, data::Bound bound,
                                       int level = -1);

/// The name of a position: `cell (3, 4)`, or `node (3, 4)`.
std::string nameOf(const grid::Level& level, const Index3& at, const char* what = "cell");

}  // namespace tushar::tasks
