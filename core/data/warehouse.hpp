#pragma once

#include <deque>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/data/buffer_pool.hpp"
#include "core/data/label.hpp"
#include "core/data/particle_set.hpp"
#include "core/grid/level.hpp"

namespace tushar::mpi {
class Communicator;
}

namespace tushar::data {

/// A label of one material; `material` is -1 for variables that belong to none.
struct VariableName {
  const Label* label;
  int material;
};

/// Numbers the variables of a run, so that the time loop never looks up a name.
class VariableTable {
 public:
  /// The number of a variable, given on first use.
  int number(const Label& label, int material);
  /// The number, or -1 where no task ever named the variable.
  int find(std::string_view name, int material) const;
  const VariableName& operator[](int number) const { return names_[static_cast<std::size_t>(number)]; }
  int size() const { return static_cast<int>(names_.size()); }

  /// Some task reads the variable `ghost` cells or nodes beyond its patch.
  void widen(int number, int ghost);
  /// How far beyond its patch a variable is ever read.
  int ghost(int number) const { return ghosts_[static_cast<std::size_t>(number)]; }
  /// How far beyond its patch any particle variable of a material is ever read.
  int reach(int material) const {
    return material < static_cast<int>(reaches_.size()) ? reaches_[static_cast<std::size_t>(material)] : 0;
  }

 private:
  static std::string key(std::string_view name, int material);
  std::vector<VariableName> names_;
  std::vector<int> ghosts_, reaches_;
  std::unordered_map<std::string, int> numbers_;
};

/// The values of a variable on one patch.
struct Variable {
  Buffer values;
  grid::Box stored;   ///< of node and cell variables: the box in memory, ghosts included
  bool held = false;  ///< whether there are values
  int pool = 0;       ///< where its memory comes from: there is one for each patch
};

/// The cells or nodes that a patch has for itself.
inline grid::Box ownBox(const grid::Patch& patch, const Label& label) {
  return label.centring == Centring::node ? patch.nodes() : patch.cells();
}

/// What tasks read as `requiresOld`: the state at the start of the step. The rest is new.
enum class Generation { old, fresh };

/// Holds the variables and particle sets of this rank, in two generations.
///
/// Every address is stable once a variable has been named; `swap` exchanges contents, not addresses. Threads may allocate
/// and free at once on different patches.
class Warehouse {
 public:
  /// For one rank on its own.
  Warehouse(const grid::Level& level, VariableTable& table);
  /// `ranks` share the grid as the level says, and outlive the warehouse.
  Warehouse(const grid::Level& level, VariableTable& table, const mpi::Communicator& ranks)
      : level_(&level), table_(&table), ranks_(&ranks) {}

  const grid::Level& level() const { return *level_; }
  const VariableTable& table() const { return *table_; }
  int patches() const { return static_cast<int>(level_->patches().size()); }
  /// The ranks that share the grid.
  const mpi::Communicator& ranks() const { return *ranks_; }

  /// `patch` is the number of one of this rank's.
  Variable& variable(Generation generation, int number, int patch) {
    return (generation == Generation::old ? old_ : fresh_)[place(number, patch)];
  }
  ParticleSet& particles(Generation generation, int material, int patch) {
    return (generation == Generation::old ? old_sets_ : fresh_sets_)[place(material, patch)];
  }

  template <class R>
  R& reduction(int number) {
    return static_cast<TypedReduction<R>&>(slot(number)).reducer;
  }
  /// What a patch adds to a reduction.
  template <class R>
  R& partOfReduction(int number, int patch) {
    return static_cast<TypedReduction<R>&>(slot(number)).part(static_cast<std::size_t>(patch - level_->firstPatch()));
  }
  void resetReduction(int number);
  /// A reduction whatever its type; made on first use, which must not be by several threads at once.
  ReductionSlot& slot(int number);
  /// The values of a reduction; none if no task has computed it.
  std::vector<double> reductionValues(int number) const;
  /// The reducer as it lies in memory; nothing if no task has computed it.
  std::span<const std::byte> reductionBytes(int number) const;
  /// Gives a reduction the bytes that it had in another run.
  void restoreReduction(int number, std::vector<std::byte> bytes);

  /// Makes room for all variables named so far, and for the particle sets of `materials` materials.
  void grow(int materials);
  /// Forgets what stands on patches, for those that the level gives this rank now; reductions stay.
  void startAnew(int materials);
  /// Room for a node or cell variable of this number on a patch, with all ghosts that tasks read; NaN-filled in the dev
  /// preset.
  void allocateGrid(Variable& variable, int number, const grid::Patch& patch);
  /// Room for `count` particles; the first `keep` stay, the rest is NaN-filled in the dev preset.
  void allocateParticles(Variable& variable, const Label& label, int count, int keep = 0);
  /// Gives the memory of a variable back, for the next one that is allocated.
  void free(Variable& variable);

  /// Memory of a patch for a moment, which goes back by takeBack.
  Buffer lend(std::size_t bytes, const grid::Patch& patch) { return poolOf(patch).lend(bytes); }
  void takeBack(Buffer& buffer, const grid::Patch& patch) { poolOf(patch).takeBack(buffer); }
  /// Gives memory that no variable has back to the system.
  void releaseFreeMemory();

  /// Whether any rank has values of a variable; every rank asks.
  bool isHeld(Generation generation, int number);

  /// What was computed becomes old, and the memory of what was old is free, on every patch.
  void makeOld(int number);
  void swapSets(int material);
  /// No particle set has ghosts any more: the next exchange settles them anew.
  void forgetGhosts();

  /// Allocations made so far; a test shows that variables nobody reads add none.
  std::size_t allocations() const;

 private:
  std::size_t place(int number, int patch) const {
    return static_cast<std::size_t>(number) * level_->patches().size() +
           static_cast<std::size_t>(patch - level_->firstPatch());
  }
  BufferPool& poolOf(const grid::Patch& patch) {
    return pools_[static_cast<std::size_t>(patch.id() - level_->firstPatch())];
  }
  void takeRestored(int number);

  const grid::Level* level_;
  VariableTable* table_;
  const mpi::Communicator* ranks_;
  std::deque<Variable> old_, fresh_;
  std::deque<ParticleSet> old_sets_, fresh_sets_;
  std::vector<std::unique_ptr<ReductionSlot>> reductions_;
  std::unordered_map<int, std::vector<std::byte>> restored_;  ///< reductions that no task has named yet
  std::vector<BufferPool> pools_;  ///< by patch
};

}  // namespace tushar::data
