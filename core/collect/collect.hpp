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

/// The locations in memory of the values of a variable on each patch of this rank, in the order of the patches. The
/// values stay in the warehouse; the locations are valid until the state changes.
struct Parts {
  std::vector<Part> of;
};

/// Locates the values of a particle variable; each patch has them in the order of its particles.
Parts collectParticles(data::Warehouse& warehouse, data::Generation generation, int variable);

/// Locates the values of a cell or node variable.
Parts collectGrid(data::Warehouse& warehouse, data::Generation generation, int variable);

}  // namespace tushar::collect
