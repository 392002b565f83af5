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

/// N sums over particles at the nodes (More = 1) or cells (More = 0) of a box of cells. Rounding errors are summed,
/// too, and `finish()` adds them to the sums. So a sum does not depend on the order of the particles, which differs in
/// a mirror image, unless the sum lies within about 1e-32 of the midpoint of two floating-point numbers.
template <int D, std::size_t N, int More>
class GridSums : public GridFields<D, N> {
  using Fields = GridFields<D, N>;

 public:
  using Brought = std::array<std::array<Lanes, Footprint<D>::places>, N>;

  explicit GridSums(const Box& cells) : Fields(cells), lost_(N * this->size()) {}

  /// Adds terms to the nodes or cells of the footprints of a batch; lanes that are not in use must contribute 0.
  void add(const Footprint<D>& footprint, const Brought& brought) {
    const std::size_t first = this->place(footprint.first());
    for (std::size_t n = 0; n < N; ++n)
      addRows<D - 1>({this->values(n) + first, lost_.data() + n * this->size() + first}, footprint, brought[n].data());
  }
  void finish() {
    double* const values = this->values(0);
    for (std::size_t k = 0; k < lost_.size(); ++k) values[k] += lost_[k];
  }

 private:
  /// Pointers to a sum and to its rounding error.
  struct Pair {
    double *sum, *lost;

    Pair operator+(int by) const { return {sum + by, lost + by}; }
  };

  template <int Axis>
  void addRows(Pair field, const Footprint<D>& footprint, const Lanes* brought) {
    const int end = footprint.along[Axis].cells + More;
    if constexpr (Axis == 0) {
      addRow(field, end, brought, std::make_integer_sequence<int, Footprint<D>::most>());
    } else {
      for (int k = 0; k < end; ++k, brought += Footprint<D>::stride(Axis), field = field + this->stride(Axis))
        addRows<Axis - 1>(field, footprint, brought);
    }
  }
  template <int... K>
  static void addRow(Pair field, int end, const Lanes* brought, std::integer_sequence<int, K...>) {
    const Pair next = field + Lanes::count;
    CarefulSum<Lanes> low{Lanes::at(field.sum), Lanes::at(field.lost)}, high{Lanes::at(next.sum), Lanes::at(next.lost)};
    const auto addShifted = [&]<int Shift>(std::integral_constant<int, Shift>) {
      if constexpr (Shift <= Lanes::count) {
        if (Shift >= end) return;
        low.add(window<Lanes::count - Shift>(0, brought[Shift]));
        high.add(window<Lanes::count - Shift>(brought[Shift], 0));
      }
    };
    low.add(brought[0]);
    (addShifted(std::integral_constant<int, K + 1>()), ...);
    low.sum.copyTo(field.sum);
    low.lost.copyTo(field.lost);
    high.sum.copyTo(next.sum);
    high.lost.copyTo(next.lost);
    for (int shift = Lanes::count + 1; shift < end; ++shift) {  // beyond both registers, if these have few lanes
      const Pair at = field + shift;
      CarefulSum<Lanes> far{Lanes::at(at.sum), Lanes::at(at.lost)};
      far.add(brought[shift]);
      far.sum.copyTo(at.sum);
      far.lost.copyTo(at.lost);
    }
  }

  std::vector<double> lost_;
};

}  // namespace tushar::mpm::gas::conserving
