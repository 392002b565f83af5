#pragma once

#include <vector>

#include "core/collect/grid_order.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::collect {

/// The location in memory of the values of a variable on one patch.
struct Part {
  const std::byte* values = nullptr;
  std::size_t count = 0;  ///< number of particles
  grid::Box stored{};     ///< the box of cells or nodes in memory
};

/// The values of a variable on each patch of this rank, in the order of the patches. They stay in the warehouse,
/// and are valid until the state changes.
struct Parts {
  std::vector<Part> of;
};

/// The values of a particle variable, on each patch in the order of its particles.
Parts collectParticles(data::Warehouse& warehouse, data::Generation generation, int variable);

/// The values of a variable of cells or nodes.
Parts collectGrid(data::Warehouse& warehouse, data::Generation generation, int variable);

}  // namespace tushar::collect
