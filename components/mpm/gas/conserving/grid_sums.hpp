#pragma once

#include "components/mpm/gas/conserving/grid_fields.hpp"

namespace tushar::mpm::gas::conserving {

/// A sum and the accumulated rounding error of its additions.
template <class Number>
struct CarefulSum {
  Number sum, lost;

  void add(Number more) {
    data::addExactly(sum, more);
    lost += more;
  }
};

/// Exchanges one lane of two registers.
template <int Lane, int... All>
[[gnu::always_inline]] inline void exchangeLane(Lanes& a, Lanes& b, std::integer_sequence<int, All...>) {
  const Lanes::Register x = a.values(), y = b.values();
  a = Lanes(__builtin_shufflevector(x, y, (All == Lane ? Lanes::count + All : All)...));
  b = Lanes(__builtin_shufflevector(x, y, (All == Lane ? All : Lanes::count + All)...));
}
/// Exchanges the first `number` lanes of two registers.
template <int number, int... All>
[[gnu::always_inline]] inline void exchangeFirst(Lanes& a, Lanes& b, std::integer_sequence<int, All...>) {
  const Lanes::Register x = a.values(), y = b.values();
  a = Lanes(__builtin_shufflevector(x, y, (All < number ? Lanes::count + All : All)...));
  b = Lanes(__builtin_shufflevector(x, y, (All < number ? All : Lanes::count + All)...));
}

/// Sums of a row, and their rounding errors, in memory.
struct SumsInRow {
  double *sum, *lost;

  CarefulSum<Lanes> load(int at) const { return {Lanes::at(sum + at), Lanes::at(lost + at)}; }
  void store(const CarefulSum<Lanes>& values, int at) const {
    values.sum.copyTo(sum + at);
    values.lost.copyTo(lost + at);
  }
  /// Adds terms[k] of lane l to the sum k + l.
  ///
  /// A register of sums that start at 0 and one of those behind are loaded once. Before terms[k] is added to the first,
  /// both exchange lane k - 1, so that the sums k to k + lanes - 1 are in the first one, those beyond its end in its
  /// first lanes; so each term takes one addition, of a register that is rotated by k lanes.
  template <std::size_t K>
  [[gnu::always_inline]] void add(const std::array<Lanes, K>& terms) const {
    CarefulSum<Lanes> near = load(0);
    near.add(terms[0]);
    if constexpr (K > 1) {
      constexpr int wrapped = std::min(static_cast<int>(K) - 1, Lanes::count);
      CarefulSum<Lanes> far = load(Lanes::count);
      addWrapped<wrapped>(terms, near, far, std::make_integer_sequence<int, wrapped>());
      exchangeFirst<wrapped>(near.sum, far.sum, everyLane);
      exchangeFirst<wrapped>(near.lost, far.lost, everyLane);
      store(far, Lanes::count);
    }
    store(near, 0);
    for (std::size_t k = Lanes::count + 1; k < K; ++k) {  // beyond both registers, if these have few lanes
      CarefulSum<Lanes> beyond = load(static_cast<int>(k));
      beyond.add(terms[k]);
      store(beyond, static_cast<int>(k));
    }
  }

 private:
  static constexpr std::make_integer_sequence<int, Lanes::count> everyLane{};

  template <int wrapped, std::size_t K, int... Lane>
  [[gnu::always_inline]] static void addWrapped(const std::array<Lanes, K>& terms, CarefulSum<Lanes>& near,
                                                CarefulSum<Lanes>& far, std::integer_sequence<int, Lane...>) {
    const auto addNext = [&]<int lane>(std::integral_constant<int, lane>) __attribute__((always_inline)) {
      constexpr int k = lane + 1;
      exchangeLane<lane>(near.sum, far.sum, everyLane);
      exchangeLane<lane>(near.lost, far.lost, everyLane);
      const Lanes& term = terms[static_cast<std::size_t>(k)];
      near.add(window<Lanes::count - k>(term, term));
    };
    (addNext(std::integral_constant<int, Lane>()), ...);
  }
};

/// N sums over particles at the nodes (More = 1) or cells (More = 0) of a box of cells. Rounding errors are summed,
/// too, and are part of the sums that are read. So a sum does not depend on the order of the particles, which differs
/// in a mirror image, unless the sum lies within about 1e-32 of the midpoint of two floating-point numbers.
template <int D, std::size_t N, int More>
class GridSums : GridFields<D, 2 * N> {
  using Fields = GridFields<D, 2 * N>;

 public:
  using Brought = std::array<std::array<Lanes, Footprint<D>::places>, N>;

  explicit GridSums(const Box& cells) : Fields(cells) {}

  /// Adds terms to the nodes or cells of the footprints of a batch; lanes that are not in use must contribute 0.
  void add(const Footprint<D>& footprint, const Brought& brought) {
    footprint.withExtentOfRows([&](auto extent) {
      constexpr std::size_t count = static_cast<std::size_t>(extent.cells + More);
      const std::size_t first = this->place(footprint.first());
      for (std::size_t n = 0; n < N; ++n) addRows<D - 1, count>(rowAt(n, first), footprint, brought[n].data());
    });
  }
  /// The place of the first node or cell of a footprint in each field.
  std::size_t placeOf(const Footprint<D>& footprint) const { return this->place(footprint.first()); }
  using Fields::distance;
  /// The sums of a field from a place on.
  SumsInRow rowAt(std::size_t field, std::size_t place) {
    return {this->values(2 * field) + place, this->values(2 * field + 1) + place};
  }
  /// The sum at a node or cell.
  double at(std::size_t field, const Index<D>& index) const {
    return Fields::at(2 * field, index) + Fields::at(2 * field + 1, index);
  }
  /// The sums at a node or cell and its neighbours along the first axis.
  Lanes readRow(std::size_t field, const Index<D>& index) const {
    return Fields::readRow(2 * field, index) + Fields::readRow(2 * field + 1, index);
  }

 private:
  template <int Axis, std::size_t count>
  [[gnu::always_inline]] void addRows(const SumsInRow& row, const Footprint<D>& footprint, const Lanes* brought) const {
    if constexpr (Axis == 0) {
      std::array<Lanes, count> terms;
#pragma GCC unroll 8
      for (std::size_t k = 0; k < count; ++k) terms[k] = brought[k];
      row.add(terms);
    } else {
      const int end = footprint.along[Axis].cells + More;
      const std::ptrdiff_t stride = this->stride(Axis);
      for (int k = 0; k < end; ++k, brought += Footprint<D>::stride(Axis))
        addRows<Axis - 1, count>({row.sum + k * stride, row.lost + k * stride}, footprint, brought);
    }
  }
};

}  // namespace tushar::mpm::gas::conserving
