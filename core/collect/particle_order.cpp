#include "core/collect/particle_order.hpp"

#include <algorithm>
#include <cstring>

#include "core/collect/collect.hpp"

namespace tushar::collect {

using data::Generation;
using data::ParticleRange;
using grid::Patch;

ParticleOrder::ParticleOrder(data::Warehouse& warehouse, int material) : warehouse_(&warehouse), material_(material) {
  const grid::Grid& grid = warehouse.grid();
  const grid::Box& cells = grid.finest().cells();
  std::vector<std::int32_t> perCell(warehouse.ranks().isFirst() ? cells.size() : 0);
  const auto countsOf = [&](const Patch& patch, auto&& take) {
    if (!grid.isFinest(patch)) return;
    const data::ParticleSet& set = warehouse.particles(Generation::old, material, patch.id());
    grid::forEach<3>(patch.cells(), [&](const Index3& cell) { take(cell, std::int32_t{set.in(cell).size()}); });
  };
  collect(
      warehouse,
      [&](const Patch& patch) {
        countsOf(patch, [&](const Index3& cell, std::int32_t count) { perCell[cells.offset(cell)] = count; });
      },
      [&](const Patch& patch, mpi::Bytes& bytes) {
        countsOf(patch, [&](const Index3&, std::int32_t count) { mpi::append(bytes, &count, sizeof(count)); });
      },
      [&](const Patch& patch, const std::byte* from) -> std::size_t {
        if (!grid.isFinest(patch)) return 0;
        const std::size_t length = patch.cells().extent(0) * sizeof(std::int32_t);
        std::size_t read = 0;
        forEachRow(patch.cells(), [&](const Index3& first) {
          std::memcpy(&perCell[cells.offset(first)], from + read, length);
          read += length;
        });
        return read;
      });
  if (!perCell.empty()) sum(perCell);
}

ParticleOrder::ParticleOrder(data::Warehouse& warehouse, int material, const std::vector<std::int32_t>& perCell)
    : warehouse_(&warehouse), material_(material) {
  sum(perCell);
}

void ParticleOrder::sum(const std::vector<std::int32_t>& perCell) {
  starts_.assign(perCell.size() + 1, 0);
  for (std::size_t k = 0; k < perCell.size(); ++k) starts_[k + 1] = starts_[k] + static_cast<std::size_t>(perCell[k]);
}

std::vector<std::int32_t> ParticleOrder::perCell() const {
  std::vector<std::int32_t> counts(starts_.size() - 1);
  for (std::size_t k = 0; k < counts.size(); ++k) counts[k] = static_cast<std::int32_t>(starts_[k + 1] - starts_[k]);
  return counts;
}

Runs ParticleOrder::runs() const {
  const grid::Grid& grid = warehouse_->grid();
  Runs runs;
  for (int id = 0; id < grid.patchCount(); ++id) {
    const Patch patch = grid.patch(id);
    if (!grid.isFinest(patch)) continue;
    std::uint32_t next = 0;
    forEachRow(patch.cells(), [&](const Index3& first) {
      const std::size_t* start = startOf(first);
      const std::size_t count = start[patch.cells().extent(0)] - start[0];
      if (count > 0) runs.push_back({start[0], static_cast<std::uint32_t>(id), next});
      next += static_cast<std::uint32_t>(count);
    });
  }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.place < b.place; });
  return runs;
}

void ParticleOrder::install() {
  for (const Patch& patch : warehouse_->grid().patches()) {
    data::ParticleSet& set = warehouse_->particles(Generation::old, material_, patch.id());
    set.reset(patch, warehouse_->table().reach(material_));
    if (!warehouse_->grid().isFinest(patch)) continue;
    int next = 0;
    forEachRow(patch.cells(), [&](const Index3& first) {
      ParticleRange* row = set.row(first);
      const std::size_t* start = startOf(first);
      for (int k = 0; k < patch.cells().extent(0); ++k) {
        const int count = static_cast<int>(start[k + 1] - start[k]);
        row[k] = {next, next + count};
        next += count;
      }
    });
    set.setOwned(next);
  }
  warehouse_->layOut(Generation::old, material_, Generation::old);
}

}  // namespace tushar::collect
