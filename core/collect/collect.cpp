#include "core/collect/collect.hpp"

namespace tushar::collect {

using data::Generation;
using data::Variable;
using grid::Patch;

Parts collectParticles(data::Warehouse& warehouse, Generation generation, int variable) {
  const int material = warehouse.table()[variable].material;
  Parts parts;
  for (const Patch& patch : warehouse.grid().patches()) {
    const int owned = warehouse.particles(Generation::old, material, patch.id()).owned();
    parts.of.push_back({warehouse.variable(generation, variable, patch.id()).values, static_cast<std::size_t>(owned)});
  }
  return parts;
}

Parts collectGrid(data::Warehouse& warehouse, Generation generation, int variable) {
  Parts parts;
  for (const Patch& patch : warehouse.grid().patches()) {
    const Variable own = warehouse.variable(generation, variable, patch.id());
    parts.of.push_back({own.values, 0, own.stored});
  }
  return parts;
}

}  // namespace tushar::collect
