#pragma once

#include <memory>
#include <vector>

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// A column of a particle set under construction; the task's body fills `Column<T>::values`.
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

  /// Adds a particle in a cell of the patch; each created label then needs one more value. No other particle of the
  /// material may have the same `id`, on any patch: outputs and fingerprints refuse them with a TaskError.
  template <int D>
  void add(const Index<D>& cell, ParticleId id) {
    Index3 wide;
    for (int d = 0; d < D; ++d) wide[d] = cell[d];
    cells_.push_back(wide);
    ids_.push_back(id);
  }

  /// Makes space for the cells and ids of `count` particles.
  void reserve(std::size_t count) {
    cells_.reserve(count);
    ids_.reserve(count);
  }

  /// Keeps the particles of the patch unchanged; only if no particle has been added. For this, as for keep, the task
  /// must read all labels that it creates.
  void keepAll() { keeps_all_ = true; }
  /// Keeps the particles of the patch with indices from `first` up to but excluding `last`, with their values of all
  /// created labels. Particles must be kept in the order of their indices; all others are removed.
  void keep(int first, int last) {
    if (first < last) kept_.push_back({first, last});
  }

  /// The values of a created label.
  template <class T>
  std::vector<T>& column(int access) {
    auto& column = columns_[access];
    if (!column) column = std::make_unique<Column<T>>();
    return static_cast<Column<T>&>(*column).values;
  }

  bool keepsAll() const { return keeps_all_; }
  /// Whether some of the patch's particles are kept beside those that have been added.
  bool keepsSome() const { return !kept_.empty(); }
  /// Installs the particles as those of the patch, sorted by (cell, id). If particles are kept, `set` contains them,
  /// and `ids` are those of all its particles. Throws data::AccessError for a particle outside the patch.
  void makeSet(data::ParticleSet& set, const grid::Patch& patch, int reach, const ParticleId* ids = nullptr);
  /// Whether there are values for a created label.
  bool creates(std::size_t access) const { return columns_[access] != nullptr || keepsSome(); }
  /// Writes the values of a created label in the order of the set, and discards them. Those of particles that are kept
  /// are at `before`, which may be the same memory. Throws data::AccessError for a column of another length.
  void write(std::size_t access, const data::Label& label, const std::byte* before, std::byte* to);
  void writeIds(const ParticleId* before, ParticleId* to) const;
  /// Checks the number of values of a label that nothing reads, and discards them.
  void drop(std::size_t access, const data::Label& label);

 private:
  std::vector<std::size_t> sortedOrder(const grid::Patch& patch) const;
  /// The index in the order of addition of the k-th particle in the order of the set.
  std::size_t addedAt(std::size_t k) const { return order_.empty() ? k : order_[k]; }
  void makeSetOfAdded(data::ParticleSet& set, const grid::Patch& patch, int reach) const;
  /// Like makeSet, if particles are kept.
  void mergeSet(data::ParticleSet& set, const grid::Patch& patch, int reach, const ParticleId* ids);
  void check(std::size_t access, const data::Label& label) const;
  /// Writes values: those of particles that are kept are at `before`, those of added ones at `added`.
  void writeValues(const std::byte* before, const std::byte* added, std::size_t bytes, std::byte* to) const;

  /// Kept particles that are consecutive before and after: `count` of them move from index `from` to index `to`.
  struct Run {
    int to, from, count;
  };
  class Merge;

  bool keeps_all_ = false;
  std::vector<data::ParticleRange> kept_;  ///< ascending
  std::vector<Run> runs_;                  ///< where particles that are kept go; ascending
  std::vector<int> places_;  ///< indices of added particles in the set, in the order of the set, if others are kept
  std::vector<Index3> cells_;
  std::vector<ParticleId> ids_;
  /// For each index in the set, the index in the order of addition; empty if they are the same.
  std::vector<std::size_t> order_;
  std::vector<std::unique_ptr<ColumnBase>> columns_;  ///< columns of values, by access
};

}  // namespace tushar::tasks
