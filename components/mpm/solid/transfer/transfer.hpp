#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "components/mpm/shapes/tensor_shape.hpp"
#include "components/mpm/solid/transfer/node_record.hpp"

namespace tushar::mpm::solid {

/// Records of nodes, relative to one node; records of neighbours along x are adjacent.
template <class Record, int D>
struct NodeWindow {
  Record* origin;                          ///< record of the first node to which a particle contributes
  std::array<std::ptrdiff_t, D> stride{};  ///< number of records from one node to the next along each axis
};

/// Calls `visit(offset, factors)` for each row of nodes to which a particle contributes.
template <class Stencil, int D, class Visit>
[[gnu::always_inline]] inline void forEachRow(const Stencil& stencil,
                                              const std::array<std::ptrdiff_t, Stencil::dimension>& stride,
                                              Visit&& visit) {
  constexpr std::size_t n = Stencil::nodes;
  for (std::size_t k = 0; k < (D < 3 ? 1 : n); ++k)
    for (std::size_t j = 0; j < (D < 2 ? 1 : n); ++j) {
      std::ptrdiff_t offset = 0;
      if constexpr (D > 1) offset += static_cast<std::ptrdiff_t>(j) * stride[1];
      if constexpr (D > 2) offset += static_cast<std::ptrdiff_t>(k) * stride[2];
      visit(offset, stencil.rowFactors(j, k));
    }
}

/// The contribution of a particle to a row of nodes along the first axis, without the factors of this axis.
struct RowShare {
  Octet value, change, round;

  template <std::size_t D>
  [[gnu::always_inline]] RowShare(const RowFactors<D>& f, const Octet& of, const std::array<Octet, D>& slope,
                                  const Octet& hoop)
      : value(f[0] * of), change(f[0] * slope[0]), round(f[0] * hoop) {
    for (std::size_t d = 1; d < D; ++d) value = multiplyAddHigh(f[d], slope[d], value);
  }

  /// The record of node i of the row, with the particle's contribution added.
  template <class Stencil>
  [[gnu::always_inline]] Octet addedTo(const Octet& record, const Stencil& stencil, std::size_t i) const {
    const Octet sum =
        multiplyAdd(stencil.valueAlongRow(i), value, multiplyAddHigh(stencil.slopeAlongRow(i), change, record));
    if constexpr (Stencil::axisymmetric) return multiplyAddHigh(stencil.hoopAlongRow(i), round, sum);
    return sum;
  }
  template <class Stencil>
  [[gnu::always_inline]] void addTo(NodeRecord& record, const Stencil& stencil, std::size_t i) const {
    addedTo(Octet(record), stencil, i).copyTo(record);
  }
};

/// The contribution of a particle to the high halves of records for each axis.
template <std::size_t D>
[[gnu::always_inline]] inline std::array<Octet, D> highOctets(const std::array<Quad, D>& of) {
  std::array<Octet, D> high;
  for (std::size_t d = 0; d < D; ++d) high[d] = Octet(Quad{}, of[d]);
  return high;
}

/// Adds S_i * value to record_i, and sum_d dS_i/dx_d * slope_d (+ S_i / r * hoop in axisymmetric scenes) to its high
/// half, for the nodes i of a stencil.
template <class Stencil, int D = Stencil::dimension>
[[gnu::always_inline]] inline void scatter(const Stencil& stencil, const NodeWindow<NodeRecord, D>& nodes,
                                           const NodeRecord& value, const std::array<Quad, Stencil::dimension>& slope,
                                           const Quad& hoop = Quad{}) {
  const Octet of(value.low, value.high), round(Quad{}, hoop);
  const auto slopes = highOctets(slope);
  forEachRow<Stencil, D>(stencil, nodes.stride, [&](std::ptrdiff_t offset, const RowFactors<D>& f) {
    const RowShare share(f, of, slopes, round);
    for (std::size_t i = 0; i < Stencil::nodes; ++i)
      share.addTo(nodes.origin[offset + static_cast<std::ptrdiff_t>(i)], stencil, i);
  });
}

/// The records of the nodes of a cell, kept in registers while particles that contribute to no other nodes are added.
template <int D>
class CellRecords {
 public:
  [[gnu::always_inline]] explicit CellRecords(const NodeWindow<NodeRecord, D>& nodes) : nodes_(nodes) {
    forEachNode([](Octet& sum, NodeRecord& record) { sum = Octet(record); });
  }
  /// Adds a particle's contribution to the records in registers, as scatter does to records in memory.
  template <class Stencil>
  [[gnu::always_inline]] void add(const Stencil& stencil, const NodeRecord& value, const std::array<Quad, D>& slope,
                                  const Quad& hoop) {
    const Octet of(value.low, value.high), round(Quad{}, hoop);
    const auto slopes = highOctets(slope);
    for (std::size_t row = 0; row < rows; ++row) {
      const RowShare share(stencil.rowFactors(row % 2, row / 2), of, slopes, round);
      for (std::size_t i = 0; i < 2; ++i) sums_[2 * row + i] = share.addedTo(sums_[2 * row + i], stencil, i);
    }
  }
  [[gnu::always_inline]] void store() {
    forEachNode([](const Octet& sum, NodeRecord& record) { sum.copyTo(record); });
  }

