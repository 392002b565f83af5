#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

#include "core/data/label.hpp"
#include "core/data/particle_set.hpp"

namespace tushar::data {

#ifdef TUSHAR_CHECKS
inline constexpr bool checked = true;
#else
inline constexpr bool checked = false;
#endif

/// Exception for an index outside the declared range: a defect in the body of the task. Checked in the dev preset only.
class AccessError : public std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn]] void refuse(const Label* label, const Index3& index, const grid::Box& box);
[[noreturn]] void refuse(const Label* label, int particle, int count);

/// Sets `count` values to one value. Vectors and matrices of equal numbers are filled number by number, in the lanes of
/// registers.
template <class T, class Count>
void fillWith(T* values, Count count, const T& value) {
  if constexpr (requires { T::SizeAtCompileTime; }) {
    constexpr auto size = static_cast<std::size_t>(T::SizeAtCompileTime);
    static_assert(sizeof(T) == size * sizeof(double));
    const auto bits = [&](std::size_t at) { return std::bit_cast<std::uint64_t>(value.data()[at]); };
    bool areEqual = true;
    for (std::size_t k = 1; k < size; ++k) areEqual = areEqual && bits(k) == bits(0);
    if (areEqual && count > 0) {
      std::fill_n(values->data(), static_cast<std::size_t>(count) * size, value.data()[0]);
      return;
    }
  }
  std::fill_n(values, count, value);
}

/// A task's view of a particle variable: one T per particle of its patch and of the declared ghost cells. T is const if
/// the task may only read.
template <class T>
class ParticleView {
 public:
  ParticleView(T* values, const ParticleSet& set, const grid::Box& cells, const Label* label = nullptr)
      : values_(values), set_(&set), cells_(cells), label_(label) {}

  T& operator[](int particle) const {
    if constexpr (checked)
      if (!set_->covers(particle)) refuse(label_, particle, set_->owned());
    return values_[particle];
  }
  /// The cells whose particles may be used: those of the patch, and the declared ghost cells.
  const grid::Box& cells() const { return cells_; }
  /// The particles of a cell, in the order of their ids.
  template <int D>
  ParticleRange in(const Index<D>& cell) const {
    if constexpr (checked)
      if (!cells_.contains(cell)) refuse(label_, widened(cell), cells_);
    return set_->in(cell);
  }
  /// Calls `visit(cell, particles)` for the cells of a box that contain particles, in lexicographic order.
  template <int D>
  void forEachOccupied(const grid::Box& box, ParticleSet::VisitCell<D> visit) const {
    if constexpr (checked)
      if (!(box.intersect(cells_) == box)) refuse(label_, box.lower, cells_);
    set_->forEachOccupied<D>(box, visit);
  }
  /// Number of particles that the patch owns; they have the indices 0 to owned() - 1.
  int owned() const { return set_->owned(); }
  const ParticleSet& set() const { return *set_; }
  /// The address of the value with index 0; values of ghosts may precede it.
  T* values() const { return values_; }

 private:
  template <int D>
  static Index3 widened(const Index<D>& cell) {
    Index3 wide;
    for (int d = 0; d < D; ++d) wide[d] = cell[d];
    return wide;
  }

  T* values_;
  const ParticleSet* set_;
  grid::Box cells_;
  const Label* label_;
};

/// A task's view of a node or cell variable: one T per node or cell of `box()`, the first axis fastest.
template <Centring C, class T>
class GridView {
 public:
  /// `values` contains the box `stored`; the task may use `box`, which is inside it.
  GridView(T* values, const grid::Box& stored, const grid::Box& box, const Label* label = nullptr)
      : values_(values), stored_(stored), box_(box), label_(label) {
    stride_[0] = 1;
    stride_[1] = stored.extent(0);
    stride_[2] = stride_[1] * stored.extent(1);
  }
  GridView(T* values, const grid::Box& box) : GridView(values, box, box) {}

  template <int D>
  T& operator[](const Index<D>& index) const {
    if constexpr (checked) check(index);
    std::ptrdiff_t at = index[0] - stored_.lower[0];
    if constexpr (D > 1) at += (index[1] - stored_.lower[1]) * stride_[1];
    if constexpr (D > 2) at += (index[2] - stored_.lower[2]) * stride_[2];
    return values_[at];
  }
  const grid::Box& box() const { return box_; }
  const grid::Box& stored() const { return stored_; }
  /// The values on the box `stored`, the first axis fastest.
  T* values() const { return values_; }
  /// Sets all stored values to one value.
  void fill(const std::remove_const_t<T>& value) const { fillWith(values_, stored_.size(), value); }

 private:
  template <int D>
  void check(const Index<D>& index) const {
    if (box_.contains(index)) return;
    Index3 wide;
    for (int d = 0; d < D; ++d) wide[d] = index[d];
    refuse(label_, wide, box_);
  }

  T* values_;
  grid::Box stored_, box_;
  std::array<std::ptrdiff_t, 3> stride_{};
  const Label* label_;
};

template <class T>
using NodeView = GridView<Centring::node, T>;
template <class T>
using CellView = GridView<Centring::cell, T>;

}  // namespace tushar::data
