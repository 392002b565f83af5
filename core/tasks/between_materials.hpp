#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// Moves particles of the old state to other materials, with the values of the variables in `carried`. A particle stays
/// in its cell and on its patch, so that nothing is sent to other ranks; particles of a cell remain sorted by id.
///
/// `destination` is a particle variable of whole numbers in the new state: the index of the material to which each
/// particle belongs from now on, below `materials`. The ids of particles that may share a material must be distinct.
/// Returns the number of particles of this rank that have moved. Throws data::AccessError for an index of no material,
/// and for a material that lacks a variable.
long moveBetweenMaterials(data::Warehouse& warehouse, int materials, std::string_view destination,
                          const std::vector<std::string>& carried);

}  // namespace tushar::tasks
