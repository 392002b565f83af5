#pragma once

#include <string>
#include <vector>

#include "core/data/warehouse.hpp"
#include "core/output/archive_hdf5.hpp"
#include "core/output/archive_hdf5_input.hpp"

namespace tushar::collect {

/// The variables of a state: those with these names, without a material and for each of these materials.
struct StateNames {
  std::vector<std::string> labels, materials;
};

/// Writes the old values of the variables to the last bit, in an order that no layout changes: nodes and cells with x
/// fastest, particles by (cell, id). Variables that are not held are left out. Rank 0 has the file, and all
/// call this; the others hand over null.
///
///     /particles/<material>/perCell    number of particles of each cell
///     /particles/<material>/<label>    shape: particles × components along the axes in use
///     /cells/[<material>/]<label>, /nodes/…    shape: z × y × x × components
///     /reductions/<label>              the reducer's bytes, eight to a number
void writeState(output::Hdf5File* file, data::Warehouse& warehouse, const StateNames& names);

/// Makes what writeState wrote the old values, on whatever patches the warehouse has. Throws InputError for a variable
/// of `required` that the file lacks or has in another form, or that has another number of values.
void readState(const output::Hdf5Input& file, data::Warehouse& warehouse, const StateNames& names,
               const std::vector<std::string>& required);

}  // namespace tushar::collect
