#pragma once

#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/data/buffer_pool.hpp"
#include "core/data/joint_interpolation.hpp"
#include "core/data/label.hpp"
#include "core/data/particle_set.hpp"
#include "core/data/slots.hpp"
#include "core/grid/grid.hpp"

namespace tushar::mpi {
class Communicator;
}

namespace tushar::data {

/// Assigns an index to each variable of a run, so that the time loop never looks up a name.
class VariableTable {
 public:
  /// The index of a variable, assigned on first use.
  int number(const Label& label, int material);
  /// The index of a variable, or -1 if no task has named it.
  int find(std::string_view name, int material) const;
  const VariableName& operator[](int number) const { return names_[number]; }
  int size() const { return static_cast<int>(names_.size()); }

  /// Records that a task reads the variable with `ghost` layers of cells or nodes around its patch.
  void widen(int number, int ghost);
  /// The largest number of ghost layers with which any task reads a variable.
  int ghost(int number) const { return ghosts_[number]; }
  /// The largest number of ghost layers with which any task reads any particle variable of a material.
  int reach(int material) const { return material < static_cast<int>(reaches_.size()) ? reaches_[material] : 0; }

  /// Variables that are interpolated together between levels, by their indices.
  struct Joint {
    std::vector<int> variables;
    std::vector<const Label*> labels;
    std::shared_ptr<const JointInterpolation> how;
  };
  void join(std::shared_ptr<const JointInterpolation> how);
  const std::vector<Joint>& joints() const { return joints_; }
  /// Gives all variables of a joint the same number of ghost layers. Called when all lists are compiled.
  void widenJoints();

 private:
  static std::string key(std::string_view name, int material);
  std::vector<VariableName> names_;
  std::vector<int> ghosts_, reaches_;
  std::vector<Joint> joints_;
  std::unordered_map<std::string, int> numbers_;
};

/// The values of a variable on one patch.
struct Variable {
  std::byte* values = nullptr;
  grid::Box stored;   ///< for node and cell variables: the box in memory, including ghosts
  bool held = false;  ///< whether the variable has values
};

/// The cells or nodes of a patch, without ghosts.
inline grid::Box ownBox(const grid::Patch& patch, const Label& label) {
  return label.centring == Centring::node ? patch.nodes() : patch.cells();
}

/// The generation of a value. `old`: it belongs to the state at the start of the step, which `requiresOld` reads;
/// `fresh`: it is computed in the step.
enum class Generation { old, fresh };

/// Holds the variables and particle sets of this rank, in two generations.
///
/// A variable is one contiguous piece of memory, in which each patch of the rank has a slot. All particle variables of
/// a material that belong to the same generation of particle sets have the same layout. An index counted from the first
/// particle of one patch can therefore denote a particle of another patch, so that patches read ghosts from their own
/// rank without copying them. Several threads may use the contents of variables and sets at the same time, but must not
/// call other functions of the warehouse.
class Warehouse {
 public:
  /// A warehouse for a run on one rank.
  Warehouse(const grid::Grid& grid, VariableTable& table);
  /// A warehouse on several ranks. `ranks` are the ranks over which `grid` distributes its patches; they must outlive
  /// the warehouse.
  Warehouse(const grid::Grid& grid, VariableTable& table, const mpi::Communicator& ranks)
      : grid_(&grid), table_(&table), ranks_(&ranks) {}

  const grid::Grid& grid() const { return *grid_; }
  const VariableTable& table() const { return *table_; }
  int patches() const { return static_cast<int>(grid_->patches().size()); }
  /// The ranks that share the grid.
  const mpi::Communicator& ranks() const { return *ranks_; }

  /// Access to a variable on the patch with index `patch` on this rank; valid until the memory of the variable changes.
  Variable variable(Generation generation, int number, int patch);
  ParticleSet& particles(Generation generation, int material, int patch) {
    return state(generation).sets[place(material, patch)];
  }

  template <class R>
  R& reduction(int number) {
    return static_cast<TypedReduction<R>&>(slot(number)).reducer;
  }
  /// The contribution of a patch to a reduction.
  template <class R>
  R& partOfReduction(int number, int patch) {
    return static_cast<TypedReduction<R>&>(slot(number)).part(patch - grid_->firstPatch());
  }
  void resetReduction(int number);
  /// The slot of a reduction of any type. The first call makes it; several threads must not make this call at the same
  /// time.
  ReductionSlot& slot(int number);
  /// The values of a reduction; empty if no task has computed it.
  std::vector<double> reductionValues(int number) const;
  /// The bytes of the reducer of a reduction; empty if no task has computed the reduction.
  std::span<const std::byte> reductionBytes(int number) const;
  /// Restores the bytes of a reduction from an earlier run.
  void restoreReduction(int number, std::vector<std::byte> bytes);

