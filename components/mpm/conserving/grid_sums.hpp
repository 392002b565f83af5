#pragma once

#include <memory>

#include "components/mpm/conserving/grid_fields.hpp"

namespace tushar::mpm {

/// N sums at the nodes (More = 1) or cells (More = 0) of a box of cells over what particles bring, in the order in which
/// they come. To be read after `finish()`.
template <int D, std::size_t N, int More>
class GridSums : public GridFields<D, N> {
 public:
  using GridFields<D, N>::GridFields;
  using Brought = typename GridFields<D, N>::Brought;

  /// Lanes not in use bring 0.
  void add(const Footprint<D>& footprint, int count, const Brought& brought) {
    GridFields<D, N>::add(footprint, count, More, brought);
  }
  void finish() {}
};

/// On a line the mirror image of the particles has the mirrored sums, to the bit: first all that particles of one cell
/// bring to one place are summed, then what cells equally far on either side of the place bring.
///
/// The first particle of a cell is stored. Those after it add what is lost to rounding as well (the two-sum of O. Moller,
/// BIT 5 (1965) 37): the order of the particles of a cell changes at most the last bit of the sum, and that of two none.
template <std::size_t N, int More>
class GridSums<1, N, More> {
  static constexpr int overhang = Footprint<1>::overhang;
  static constexpr int slots = 2 * overhang + 1 + More;  ///< places that the particles of a cell may bring something to
  static constexpr int margin = Lanes::count + slots;    ///< cells beyond both ends, without particles

 public:
  using Brought = std::array<std::array<Lanes, Footprint<1>::places>, N>;

  explicit GridSums(const Box& cells)
      : before_(cells.lower[0] - margin),
        stride_(static_cast<std::size_t>(cells.extent(0) + 2 * margin)),
        particles_(stride_, 0),
        brought_(std::make_unique_for_overwrite<double[]>(N * slots * stride_)) {}

  /// Lanes not in use bring 0.
  void add(const Footprint<1>& footprint, int count, const Brought& brought) {
    const auto& span = footprint.along[0];
    const LaneIntegers cell = span.first + (span.below - before_);
    if (standAlone(cell, count)) return store(span, cell, count, brought);
    for (int lane = 0; lane < count; ++lane) {
      int& particles = particles_[static_cast<std::size_t>(cell[lane])];
      if (particles == 0)
        storeOne(span, lane, cell[lane], brought);
      else
        addOne(span, lane, cell[lane], brought, particles == 1);
      ++particles;
    }
  }

  void finish() {
    for (std::size_t cell = 0; cell < stride_; ++cell)
      if (particles_[cell] != 1) settle(cell);
    sums_ = std::make_unique_for_overwrite<double[]>(N * stride_);
    for (std::size_t n = 0; n < N; ++n) {
      const double* const rows = brought_.get() + n * slots * stride_;
      double* const sums = sums_.get() + n * stride_;
      for (std::size_t place = slots; place < stride_ - slots; ++place) sums[place] = sumAt(rows, place);
    }
  }
  double at(std::size_t field, const Index<1>& index) const { return *find(field, index); }
  /// A field at a node or cell and those beside it.
  Lanes readRow(std::size_t field, const Index<1>& index) const { return Lanes::at(find(field, index)); }

 private:
  const double* find(std::size_t field, const Index<1>& index) const {
    return sums_.get() + field * stride_ + (index[0] - before_);
  }
  /// Whether these are the first particles of cells side by side.
  bool standAlone(const LaneIntegers& cell, int count) const {
    bool alone = particles_[static_cast<std::size_t>(cell[0])] == 0;
    for (int lane = 1; lane < count; ++lane) alone = alone && cell[lane] == cell[0] + lane;
    return alone;
  }
  std::size_t row(std::size_t n, int slot) const { return (n * slots + static_cast<std::size_t>(slot)) * stride_; }
  /// What particles bring to a slot.
  static Lanes share(const Span<overhang>& span, const std::array<Lanes, Footprint<1>::places>& brought, int slot) {
    const int k = slot - overhang + span.below;
    return k >= 0 && k < span.cells + More ? brought[static_cast<std::size_t>(k)] : Lanes(0);
  }
  void store(const Span<overhang>& span, const LaneIntegers& cell, int count, const Brought& brought) {
    for (std::size_t n = 0; n < N; ++n)
      for (int slot = 0; slot < slots; ++slot) share(span, brought[n], slot).copyTo(brought_.get() + row(n, slot) + cell[0]);
    std::fill_n(particles_.begin() + cell[0], count, 1);
  }
  void storeOne(const Span<overhang>& span, int lane, int cell, const Brought& brought) {
    for (std::size_t n = 0; n < N; ++n)
      for (int slot = 0; slot < slots; ++slot)
        brought_[row(n, slot) + static_cast<std::size_t>(cell)] = share(span, brought[n], slot)[lane];
  }
  /// Adds a particle to those of its cell; `isSecond` to one alone.
  void addOne(const Span<overhang>& span, int lane, int cell, const Brought& brought, bool isSecond) {
    if (!lost_) lost_ = std::make_unique_for_overwrite<double[]>(N * slots * stride_);
    for (std::size_t n = 0; n < N; ++n)
      for (int slot = 0; slot < slots; ++slot) {
        const std::size_t at = row(n, slot) + static_cast<std::size_t>(cell);
        const double more = share(span, brought[n], slot)[lane], before = brought_[at];
        const double sum = before + more, added = sum - before;
        brought_[at] = sum;
        lost_[at] = (isSecond ? 0.0 : lost_[at]) + ((before - (sum - added)) + (more - added));
      }
  }
  /// What a cell brings if it has no particle, or several.
  void settle(std::size_t cell) {
    for (std::size_t row = cell; row < N * slots * stride_; row += stride_)
      brought_[row] = particles_[cell] == 0 ? 0.0 : brought_[row] + lost_[row];
  }
  /// Sum over the slots, from the outside in.
  double sumAt(const double* rows, std::size_t place) const {
    const auto from = [&](int slot) {
      const auto s = static_cast<std::size_t>(slot);
      return rows[s * stride_ + place + overhang - s];
    };
    double sum = 0;
    for (int slot = 0; slot < slots / 2; ++slot) sum += from(slot) + from(slots - 1 - slot);
    return slots % 2 == 0 ? sum : sum + from(slots / 2);
  }

  int before_;
  std::size_t stride_;
  std::vector<int> particles_;  ///< by cell
  std::unique_ptr<double[]> brought_;  ///< by field, slot, and cell that it comes from
  std::unique_ptr<double[]> lost_;     ///< to rounding, in cells of several particles
  std::unique_ptr<double[]> sums_;
};

}  // namespace tushar::mpm
