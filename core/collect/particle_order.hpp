#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/collect/grid_order.hpp"
#include "core/collect/rows.hpp"
#include "core/collect/sources.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::collect {

/// Orders the old particles of a material over the whole grid by (cell, id), independently of the layout, and locates
/// the particles of this rank's patches in this order. Cells are ordered with the first axis fastest or, on several
/// levels, block by block. A rank stores only the counts of its own cells.
class ParticleOrder {
 public:
  /// Orders the particles in the warehouses of all ranks. Collective.
  ParticleOrder(data::Warehouse& warehouse, int material);

  /// A request for the numbers of particles in `count` consecutive cells, starting at position `first` in the order of
  /// all cells; they are written to `to`.
  struct Wanted {
    std::size_t first, count;
    std::int32_t* to;
  };
  /// Obtains the number of particles in each cell from `read`, which is called once. Collective.
  ParticleOrder(data::Warehouse& warehouse, int material, const std::function<void(const std::vector<Wanted>&)>& read);

  /// Number of particles on all ranks.
  std::size_t count() const { return count_; }
  /// The number of particles in each cell of the grid, in cell order; valid as long as this object exists.
  std::shared_ptr<const output::Source> perCell() const;
  /// Creates the particle sets of all patches, without values.
  void install();
  /// The runs of particles in the patches of this rank.
  Runs runs() const;

 private:
  /// Cells of a row that are consecutive in the cell order.
  struct Row {
    std::size_t place;    ///< position of the first cell in the cell order
    std::uint64_t start;  ///< position of the row's first particle in the particle order
    std::uint32_t particles, cells;
    std::uint32_t patch;  ///< index of the patch on this rank
    std::uint32_t from;   ///< position of the first cell in the patch's list of counts
    Index3 first;         ///< index of the first cell
  };

  void findRows();
  void sum();

  data::Warehouse* warehouse_;
  int material_;
  GridOrder order_;
  std::vector<Row> rows_;  ///< sorted by patch, then by row, then from left to right
  /// For each patch, the number of particles in each cell, in the order of the rows.
  std::vector<std::vector<std::int32_t>> counts_;
  std::size_t count_ = 0;
};

}  // namespace tushar::collect
