#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// Whether this rank has memory for a variable of cells.
bool isHeld(data::Warehouse& warehouse, data::Generation generation, int variable);

/// The memory of a variable of cells on a patch of this rank, ghosts included.
std::span<std::byte> valuesOn(data::Warehouse& warehouse, data::Generation generation, int variable,
                              const grid::Patch& patch);

/// The old values of variables of cells on all levels but the coarsest, as they were when it was made: those are
/// overwritten while the coarsest level still makes its step.
class KeptLevels {
 public:
  KeptLevels(data::Warehouse& warehouse, const std::vector<int>& variables);
  void restore() const;

 private:
  /// Calls `visit(memory)` for what is kept, always in the same order.
  template <class Visit>
  void forEach(const Visit& visit) const;

  data::Warehouse* warehouse_;
  std::vector<int> variables_;  ///< those that have old values
  std::vector<std::byte> kept_;
};

}  // namespace tushar::tasks
