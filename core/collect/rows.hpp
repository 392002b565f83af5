#pragma once

#include "core/grid/box.hpp"

namespace tushar::collect {

/// Calls `visit(first cell or node)` for each row of a box along the first axis.
template <class Visit>
void forEachRow(const grid::Box& box, Visit&& visit) {
  grid::forEach<3>(box.rowStarts(), visit);
}

}  // namespace tushar::collect
