#pragma once

#include <cstdint>
#include <vector>

#include "core/collect/grid_order.hpp"
#include "core/collect/rows.hpp"
#include "core/collect/sources.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::collect {

/// The order (cell, id) of the old particles of a material over the whole grid, which no layout changes, and where each
/// patch has them. Cells come with the first axis fastest; where there are several levels, block by block.
class ParticleOrder {
 public:
  /// Orders the particles that the warehouses of all ranks hold; the order is on rank 0. Collective.
  ParticleOrder(data::Warehouse& warehouse, int material);
  /// Takes the number of particles in each cell of the grid, in the order of the cells.
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
    forEachPiece(patch, [&](const std::size_t* start, const Index3& first, int cells) {
      const std::size_t count = start[cells] - start[0];
      if (count > 0) visit(start[0], static_cast<std::size_t>(set.row(first)->first), count);
    });
  }

 private:
  /// Calls `visit(place of the first cell among all, first cell, count)` for the pieces of each row of cells of a patch
  /// that stand together in the order, row by row, from left to right.
  template <class Visit>
  void forEachRowPiece(const grid::Patch& patch, Visit&& visit) const {
    collect::forEachRow(patch.cells(), [&](const Index3& first) {
      grid::Box row = patch.cells();
      for (const int d : {1, 2}) {
        row.lower[d] = first[d];
        row.upper[d] = first[d] + 1;
      }
      order_.forEachRow(patch.level().number(), row, visit);
    });
  }
  /// As above, with the places where the particles of each of these cells start.
  template <class Visit>
  void forEachPiece(const grid::Patch& patch, Visit&& visit) const {
    forEachRowPiece(patch,
                    [&](std::size_t place, const Index3& first, int cells) { visit(&starts_[place], first, cells); });
  }
  void sum(const std::vector<std::int32_t>& perCell);

  data::Warehouse* warehouse_;
  int material_;
  GridOrder order_;
  std::vector<std::size_t> starts_{0};  ///< place of the first particle of each cell, then of the end
};

}  // namespace tushar::collect
