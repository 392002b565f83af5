#pragma once

#include <memory>
#include <vector>

#include "core/data/reduction.hpp"
#include "core/data/views.hpp"
#include "core/data/warehouse.hpp"
#include "core/tasks/task.hpp"

namespace tushar::tasks {

/// A declared access of a placed task: which variable, and where its particles stand.
struct BoundAccess {
  int variable = -1;
  data::Generation generation = data::Generation::fresh;
  data::Generation set = data::Generation::old;  ///< the particle set that the values follow
  int ghost = 0;
};

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

/// Gathers the particles that a task makes; they may come in any order.
class ParticleMaker {
 public:
  /// Announces a particle in a cell of the patch; each created label then needs one more value.
  template <int D>
  void add(const Index<D>& cell, ParticleId id) {
    Index3 wide;
    for (int d = 0; d < D; ++d) wide[d] = cell[d];
    cells.push_back(wide);
    ids.push_back(id);
  }

  std::vector<Index3> cells;
  std::vector<ParticleId> ids;
  std::vector<std::unique_ptr<ColumnBase>> columns;  ///< by access
};

/// Everything that a task's body may touch on one patch, for one material.
class TaskContext {
 public:
  TaskContext(data::Warehouse& warehouse, const grid::Patch& patch, int material,
              const std::vector<BoundAccess>& accesses, ParticleMaker* maker = nullptr)
      : warehouse_(&warehouse), patch_(&patch), material_(material), accesses_(&accesses), maker_(maker) {}

  const grid::Patch& patch() const { return *patch_; }
  int material() const { return material_; }
  ParticleMaker& maker() const { return *maker_; }

  template <class T>
  data::ParticleView<T> particles(int access, const data::Label& label) const {
    const BoundAccess& bound = (*accesses_)[static_cast<std::size_t>(access)];
    data::Variable& variable = warehouse_->variable(bound.generation, bound.variable, patch_->id());
    const data::ParticleSet& set = warehouse_->particles(bound.set, material_, patch_->id());
    const grid::Box cells = bound.ghost > 0 ? patch_->cellsWithin(bound.ghost) : patch_->cells();
    return {reinterpret_cast<T*>(variable.values.data()), set, cells, &label};
  }

  template <data::Centring C, class T>
  data::GridView<C, T> grid(int access, const data::Label& label) const {
    const BoundAccess& bound = (*accesses_)[static_cast<std::size_t>(access)];
    data::Variable& variable = warehouse_->variable(bound.generation, bound.variable, patch_->id());
    const grid::Box box = C == data::Centring::node ? patch_->nodesWithin(bound.ghost) : patch_->cellsWithin(bound.ghost);
    return {reinterpret_cast<T*>(variable.values.data()), variable.stored, box, &label};
  }

  template <class R>
  R& reduction(int access) const {
    return warehouse_->reduction<R>((*accesses_)[static_cast<std::size_t>(access)].variable);
  }

  template <class T>
  std::vector<T>& column(int access) const {
    auto& column = maker_->columns[static_cast<std::size_t>(access)];
    if (!column) column = std::make_unique<Column<T>>();
    return static_cast<Column<T>&>(*column).values;
  }

 private:
  data::Warehouse* warehouse_;
  const grid::Patch* patch_;
  int material_;
  const std::vector<BoundAccess>* accesses_;
  ParticleMaker* maker_;
};

}  // namespace tushar::tasks
