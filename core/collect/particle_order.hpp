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

/// The order (cell, id) of the old particles of a material over the whole grid, which is the same for every layout, and
/// the places of this rank's patches in it. Cells come with the first axis fastest; if there are several levels, block
/// by block. A rank stores the counts of its own cells alone.
class ParticleOrder {
 public:
  /// Orders the particles in the warehouses of all ranks. Collective.
  ParticleOrder(data::Warehouse& warehouse, int material);

  /// A request for the numbers of particles in `count` consecutive cells, from a place in the order of all cells.
  struct Wanted {
    std::size_t first, count;
    std::int32_t* to;
  };
  /// Gets the number of particles in each cell from `read`, which is called once. Collective.
  ParticleOrder(data::Warehouse& warehouse, int material, const std::function<void(const std::vector<Wanted>&)>& read);

  /// Number of particles of all ranks.
  std::size_t count() const { return count_; }
  /// The number of particles in each cell of the grid, in the order of the cells; valid as long as this object exists.
  std::shared_ptr<const output::Source> perCell() const;
  /// Assigns its particles to each patch, without their values.
  void install();
  /// The rows of cells with particles in the patches of this rank.
  Runs runs() const;

 private:
  /// Cells of a row that are consecutive in the order.
  struct Row {
    std::size_t place;    ///< place of the first cell in the order of the cells
    std::uint64_t start;  ///< place of its first particle in the order of the particles
    std::uint32_t particles, cells;
    std::uint32_t patch;  ///< index of the patch on this rank
    std::uint32_t from;   ///< place of the first cell among the counts of the patch
    Index3 first;         ///< cell
  };

  void findRows();
  void sum();

  data::Warehouse* warehouse_;
  int material_;
  GridOrder order_;
  std::vector<Row> rows_;                          ///< patch by patch, row by row, from left to right
  std::vector<std::vector<std::int32_t>> counts_;  ///< by patch: particles in each cell, in the order of the rows
  std::size_t count_ = 0;
};

}  // namespace tushar::collect
