#include "core/tasks/kept_levels.hpp"

#include <cstring>

namespace tushar::tasks {

using data::Generation;

bool isHeld(data::Warehouse& warehouse, Generation generation, int variable) {
  const grid::Grid& grid = warehouse.grid();
  return !grid.patches().empty() && warehouse.variable(generation, variable, grid.firstPatch()).held;
}

std::span<std::byte> valuesOn(data::Warehouse& warehouse, Generation generation, int variable,
                              const grid::Patch& patch) {
  const data::Variable found = warehouse.variable(generation, variable, patch.id());
  return {found.values, found.stored.size() * warehouse.table()[variable].label->bytes};
}

template <class Visit>
void KeptLevels::forEach(const Visit& visit) const {
  for (const int variable : variables_)
    for (const grid::Patch& patch : warehouse_->grid().patches())
      if (patch.level().number() > 0) visit(valuesOn(*warehouse_, Generation::old, variable, patch));
}

KeptLevels::KeptLevels(data::Warehouse& warehouse, const std::vector<int>& variables) : warehouse_(&warehouse) {
  for (const int variable : variables)
    if (isHeld(warehouse, Generation::old, variable)) variables_.push_back(variable);
  std::size_t bytes = 0;
  forEach([&](std::span<std::byte> values) { bytes += values.size(); });
  kept_.reserve(bytes);
  forEach([&](std::span<std::byte> values) { kept_.insert(kept_.end(), values.begin(), values.end()); });
}

void KeptLevels::restore() const {
  const std::byte* from = kept_.data();
  forEach([&](std::span<std::byte> values) {
    std::memcpy(values.data(), from, values.size());
    from += values.size();
  });
}

}  // namespace tushar::tasks
