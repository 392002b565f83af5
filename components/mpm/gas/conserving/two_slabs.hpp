#pragma once

#include <optional>

#include "components/mpm/gas/conserving/grid_fields.hpp"

namespace tushar::mpm::gas::conserving {

/// N numbers at each node or cell of two adjacent slabs (rows in two dimensions, planes in three), while a loop visits
/// one slab after the other. A loop that reads vectors or tensors at all corners of a cell thus transposes each of them
/// into lanes once, not once per corner.
template <int D, std::size_t N, class Load>
class TwoSlabs {
 public:
  using Values = std::array<Lanes, N>;

  /// `load(part)` returns the values at the nodes or cells of a part of a row of `box`.
  TwoSlabs(const Box& box, const Load& load) : load_(load), box_(box), next_(box.lower[D - 1]) {
    if (D > 1) fields_.emplace(twoOf(box), false);
  }

  /// Prepares the slabs `slab` - 1 and `slab`, counted along the last axis; `slab` never decreases.
  void moveTo(int slab) {
    if constexpr (D > 1)
      for (; next_ <= slab; ++next_) {
        Box rows = box_;
        rows.lower[D - 1] = next_;
        rows.upper[D - 1] = next_ + 1;
        forEachRowPart<D>(rows, [&](const RowPart<D>& part) {
          const Values values = load_(part);
          for (std::size_t n = 0; n < N; ++n) fields_->writeRow(n, {placeOf(part.first), part.count}, values[n]);
        });
      }
  }
  /// The values at the nodes or cells of a part of a row.
  [[gnu::always_inline]] Values at(const RowPart<D>& part) const {
    if constexpr (D == 1) return load_(part);
    const Index<D> first = placeOf(part.first);
    Values values;
    for (std::size_t n = 0; n < N; ++n) values[n] = fields_->readRow(n, first);
    return values;
  }

 private:
  static Box twoOf(Box box) {
    box.lower[D - 1] = 0;
    box.upper[D - 1] = 2;
    return box;
  }
  static Index<D> placeOf(Index<D> index) {
    index[D - 1] &= 1;
    return index;
  }

  Load load_;
  Box box_;
  int next_;                                ///< the first slab that has not been loaded
  std::optional<GridFields<D, N>> fields_;  ///< none in one dimension
};

/// TwoSlabs of the vectors or tensors `load(part)`.
template <int D, int Columns, class Load>
auto twoSlabs(const Box& box, Load&& load) {
  const auto numbers = [load](const RowPart<D>& part) __attribute__((always_inline)) {
    return coefficientsOf<D, Columns>(load(part));
  };
  return TwoSlabs<D, std::size_t{D} * Columns, decltype(numbers)>(box, numbers);
}

}  // namespace tushar::mpm::gas::conserving
