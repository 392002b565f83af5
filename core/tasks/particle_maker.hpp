#pragma once

#include <memory>
#include <vector>

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

struct BoundAccess;

/// A column of a particle set under construction; `Column<T>::values` is what the task's body fills.
class ColumnBase {
 public:
  virtual ~ColumnBase() = default;
  virtual std::size_t size() const = 0;
  virtual const std::byte* bytes() const = 0;
};
template <class T>
class Column : public ColumnBase {
 public:
  std::vector<T> values;
  std::size_t size() const override { return values.size(); }
  const std::byte* bytes() const override { return reinterpret_cast<const std::byte*>(values.data()); }
};

/// Gathers the particles that a task makes on a patch; they may come in any order.
class ParticleMaker {
 public:
  explicit ParticleMaker(std::size_t accesses) : columns_(accesses) {}

  /// Announces a particle in a cell of the patch; each created label then needs one more value.
  template <int D>
  void add(const Index<D>& cell, ParticleId id) {
    Index3 wide;
    for (int d = 0; d < D; ++d) wide[d] = cell[d];
    cells_.push_back(wide);
    ids_.push_back(id);
  }

  /// Leaves the particles of the patch as they are; nothing else may have been added.
  void keepAll() { keeps_all_ = true; }

  /// The values of a created label.
  template <class T>
  std::vector<T>& column(int access) {
    auto& column = columns_[static_cast<std::size_t>(access)];
    if (!column) column = std::make_unique<Column<T>>();
    return static_cast<Column<T>&>(*column).values;
  }

  /// Makes these the new particles of the patch, sorted by (cell, id), and forgets their values. The variables `unread`
  /// get none.
  /// Throws data::AccessError for a particle outside the patch, or a column of another length.
  void install(data::Warehouse& warehouse, const grid::Patch& patch, int material,
               const std::vector<BoundAccess>& accesses, const std::vector<int>& unread);

 private:
  std::vector<std::size_t> sortedOrder(const grid::Patch& patch) const;
  void makeSet(data::ParticleSet& set, const grid::Patch& patch, int reach, const std::vector<std::size_t>& order) const;

  bool keeps_all_ = false;
  std::vector<Index3> cells_;
  std::vector<ParticleId> ids_;
  std::vector<std::unique_ptr<ColumnBase>> columns_;  ///< by access
};

}  // namespace tushar::tasks
