#pragma once

#include <vector>

#include "components/mpm/gas/conserving/footprint.hpp"

namespace tushar::mpm::gas::conserving {

/// N fields at the nodes or cells that the particles of a box of cells may touch, initially 0. Each field is contiguous
/// in memory, and wide enough for any footprint, so that no index needs a bounds check.
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

  /// The nodes or cells near the particles of a batch, one per particle.
  class Near {
   public:
    Near(const GridFields& fields, const std::array<LaneIntegers, D>& index, int count) : place_(fields.places(index)) {
      for (int lane = 1; lane < Lanes::count; ++lane)
        consecutive_ = consecutive_ && (lane >= count || place_[lane] == place_[0] + lane);
    }

   private:
    friend GridFields;
    LaneIntegers place_;
    bool consecutive_ = true;  ///< whether each is next to the one of the previous lane
  };

  /// A field at the nodes or cells offset by `k`.
  Lanes read(std::size_t field, const Near& near, const Index<D>& k) const {
    const double* values = values_.data() + field * size_ + offset(k);
    if (near.consecutive_) return Lanes::at(values + near.place_[0]);
    return Lanes::of([&](int lane) { return values[near.place_[lane]]; });
  }
  /// A field at a node or cell and its neighbours along the first axis.
  Lanes readRow(std::size_t field, const Index<D>& index) const { return Lanes::at(&at(field, index)); }

 protected:
  /// Access to the memory, for fields that are sums.
  double* values(std::size_t field) { return values_.data() + field * size_; }
  std::size_t size() const { return size_; }
  int stride(int axis) const { return stride_[axis]; }
  static const LaneIntegers& placesOf(const Near& near) { return near.place_; }
  static bool areConsecutive(const Near& near) { return near.consecutive_; }

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
    for (int d = 1; d < D; ++d) at += (index[d] - box_.lower[d]) * stride_[d];
    return at;
  }

  Box box_;
  std::size_t size_;
  Index<D> stride_ = Index<D>::filled(1);
  std::vector<double> values_;
};

}  // namespace tushar::mpm::gas::conserving
