#include "core/collect/particle_order.hpp"

#include <algorithm>
#include <cstring>

#include "core/collect/collect.hpp"

namespace tushar::collect {

using data::Generation;
using data::ParticleRange;
using grid::Patch;

ParticleOrder::ParticleOrder(data::Warehouse& warehouse, int material)
    : warehouse_(&warehouse), material_(material), order_(orderOfState(warehouse.grid(), false)) {
  const grid::Grid& grid = warehouse.grid();
  std::vector<std::int32_t> perCell(warehouse.ranks().isFirst() ? order_.size() : 0);
  const auto countsOf = [&](const Patch& patch, auto&& take) {
    if (!grid.isFinest(patch)) return;
    const data::ParticleSet& set = warehouse.particles(Generation::old, material, patch.id());
    forEachRowPiece(patch, [&](std::size_t place, const Index3& first, int cells) {
      const ParticleRange* row = set.row(first);
      for (int k = 0; k < cells; ++k) take(place + static_cast<std::size_t>(k), std::int32_t{row[k].size()});
    });
  };
  collect(
      warehouse,
      [&](const Patch& patch) {
        countsOf(patch, [&](std::size_t place, std::int32_t count) { perCell[place] = count; });
      },
      [&](const Patch& patch, mpi::Bytes& bytes) {
        countsOf(patch, [&](std::size_t, std::int32_t count) { mpi::append(bytes, &count, sizeof(count)); });
      },
      [&](const Patch& patch, const std::byte* from) -> std::size_t {
        std::size_t read = 0;
        if (!grid.isFinest(patch)) return read;
        forEachRowPiece(patch, [&](std::size_t place, const Index3&, int cells) {
          const std::size_t length = static_cast<std::size_t>(cells) * sizeof(std::int32_t);
          std::memcpy(&perCell[place], from + read, length);
          read += length;
        });
        return read;
      });
  if (!perCell.empty()) sum(perCell);
}

ParticleOrder::ParticleOrder(data::Warehouse& warehouse, int material, const std::vector<std::int32_t>& perCell)
    : warehouse_(&warehouse), material_(material), order_(orderOfState(warehouse.grid(), false)) {
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
    forEachPiece(patch, [&](const std::size_t* start, const Index3&, int cells) {
      const std::size_t count = start[cells] - start[0];
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
    forEachPiece(patch, [&](const std::size_t* start, const Index3& first, int cells) {
      ParticleRange* row = set.row(first);
      for (int k = 0; k < cells; ++k) {
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
