#pragma once

#include <cstdint>
#include <vector>

#include "core/collect/rows.hpp"
#include "core/collect/sources.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::collect {

/// The order (cell, id) of the old particles of a material over the whole grid, which no layout changes, and where each
/// patch has them.
class ParticleOrder {
 public:
  /// Orders the particles that the warehouses of all ranks hold; the order is on rank 0. Collective.
  ParticleOrder(data::Warehouse& warehouse, int material);
  /// Takes the number of particles in each cell, the first axis fastest.
  ParticleOrder(data::Warehouse& warehouse, int material, const std::vector<std::int32_t>& perCell);

  /// Number of particles.
  std::size_t count() const { return starts_.back(); }
  std::vector<std::int32_t> perCell() const;
  /// Gives each patch its particles, without values.
  void install();
  /// The rows of cells that have particles, of all patches of the grid.
  Runs runs() const;
  /// Calls `visit(place in the order, place on the patch, count)` for each row of cells of a patch of this rank.
  template <class Visit>
  void forEachRun(const grid::Patch& patch, Visit&& visit) const {
    if (!warehouse_->grid().isFinest(patch)) return;
    const data::ParticleSet& set = warehouse_->particles(data::Generation::old, material_, patch.id());
    collect::forEachRow(patch.cells(), [&](const Index3& first) {
      const std::size_t* start = startOf(first);
      const std::size_t count = start[patch.cells().extent(0)] - start[0];
      if (count > 0) visit(start[0], static_cast<std::size_t>(set.row(first)->first), count);
    });
  }

 private:
  const std::size_t* startOf(const Index3& cell) const {
    return &starts_[warehouse_->grid().finest().cells().offset(cell)];
  }
  void sum(const std::vector<std::int32_t>& perCell);

  data::Warehouse* warehouse_;
  int material_;
  std::vector<std::size_t> starts_{0};  ///< place of the first particle of each cell, then of the end
};

}  // namespace tushar::collect
