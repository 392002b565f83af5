#pragma once

#include "core/output/archive_hdf5.hpp"
#include "core/output/archive_hdf5_input.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::output {

/// Writes the boxes of a level of several boxes as a dataset, /grid/inside: for each its lower and its upper corner x,
/// y, z. Writes nothing for other grids.
void writeInside(Hdf5File& file, const GridInfo& grid);
/// Whether a file has the same boxes as a grid.
bool hasSameInside(const Hdf5Input& file, const GridInfo& grid);

}  // namespace tushar::output
