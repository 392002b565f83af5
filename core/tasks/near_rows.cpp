#include "core/tasks/near_rows.hpp"

#include <algorithm>

namespace tushar::tasks {

void NearRows::settle(data::Generation set, int material) {
  const auto [rows, isNew] = rows_.try_emplace({set, material});
  if (!isNew) return;
  const std::vector<grid::Patch>& patches = warehouse_->grid().patches();
  rows->second.resize(patches.size());
  std::vector<data::TouchedRows>& ofPatches = rows->second;
  threads_->forEach(
      static_cast<int>(patches.size()),
      [&](int place) {
        const std::size_t at = place;
        ofPatches[at] = rowsOf(set, material, patches[at]);
      },
      trace::Kind::message);
}

/// Whatever reads particles `reach` cells beyond the patch touches nodes reach - 1 beyond those of their cells.
data::TouchedRows NearRows::rowsOf(data::Generation set, int material, const grid::Patch& patch) const {
  const data::ParticleSet& particles = warehouse_->particles(set, material, patch.id());
  if (!particles.hasGhosts()) return data::TouchedRows::all(patch.nodes());
  const int ghost = std::max(warehouse_->table().reach(material) - 1, 0);
  return {particles, particles.cells(), ghost, patch.nodes(), warehouse_->grid().dimension()};
}

}  // namespace tushar::tasks