  /// Makes space for all variables named so far, and for the particle sets of `materials` materials.
  void grow(int materials);
  /// Discards all values on patches, and switches to the patches that the grid now assigns to this rank; reductions are
  /// kept.
  void startAnew(int materials);
  /// Allocates a node or cell variable on all patches, with all ghosts that tasks read; filled with NaN in the dev
  /// preset.
  void allocateGrid(Generation generation, int number);
  /// Sets all values of a variable to 0.
  void clear(Generation generation, int number);
  /// Allocates the fluxes through the rims of all patches, and sets them to 0.
  void allocateRims(Generation generation, int number);
  /// Allocates a particle variable on all patches, in the slots of the sets of generation `set`; filled with NaN in the
  /// dev preset.
  void allocateParticles(Generation generation, int number, Generation set);
  /// Returns the memory of a variable to the pool.
  void free(Generation generation, int number);

  /// Assigns slots to the particle sets of a material once their particles are complete on all patches; keeps the slots
  /// of generation `base` if possible.
  void layOut(Generation generation, int material, Generation base);
  /// Moves a particle variable from the previous slots of the sets to those of generation `set`. Values in unchanged
  /// slots are kept; patches whose slots have changed get undefined values. If the variable gets new memory, returns
  /// the previous buffer, which the caller must release.
  Buffer follow(Generation generation, int number, Generation set);
  /// Gives a particle variable new memory, with the slots of the sets of generation `set`; returns the previous buffer,
  /// which the caller must release.
  Buffer renew(Generation generation, int number, Generation set);
  /// The memory of a variable; `slots` gives the positions of the patches in it.
  std::byte* memory(Generation generation, int number) { return storage(generation, number).memory.data(); }
  const SharedSlots& slots(Generation generation, int number) const;
  const SharedSlots& slotsOfSets(Generation generation, int material) { return layout(generation, material).slots; }
  /// The distance in memory from the first particle of one patch to that of another, counted in particles.
  int distance(Generation set, int material, int from, int to);
  /// Reserves the next `count` indices for ghost copies of a patch; returns the first, counted from the patch's first
  /// particle.
  int placeCopies(Generation set, int material, int patch, int count);
  /// Makes space for all ghost copies whose indices have been reserved; existing values are preserved.
  void reserveCopies(Generation generation, int number, Generation set);

  /// Lends memory for a short time; return it with takeBack.
  Buffer lend(std::size_t bytes) { return pool_.lend(bytes); }
  void takeBack(Buffer& buffer) { pool_.takeBack(buffer); }
  /// Returns unused memory to the system.
  void releaseFreeMemory();
  /// Starts a step: memory that the previous step never needed is returned to the system.
  void beginStep();

  /// Whether any rank has values of a variable. Collective.
  bool isHeld(Generation generation, int number);

  /// Makes the new values of a variable its old ones on every patch, and frees the previous old values.
  void makeOld(int number);
  void swapSets(int material);
  /// Removes the ghosts of all particle sets; the next exchange plans them again.
  void forgetGhosts();

  /// Number of memory allocations so far; variables that nothing reads are not allocated.
  std::size_t allocations() const { return pool_.allocations(); }

 private:
  /// The memory of a variable.
  struct Storage {
    Buffer memory;
    SharedSlots slots;
    bool held = false;
  };
  /// The slots for the particles of a material.
  struct Layout {
    SharedSlots slots;
    /// Number of ghost copies stored after the slots: now, and the largest number so far.
    std::size_t copies = 0, mostCopies = 0;
  };
  struct State {
    std::vector<Storage> storages;  ///< index: number of the variable
    std::deque<ParticleSet> sets;   ///< indices: material, then patch
    std::vector<Layout> layouts;    ///< index: material
  };

  State& state(Generation generation) { return generation == Generation::old ? old_ : fresh_; }
  Storage& storage(Generation generation, int number) { return state(generation).storages[number]; }
  Layout& layout(Generation generation, int material) { return state(generation).layouts[material]; }
  std::size_t placeOf(int patch) const { return patch - grid_->firstPatch(); }
  std::size_t place(int number, int patch) const {
    return static_cast<std::size_t>(number) * grid_->patches().size() + placeOf(patch);
  }
  void allocate(Storage& storage, const Label& label, const SharedSlots& slots, std::size_t values);
  std::size_t valuesWithCopies(const Layout& layout, int number) const;
  void takeRestored(int number);

  const grid::Grid* grid_;
  VariableTable* table_;
  const mpi::Communicator* ranks_;
  State old_, fresh_;
  std::map<std::pair<Centring, int>, SharedSlots> grid_slots_;  ///< slots for each centring and number of ghost layers
  std::vector<std::unique_ptr<ReductionSlot>> reductions_;
  std::unordered_map<int, std::vector<std::byte>> restored_;  ///< restored reductions that no task has named yet
  BufferPool pool_;
};

}  // namespace tushar::data
