#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// Whether this rank has memory for a cell variable.
bool isHeld(data::Warehouse& warehouse, data::Generation generation, int variable);

/// The memory of a cell variable on a patch of this rank, including ghosts.
std::span<std::byte> valuesOn(data::Warehouse& warehouse, data::Generation generation, int variable,
                              const grid::Patch& patch);

/// Copies of the old values of cell variables on all levels except the coarsest. The constructor makes them, because
/// the step of the coarsest level overwrites the originals.
class KeptLevels {
 public:
  KeptLevels(data::Warehouse& warehouse, const std::vector<int>& variables);
  void restore() const;

 private:
  /// Calls `visit(memory)` for all kept values, always in the same order.
  template <class Visit>
  void forEach(const Visit& visit) const;

  data::Warehouse* warehouse_;
  std::vector<int> variables_;  ///< indices of the variables with old values
  std::vector<std::byte> kept_;
};

}  // namespace tushar::tasks
