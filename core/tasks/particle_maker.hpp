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

  /// Keeps the particles of the patch unchanged; only if no particle has been added.
  void keepAll() { keeps_all_ = true; }

  /// The values of a created label.
  template <class T>
  std::vector<T>& column(int access) {
    auto& column = columns_[access];
    if (!column) column = std::make_unique<Column<T>>();
    return static_cast<Column<T>&>(*column).values;
  }

  bool keepsAll() const { return keeps_all_; }
  /// Installs the particles as those of the patch, sorted by (cell, id).
  /// Throws data::AccessError for a particle outside the patch.
  void makeSet(data::ParticleSet& set, const grid::Patch& patch, int reach);
  /// Whether there are values for a created label.
  bool creates(std::size_t access) const { return columns_[access] != nullptr; }
  /// Writes the values of a created label in the order of the set, and discards them. Throws data::AccessError for a
  /// column of another length.
  void write(std::size_t access, const data::Label& label, std::byte* to);
  void writeIds(ParticleId* to) const;
  /// Checks the number of values of a label that nothing reads, and discards them.
  void drop(std::size_t access, const data::Label& label);

 private:
  std::vector<std::size_t> sortedOrder(const grid::Patch& patch) const;
  void check(std::size_t access, const data::Label& label) const;

  bool keeps_all_ = false;
  std::vector<Index3> cells_;
  std::vector<ParticleId> ids_;
  /// For each index in the set, the index in the order of addition; empty if they are the same.
  std::vector<std::size_t> order_;
  std::vector<std::unique_ptr<ColumnBase>> columns_;  ///< columns of values, by access
};

}  // namespace tushar::tasks
