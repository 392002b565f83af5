#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/base/threads.hpp"
#include "core/data/touched_rows.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// Finds the nodes of this rank's patches that are near particles. Variables with data::Counts::nearParticles are
/// defined only on these nodes, and patches exchange no others.
///
/// A patch that computes a node sees all particles that touch the node, so it can decide by itself whether there are
/// any. If the ghost particles of a patch have not been determined, all its nodes count as near.
class NearRows {
 public:
  NearRows(data::Warehouse& warehouse, Threads& threads) : warehouse_(&warehouse), threads_(&threads) {}

  /// Whether patches exchange only nodes near particles for a new variable.
  bool concern(int variable) const {
    const auto [label, material] = warehouse_->table()[variable];
    return label->counts == data::Counts::nearParticles && material >= 0;
  }
  /// Finds the rows of all patches for the particles of a material, unless they have been found already.
  void settle(data::Generation set, int material);
  /// The rows of a patch, after they have been found.
  const data::TouchedRows& of(data::Generation set, int material, int patch) const {
    return *rows_.at({set, material})[patch - warehouse_->grid().firstPatch()];
  }
  /// Forgets all rows. Must be called when particles have been replaced or have moved.
  void forget() {
    rows_.clear();
    whole_.clear();
  }

 private:
  /// The rows near the particles of a patch or, if its ghosts have not been determined, `whole`, which is set to all
  /// rows.
  const data::TouchedRows& rowsOf(data::Generation set, int material, const grid::Patch& patch,
                                  data::TouchedRows& whole) const;

  data::Warehouse* warehouse_;
  Threads* threads_;
  /// Rows of each patch, for each generation and material.
  std::map<std::pair<data::Generation, int>, std::vector<const data::TouchedRows*>> rows_;
  std::vector<data::TouchedRows> whole_;  ///< all nodes of each patch, if needed
};

}  // namespace tushar::tasks