 private:
  static constexpr std::size_t rows = std::size_t{1} << (D - 1);

  template <class Visit>
  [[gnu::always_inline]] void forEachNode(Visit&& visit) {
    for (std::size_t k = 0; k < 2 * rows; ++k) {
      std::ptrdiff_t offset = 0;
      for (std::size_t d = 0; d < D; ++d) offset += ((k >> d) & 1U) ? nodes_.stride[d] : 0;
      visit(sums_[k], nodes_.origin[offset]);
    }
  }

  NodeWindow<NodeRecord, D> nodes_;
  std::array<Octet, 2 * rows> sums_;
};

/// Calls `visit` for each number from `first` up to `end` that is smaller than n. The loop is unrolled, so that each
/// number is a constant.
template <int n, class Visit>
[[gnu::always_inline]] inline void forEachOf(int first, int end, Visit&& visit) {
#pragma GCC unroll 8
  for (int k = 0; k < n; ++k)
    if (k >= first && k < end) visit(k);
}

/// Adds a particle's contribution, as scatter does, but only to nodes within a box; the origin of `nodes` is the place
/// of the record of the stencil's first node, which need not be stored.
template <class Stencil, int D = Stencil::dimension>
inline void scatterWithin(const Stencil& stencil, const Box& box, const NodeWindow<NodeRecord, D>& nodes,
                          const NodeRecord& value, const std::array<Quad, Stencil::dimension>& slope,
                          const Quad& hoop = Quad{}) {
  Index<D> first, end;  // of the nodes within the box, counted from the first of the stencil
  for (int d = 0; d < D; ++d) {
    first[d] = std::max(0, box.lower[d] - stencil.first[d]);
    end[d] = std::min(Stencil::nodes, box.upper[d] - stencil.first[d]);
    if (first[d] >= end[d]) return;
  }
  const Octet of(value.low, value.high), round(Quad{}, hoop);
  const auto slopes = highOctets(slope);
  const auto addRow = [&](std::ptrdiff_t offset, const RowFactors<D>& f) {
    const RowShare share(f, of, slopes, round);
    forEachOf<Stencil::nodes>(
        first[0], end[0], [&](int i) { share.addTo(nodes.origin[offset + i], stencil, static_cast<std::size_t>(i)); });
  };
  if constexpr (D == 1) {
    addRow(0, stencil.rowFactors(0, 0));
  } else if constexpr (D == 2) {
    for (int j = first[1]; j < end[1]; ++j) addRow(j * nodes.stride[1], stencil.rowFactors(j, 0));
  } else {
    for (int k = first[2]; k < end[2]; ++k)
      for (int j = first[1]; j < end[1]; ++j)
        addRow(j * nodes.stride[1] + k * nodes.stride[2], stencil.rowFactors(j, k));
  }
}

/// The values that a particle interpolates from the nodes: sum_i S_i record_i and, for the low halves of the records,
/// also the gradient and sum_i S_i / r record_i.
template <int D>
struct Gathered {
  NodeRecord value{};
  std::array<Quad, D> gradient{};
  Quad hoop{};
};

/// Sets the value and the gradient of `sums`, and in axisymmetric scenes its hoop. The results are written directly to
/// `sums`, from where code that continues in lanes loads them.
template <class Stencil, class Sums, int D = Stencil::dimension>
[[gnu::always_inline]] inline void gatherInto(Sums& sums, const Stencil& stencil,
                                              const NodeWindow<const NodeRecord, D>& nodes) {
  Octet value;
  std::array<Quad, D> gradient{};
  Quad hoop{};
  forEachRow<Stencil, D>(stencil, nodes.stride, [&](std::ptrdiff_t offset, const RowFactors<D>& f) {
    const NodeRecord* row = nodes.origin + offset;
    const Octet first(row[0]);
    Octet both = stencil.valueAlongRow(0) * first;
    Quad change = stencil.slopeAlongRow(0) * first.low(), round{};
    if constexpr (Stencil::axisymmetric) round = stencil.hoopAlongRow(0) * first.low();
    for (std::size_t i = 1; i < Stencil::nodes; ++i) {
      const Octet record(row[i]);
      both = multiplyAdd(stencil.valueAlongRow(i), record, both);
      change = multiplyAdd(stencil.slopeAlongRow(i), record.low(), change);
      if constexpr (Stencil::axisymmetric) round = multiplyAdd(stencil.hoopAlongRow(i), record.low(), round);
    }
    value = multiplyAdd(f[0], both, value);
    gradient[0] = multiplyAdd(f[0], change, gradient[0]);
    for (std::size_t d = 1; d < D; ++d) gradient[d] = multiplyAdd(f[d], both.low(), gradient[d]);
    if constexpr (Stencil::axisymmetric) hoop = multiplyAdd(f[0], round, hoop);
  });
  value.copyTo(sums.value);
  sums.gradient = gradient;
  if constexpr (Stencil::axisymmetric) sums.hoop = hoop;
}

template <class Stencil, int D = Stencil::dimension>
[[gnu::always_inline]] inline Gathered<D> gather(const Stencil& stencil, const NodeWindow<const NodeRecord, D>& nodes) {
  Gathered<D> sums;
  gatherInto(sums, stencil, nodes);
  return sums;
}

}  // namespace tushar::mpm::solid
