#pragma once

#include "core/grid/box.hpp"

namespace tushar::simulation {

/// Calls `visit(first cell or node)` for each row of a box along the first axis.
template <class Visit>
void forEachRow(grid::Box box, Visit&& visit) {
  if (box.empty()) return;
  box.upper[0] = box.lower[0] + 1;
  grid::forEach<3>(box, visit);
}

}  // namespace tushar::simulation
