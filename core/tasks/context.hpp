#pragma once

#include <span>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/base/threads.hpp"
#include "core/data/reduction.hpp"
#include "core/data/rim_flux.hpp"
#include "core/data/views.hpp"
#include "core/data/warehouse.hpp"
#include "core/tasks/particle_maker.hpp"
#include "core/tasks/task.hpp"

namespace tushar::tasks {

/// A declared access of a placed task: its variable, and the particle set that determines where its values are.
struct BoundAccess {
  int variable = -1;  ///< index of the variable; -1 for an omitted offered output
  data::Generation generation = data::Generation::fresh;
  data::Generation set = data::Generation::old;  ///< the particle set to which the values belong
  int ghost = 0;
  bool own = false;  ///< for nodes: whether only those that the patch owns are written
};

/// Everything that a task body may access on one patch, for one material.
class TaskContext {
 public:
  TaskContext(data::Warehouse& warehouse, const grid::Patch& patch, int material,
              const std::vector<BoundAccess>& accesses, double time = 0, ParticleMaker* maker = nullptr)
      : warehouse_(&warehouse), patch_(&patch), material_(material), accesses_(&accesses), time_(time), maker_(maker) {}

  const grid::Patch& patch() const { return *patch_; }
  /// Time at the start of the step [s].
  double time() const { return time_; }
  int material() const { return material_; }
  ParticleMaker& maker() const { return *maker_; }
  /// For a task over all materials: the context of each material on the patch.
  std::span<const TaskContext> ofMaterials() const { return of_materials_; }
  void setMaterials(std::span<const TaskContext> contexts) { of_materials_ = contexts; }
  /// For a task that runs once per rank: the contexts of its patches, sorted by id.
  std::span<const TaskContext> ofPatches() const { return of_patches_; }
  void setPatches(std::span<const TaskContext> contexts) { of_patches_ = contexts; }
  /// For a task that runs once per rank: the ranks that run it together.
  const mpi::Communicator& ranks() const { return *ranks_; }
  void setRanks(const mpi::Communicator& ranks) { ranks_ = &ranks; }
  /// The same: the threads of this rank.
  Threads& threads() const { return *threads_; }
  void setThreads(Threads& threads) { threads_ = &threads; }

  /// Whether an offered output is to be computed.
  bool isWanted(int access) const { return (*accesses_)[access].variable >= 0; }

  template <class T>
  data::ParticleView<T> particles(int access, const data::Label& label) const {
    const ParticlePlace place = particlePlace(access);
    return {reinterpret_cast<T*>(place.values), *place.set, place.cells, &label};
  }

  /// The address of the values of an access, of any type.
  data::Variable variable(int access) const;
  /// The faces at which the patch meets patches of other levels.
  const std::vector<grid::RimPiece>& rims() const { return warehouse_->grid().rims(patch_->id()); }
  /// The cells of the patch that have faces to finer cells.
  std::vector<grid::Box> besideFiner() const {
    std::vector<grid::Box> boxes;
    for (const grid::RimPiece& piece : rims())
      if (piece.isFiner) boxes.push_back(piece.cells);
    return boxes;
  }
  /// The cells of the patch that regridding has just refined.
  const std::vector<grid::Box>& newCells() const { return warehouse_->grid().newCells(patch_->id()); }
  template <class T>
  data::RimFlux<T> flux(int access) const {
    return {reinterpret_cast<T*>(variable(access).values), rims()};
  }

  template <data::Centring C, class T>
  data::GridView<C, T> grid(int access, const data::Label& label) const {
    const GridPlace place = gridPlace(access, C);
    return {reinterpret_cast<T*>(place.values), place.stored, place.used, &label};
  }

  /// The current value of a reduction.
  template <class R>
  const R& reduction(int access) const {
    return warehouse_->reduction<R>((*accesses_)[access].variable);
  }
  /// This patch's contribution to a reduction.
  template <class R>
  R& partOfReduction(int access) const {
    return warehouse_->partOfReduction<R>((*accesses_)[access].variable, patch_->id());
  }

  template <class T>
  std::vector<T>& column(int access) const {
    return maker_->column<T>(access);
  }

 private:
  /// The parts of a view that do not depend on the type of its values: for particles, and for nodes or cells.
  struct ParticlePlace {
    std::byte* values;
    const data::ParticleSet* set;
    grid::Box cells;
  };
  struct GridPlace {
    std::byte* values;
    grid::Box stored, used;
  };
  ParticlePlace particlePlace(int access) const;
  GridPlace gridPlace(int access, data::Centring centring) const;

  data::Warehouse* warehouse_;
  const grid::Patch* patch_;
  int material_;
  const std::vector<BoundAccess>* accesses_;
  double time_;
  ParticleMaker* maker_;
  std::span<const TaskContext> of_materials_, of_patches_;
  const mpi::Communicator* ranks_ = &mpi::Communicator::alone();
  Threads* threads_ = nullptr;
};

}  // namespace tushar::tasks
