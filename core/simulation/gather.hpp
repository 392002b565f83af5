#pragma once

#include <string>
#include <vector>

#include "core/data/warehouse.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::simulation {

/// The values of a variable of a generation over the whole grid, in an order that no layout changes: particles by id,
/// nodes and cells with x fastest. Vectors come out in x, y, z. Empty if the variable is not held, and on every rank but
/// the first; all ranks ask.
output::Array gatherArray(data::Warehouse& warehouse, data::Generation generation, int variable);

/// The geometry of the grid as the archive keeps it.
output::GridInfo gridInfo(const grid::Level& level);

/// Hash of the old values of the named variables of all materials, in the order above: 16 hexadecimal digits.
/// Two runs agree in it only if they agree in every bit. The first rank has it; all ask.
std::string fingerprint(data::Warehouse& warehouse, const std::vector<std::string>& labels, int materials);

/// Number of particles of all materials, on all ranks, which all ask.
long particleCount(data::Warehouse& warehouse, int materials);

}  // namespace tushar::simulation
