#pragma once

#include <algorithm>

#include "components/mpm/gas/conserving/footprint.hpp"

namespace tushar::mpm::gas::conserving {

/// N fields at the nodes or cells that the particles of a box of cells may overlap, wide enough for any footprint, so
/// that no index needs a bounds check. The values of a row are contiguous in memory, and those of the
/// next field follow them: so the fields around a particle are in few pages of memory.
template <int D, std::size_t N>
class GridFields {
 public:
  /// The values are 0 if `cleared`, and else those that the memory happens to contain.
  GridFields(const Box& cells, bool cleared)
      : box_(cells.grown(Footprint<D>::most, D)), size_(static_cast<std::size_t>(box_.extent(0) + 2 * Lanes::count)) {
    std::size_t all = N * size_;
    for (std::size_t d = 1; d < D; ++d) {
      stride_[d] = static_cast<std::ptrdiff_t>(all);
      all *= static_cast<std::size_t>(box_.extent(static_cast<int>(d)));
    }
    values_ = AlignedNumbers(all);
    if (cleared) std::fill_n(values_.get(), all, 0);
  }

  double& at(std::size_t field, const Index<D>& index) { return values_[field * size_ + place(index)]; }
  const double& at(std::size_t field, const Index<D>& index) const { return values_[field * size_ + place(index)]; }

  template <data::Centring C, class T>
  void copy(std::size_t field, const data::GridView<C, T>& from) {
    forEachRow<D>(from.box(), [&](const Index<D>& row, int count) { std::copy_n(&from[row], count, &at(field, row)); });
  }

  /// Stores a field at nodes or cells of a row. Lanes beyond the end of the part are stored, too: behind a row is space
  /// that nothing else uses.
  void writeRow(std::size_t field, const RowPart<D>& part, const Lanes& values) {
    values.copyTo(&at(field, part.first));
  }
  /// Reads a field at a node or cell and its neighbours along the first axis.
  Lanes readRow(std::size_t field, const Index<D>& index) const { return Lanes::at(&at(field, index)); }

 private:
  std::size_t place(const Index<D>& index) const {
    std::ptrdiff_t place = index[0] - box_.lower[0];
    for (int d = 1; d < D; ++d) place += (index[d] - box_.lower[d]) * stride_[static_cast<std::size_t>(d)];
    return static_cast<std::size_t>(place);
  }

  Box box_;
  std::size_t size_;                        ///< length of a row in memory
  std::array<std::ptrdiff_t, D> stride_{};  ///< along all axes but the first
  AlignedNumbers values_;
};

}  // namespace tushar::mpm::gas::conserving
