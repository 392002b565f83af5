#pragma once

#include "core/data/warehouse.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::collect {

/// The scope of a summary: the whole grid or, on a grid of one level, each plane of cells or nodes normal to a kernel
/// axis.
struct SummaryOver {
  int axis = -1;  ///< kernel axis normal to the planes that are summarised; -1 for the whole grid
};

/// Minimum, maximum and sum of each component: over all cells or nodes, or for each plane. On several levels, sums
/// weight a cell by its volume relative to a cell of the coarsest level.
struct Summary {
  output::Array least, greatest, sum;
};

/// Returns, on rank 0, the summary of a cell or node variable of a generation, and empty arrays on the other ranks. The
/// result is bitwise equal for all patches and ranks. Collective; ranks exchange only their own summaries.
Summary summaryOf(data::Warehouse& warehouse, data::Generation generation, int variable, SummaryOver over);

}  // namespace tushar::collect
