#pragma once

#include <vector>

#include "components/mpm/conserving/footprint.hpp"

namespace tushar::mpm {

/// N fields at the nodes or cells that the particles of a box of cells may touch, each by itself in memory and 0 at
/// first; wide enough for any footprint, so that no index needs to be checked against an end.
template <int D, std::size_t N>
class GridFields {
 public:
  explicit GridFields(const Box& cells)
      : box_(cells.grown(Footprint<D>::most, D)), size_(box_.size() + 2 * Lanes::count) {
    for (int d = 1; d < D; ++d) stride_[d] = stride_[d - 1] * box_.extent(d - 1);
    values_.resize(N * size_);
  }

  double& at(std::size_t field, const Index<D>& index) { return values_[field * size_ + place(index)]; }
  const double& at(std::size_t field, const Index<D>& index) const { return values_[field * size_ + place(index)]; }

  template <data::Centring C, class T>
  void copy(std::size_t field, const data::GridView<C, T>& from) {
    forEach<D>(from.box(), [&](const Index<D>& index) { at(field, index) = from[index]; });
  }

  /// Nodes or cells, one per particle of a batch.
  class Near {
   public:
    Near(const GridFields& fields, const std::array<LaneIntegers, D>& index, int count) : place_(fields.places(index)) {
      for (int lane = 1; lane < Lanes::count; ++lane)
        consecutive_ = consecutive_ && (lane >= count || place_[lane] == place_[0] + lane);
    }

   private:
    friend GridFields;
    LaneIntegers place_;
    bool consecutive_ = true;  ///< each lies beside the one of the lane before
  };

  /// A field at the nodes or cells that are `k` further.
  Lanes read(std::size_t field, const Near& near, const Index<D>& k) const {
    const double* values = values_.data() + field * size_ + offset(k);
    if (near.consecutive_) return Lanes::at(values + near.place_[0]);
    return Lanes::of([&](int lane) { return values[near.place_[lane]]; });
  }
  /// A field at a node or cell and those beside it along the first axis.
  Lanes readRow(std::size_t field, const Index<D>& index) const { return Lanes::at(&at(field, index)); }

  /// What each particle of a batch brings to each place of its footprint.
  using Brought = std::array<std::array<Lanes, Footprint<D>::places>, N>;

  /// Adds, particle by particle, to the nodes (more = 1) or cells (more = 0) of a footprint. Lanes not in use bring 0.
  void add(const Footprint<D>& footprint, int count, int more, const Brought& brought) {
    const Near near(*this, footprint.first(), count);
    for (std::size_t n = 0; n < N; ++n) {
      double* field = values_.data() + n * size_;
      if (near.consecutive_)
        addRows<D - 1>(field + near.place_[0], footprint, more, brought[n].data());
      else
        for (int lane = 0; lane < Lanes::count; ++lane)
          addOne<D - 1>(field + near.place_[lane], footprint, more, brought[n].data(), lane);
    }
  }

 private:
  int offset(const Index<D>& by) const {
    int sum = by[0];
    for (int d = 1; d < D; ++d) sum += by[d] * stride_[d];
    return sum;
  }
  std::size_t place(const Index<D>& index) const {
    Index<D> by;
    for (int d = 0; d < D; ++d) by[d] = index[d] - box_.lower[d];
    return static_cast<std::size_t>(offset(by));
  }
  LaneIntegers places(const std::array<LaneIntegers, D>& index) const {
    LaneIntegers at = index[0] - box_.lower[0];
    for (int d = 1; d < D; ++d) at += (index[static_cast<std::size_t>(d)] - box_.lower[d]) * stride_[d];
    return at;
  }

  /// Adds what one lane brings.
  template <int Axis>
  void addOne(double* field, const Footprint<D>& footprint, int more, const Lanes* brought, int lane) {
    const int end = footprint.along[Axis].cells + more;
    for (int k = 0; k < end; ++k, brought += Footprint<D>::stride(Axis), field += stride_[Axis]) {
      if constexpr (Axis == 0)
        *field += (*brought)[lane];
      else
        addOne<Axis - 1>(field, footprint, more, brought, lane);
    }
  }
  /// Adds what consecutive particles bring.
  template <int Axis>
  void addRows(double* field, const Footprint<D>& footprint, int more, const Lanes* brought) {
    const int end = footprint.along[Axis].cells + more;
    if constexpr (Axis == 0) {
      addRow(field, end, brought, std::make_integer_sequence<int, Footprint<D>::most>());
    } else {
      for (int k = 0; k < end; ++k, brought += Footprint<D>::stride(Axis), field += stride_[Axis])
        addRows<Axis - 1>(field, footprint, more, brought);
    }
  }
  /// Each place gets what the first particle that touches it brings first: its last node.
  template <int... K>
  static void addRow(double* field, int end, const Lanes* brought, std::integer_sequence<int, K...>) {
    Lanes low = Lanes::at(field), high = Lanes::at(field + Lanes::count);
    constexpr int last = sizeof...(K);
    const auto addShifted = [&]<int Shift>(std::integral_constant<int, Shift>) {
      if (Shift >= end) return;
      low += window<Lanes::count - Shift>(0, brought[Shift]);
      high += window<Lanes::count - Shift>(brought[Shift], 0);
    };
    (addShifted(std::integral_constant<int, last - K>()), ...);
    low += brought[0];
    low.copyTo(field);
    high.copyTo(field + Lanes::count);
  }

  Box box_;
  std::size_t size_;
  Index<D> stride_ = Index<D>::filled(1);
  std::vector<double> values_;
};

}  // namespace tushar::mpm
