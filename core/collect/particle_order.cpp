#include "core/collect/particle_order.hpp"

#include <algorithm>
#include <numeric>

#include "core/collect/sums_before.hpp"

namespace tushar::collect {

using data::Generation;
using data::ParticleRange;
using grid::Patch;

ParticleOrder::ParticleOrder(data::Warehouse& warehouse, int material)
    : warehouse_(&warehouse), material_(material), order_(orderOfState(warehouse.grid(), false)) {
  findRows();
  const grid::Grid& grid = warehouse.grid();
  for (const Row& row : rows_) {
    const Patch& patch = grid.patches()[row.patch];
    if (!grid.isFinest(patch)) continue;
    const ParticleRange* ranges = warehouse.particles(Generation::old, material, patch.id()).row<3>(row.first);
    for (std::uint32_t k = 0; k < row.cells; ++k) counts_[row.patch][row.from + k] = std::int32_t{ranges[k].size()};
  }
  sum();
}

ParticleOrder::ParticleOrder(data::Warehouse& warehouse, int material,
                             const std::function<void(const std::vector<Wanted>&)>& read)
    : warehouse_(&warehouse), material_(material), order_(orderOfState(warehouse.grid(), false)) {
  findRows();
  std::vector<Wanted> wanted;
  for (const Row& row : rows_) wanted.push_back({row.place, row.cells, &counts_[row.patch][row.from]});
  read(wanted);
  sum();
}

void ParticleOrder::findRows() {
  const std::vector<Patch>& patches = warehouse_->grid().patches();
  for (std::uint32_t patch = 0; patch < patches.size(); ++patch) {
    const grid::Box& cells = patches[patch].cells();
    counts_.emplace_back(cells.size(), 0);
    std::uint32_t from = 0;
    collect::forEachRow(cells, [&](const Index3& first) {
      grid::Box row = cells;
      for (const int d : {1, 2}) {
        row.lower[d] = first[d];
        row.upper[d] = first[d] + 1;
      }
      order_.forEachRow(patches[patch].level().number(), row, [&](std::size_t place, const Index3& cell, int count) {
        rows_.push_back({place, 0, 0, static_cast<std::uint32_t>(count), patch, from, cell});
        from += static_cast<std::uint32_t>(count);
      });
    });
  }
}

/// Computes the position of the first particle of each row, which is the number of particles in all earlier rows.
void ParticleOrder::sum() {
  std::vector<std::uint32_t> order(rows_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return rows_[a].place < rows_[b].place; });
  std::vector<std::uint64_t> keys, weights;
  std::uint64_t mine = 0;
  for (const std::uint32_t k : order) {
    Row& row = rows_[k];
    const std::int32_t* first = counts_[row.patch].data() + row.from;
    row.particles = std::accumulate(first, first + row.cells, 0);
    keys.push_back(row.place);
    weights.push_back(row.particles);
    mine += row.particles;
  }
  const mpi::Communicator& ranks = warehouse_->ranks();
  const std::vector<std::uint64_t> starts = sumsBefore(ranks, keys, weights);
  for (std::size_t k = 0; k < order.size(); ++k) rows_[order[k]].start = starts[k];
  count_ = static_cast<std::size_t>(ranks.sum(static_cast<long>(mine)));
}

std::shared_ptr<const output::Source> ParticleOrder::perCell() const {
  auto runs = std::make_shared<Runs>();
  for (const Row& row : rows_) runs->push_back({row.place, row.patch, row.from, row.cells});
  std::sort(runs->begin(), runs->end(), [](const Run& a, const Run& b) { return a.place < b.place; });
  Parts parts;
  for (const auto& counts : counts_) parts.of.push_back({reinterpret_cast<const std::byte*>(counts.data()), 0});
  return sourceInRuns(std::move(runs), order_.size(), std::move(parts), EntryForm(sizeof(std::int32_t)));
}

Runs ParticleOrder::runs() const {
  Runs runs;
  std::uint32_t patch = 0, next = 0;
  for (const Row& row : rows_) {
    if (row.patch != patch) next = 0;
    patch = row.patch;
    if (row.particles > 0) runs.push_back({row.start, patch, next, row.particles});
    next += row.particles;
  }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.place < b.place; });
  return runs;
}

void ParticleOrder::install() {
  const grid::Grid& grid = warehouse_->grid();
  const auto setOf = [&](const Patch& patch) -> data::ParticleSet& {
    return warehouse_->particles(Generation::old, material_, patch.id());
  };
  for (const Patch& patch : grid.patches()) setOf(patch).reset(patch, warehouse_->table().reach(material_));
  std::vector<int> next(grid.patches().size(), 0);
  for (const Row& row : rows_) {
    const Patch& patch = grid.patches()[row.patch];
    if (!grid.isFinest(patch)) continue;
    Index3 cell = row.first;
    for (std::uint32_t k = 0; k < row.cells; ++k, ++cell[0]) {
      const int first = next[row.patch];
      next[row.patch] += counts_[row.patch][row.from + k];
      setOf(patch).put(cell, {first, next[row.patch]});
    }
  }
  for (std::size_t k = 0; k < next.size(); ++k)
    if (grid.isFinest(grid.patches()[k])) setOf(grid.patches()[k]).setOwned(next[k]);
  warehouse_->layOut(Generation::old, material_, Generation::old);
}

}  // namespace tushar::collect
