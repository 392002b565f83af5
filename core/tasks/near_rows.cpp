#include "core/tasks/near_rows.hpp"

#include <algorithm>

namespace tushar::tasks {

void NearRows::settle(data::Generation set, int material) {
  const auto [rows, isNew] = rows_.try_emplace({set, material});
  if (!isNew) return;
  const std::vector<grid::Patch>& patches = warehouse_->grid().patches();
  rows->second.resize(patches.size());
  whole_.resize(patches.size());
  std::vector<const data::TouchedRows*>& ofPatches = rows->second;
  threads_->forEach(
      static_cast<int>(patches.size()),
      [&](int place) {
        const std::size_t at = place;
        ofPatches[at] = &rowsOf(set, material, patches[at], whole_[at]);
      },
      trace::Kind::message);
}

/// Returns the rows of nodes near particles. A task that reads particles `reach` cells beyond the patch touches nodes
/// up to reach - 1 cells beyond the nodes of the patch.
const data::TouchedRows& NearRows::rowsOf(data::Generation set, int material, const grid::Patch& patch,
                                          data::TouchedRows& whole) const {
  const data::ParticleSet& particles = warehouse_->particles(set, material, patch.id());
  if (particles.hasGhosts())
    return particles.touched(std::max(warehouse_->table().reach(material) - 1, 0), warehouse_->grid().dimension());
  whole = data::TouchedRows::all(patch.nodes());
  return whole;
}

}  // namespace tushar::tasks
