#include "core/tasks/particle_maker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/data/views.hpp"
#include "core/tasks/context.hpp"

namespace tushar::tasks {

using data::Generation;

std::vector<std::size_t> ParticleMaker::sortedOrder(const grid::Patch& patch) const {
  std::vector<std::size_t> offsets(ids_.size()), order(ids_.size());
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    if (!patch.cells().contains(cells_[k]))
      throw data::AccessError(fmt::format("particle {} was made outside the patch", ids_[k]));
    offsets[k] = patch.cells().offset(cells_[k]);
  }
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return offsets[a] != offsets[b] ? offsets[a] < offsets[b] : ids_[a] < ids_[b];
  });
  return order;
}

void ParticleMaker::makeSet(data::ParticleSet& set, const grid::Patch& patch, int reach,
                            const std::vector<std::size_t>& order) const {
  set.reset(patch, reach);
  std::size_t next = 0;
  grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
    const std::size_t first = next;
    while (next < order.size() && cells_[order[next]] == cell) ++next;
    set.at(cell) = {static_cast<int>(first), static_cast<int>(next)};
  });
  set.setOwned(static_cast<int>(next));
}

void ParticleMaker::install(data::Warehouse& warehouse, const grid::Patch& patch, int material,
                            const std::vector<BoundAccess>& accesses, const std::vector<int>& unread) {
  if (keeps_all_) return warehouse.particles(Generation::fresh, material, patch.id()).forgetGhosts();
  const std::vector<std::size_t> order = sortedOrder(patch);
  makeSet(warehouse.particles(Generation::fresh, material, patch.id()), patch, warehouse.table().reach(material), order);
  const auto write = [&](int number, const data::Label& label, const std::byte* values) {
    data::Variable& variable = warehouse.variable(Generation::fresh, number, patch.id());
    warehouse.allocateParticles(variable, label, static_cast<int>(order.size()));
    for (std::size_t k = 0; k < order.size(); ++k)
      std::memcpy(variable.values.data() + k * label.bytes, values + order[k] * label.bytes, label.bytes);
  };
  for (std::size_t a = 0; a < columns_.size(); ++a) {
    if (!columns_[a]) continue;
    const data::Label& label = *warehouse.table()[accesses[a].variable].label;
    if (columns_[a]->size() != ids_.size())
      throw data::AccessError(
          fmt::format("{} got {} values for {} particles made", label.name, columns_[a]->size(), ids_.size()));
    if (std::find(unread.begin(), unread.end(), accesses[a].variable) == unread.end())
      write(accesses[a].variable, label, columns_[a]->bytes());
    columns_[a].reset();
  }
  write(warehouse.table().find(data::particleId.name, material), data::particleId,
        reinterpret_cast<const std::byte*>(ids_.data()));
}

}  // namespace tushar::tasks
