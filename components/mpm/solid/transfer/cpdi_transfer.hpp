#pragma once

#include "components/mpm/solid/transfer/transfer.hpp"

namespace tushar::mpm::solid {

/// The distance, in records, from the first node of a stencil to the lowest node of the cell that contains each corner.
template <class Stencil, std::size_t D>
[[gnu::always_inline]] inline std::array<std::ptrdiff_t, Stencil::corners> offsetsOfCells(
    const Stencil& stencil, const std::array<std::ptrdiff_t, D>& stride) {
  typename Stencil::Corners sum{};
  for (std::size_t d = 0; d < D; ++d) sum += stencil.cellOf[d] * static_cast<double>(stride[d]);
  std::array<std::ptrdiff_t, Stencil::corners> offsets;
  for (std::size_t c = 0; c < Stencil::corners; ++c) offsets[c] = static_cast<std::ptrdiff_t>(sum[static_cast<int>(c)]);
  return offsets;
}

/// Calls `visit(offset, k)` for each node k of a cell.
template <int D, class Visit>
[[gnu::always_inline]] inline void forEachNodeOfCell(const std::array<std::ptrdiff_t, D>& stride, Visit&& visit) {
  for (std::size_t k = 0; k < (1U << D); ++k) {
    std::ptrdiff_t offset = 0;
    for (std::size_t d = 0; d < D; ++d) offset += ((k >> d) & 1U) ? stride[d] : 0;
    visit(offset, k);
  }
}

/// The contribution of each corner to the high half of a record, without the slopes.
template <class Stencil>
[[gnu::always_inline]] inline Quad meanShare(const Stencil& stencil, const Quad& high, const Quad& hoop) {
  if constexpr (Stencil::axisymmetric) return Stencil::share * multiplyAdd(stencil.inverseRadius, hoop, high);
  return Stencil::share * high;
}

/// The contribution of corner c to the high half of a record.
template <class Stencil, std::size_t D>
[[gnu::always_inline]] inline Quad highShare(const Stencil& stencil, int c, const std::array<Quad, D>& slope,
                                             Quad high) {
  for (std::size_t d = 0; d < D; ++d) high = multiplyAdd(stencil.slope[d][c], slope[d], high);
  return high;
}

/// Adds a particle's contribution to the nodes, as scatter in transfer.hpp does for other shapes: each corner adds its
/// part to the nodes of its cell.
template <class Stencil, int D = Stencil::dimension>
requires(Stencil::corners > 0)
    [[gnu::always_inline]] inline void scatter(const Stencil& stencil, const NodeWindow<NodeRecord, D>& nodes,
                                               const NodeRecord& value,
                                               const std::array<Quad, Stencil::dimension>& slope,
                                               const Quad& hoop = Quad{}) {
  const Quad low = Stencil::share * value.low, mean = meanShare(stencil, value.high, hoop);
  const auto offsets = offsetsOfCells(stencil, nodes.stride);
  for (int c = 0; c < Stencil::corners; ++c) {
    const Octet share(low, highShare(stencil, c, slope, mean));
    NodeRecord* const cell = nodes.origin + offsets[c];
    forEachNodeOfCell<D>(nodes.stride, [&](std::ptrdiff_t offset, std::size_t k) {
      multiplyAdd(stencil.weights[k][c], share, Octet(cell[offset])).copyTo(cell[offset]);
    });
  }
}

/// Adds a particle's contribution, as scatter does, but only to nodes within a box; the origin of `nodes` is the record
/// of the stencil's first node, which need not be stored.
template <class Stencil, int D = Stencil::dimension>
requires(Stencil::corners >
         0) inline void scatterWithin(const Stencil& stencil, const Box& box, const NodeWindow<NodeRecord, D>& nodes,
                                      const NodeRecord& value, const std::array<Quad, Stencil::dimension>& slope,
                                      const Quad& hoop = Quad{}) {
  const Quad low = Stencil::share * value.low, mean = meanShare(stencil, value.high, hoop);
  for (int c = 0; c < Stencil::corners; ++c) {
    const Octet share(low, highShare(stencil, c, slope, mean));
    for (std::size_t k = 0; k < (1U << D); ++k) {
      Index<D> node;
      std::ptrdiff_t offset = 0;
      for (std::size_t d = 0; d < D; ++d) {
        const int upper = (k >> d) & 1U ? 1 : 0, at = static_cast<int>(stencil.cellOf[d][c]) + upper;
        node[static_cast<int>(d)] = stencil.first[static_cast<int>(d)] + at;
        offset += at * nodes.stride[d];
      }
      if (!box.contains(node)) continue;
      NodeRecord& record = nodes.origin[offset];
      multiplyAdd(stencil.weights[k][c], share, Octet(record)).copyTo(record);
    }
  }
}

template <class Stencil, class Sums, int D = Stencil::dimension>
requires(Stencil::corners > 0)
    [[gnu::always_inline]] inline void gatherInto(Sums& sums, const Stencil& stencil,
                                                  const NodeWindow<const NodeRecord, D>& nodes) {
  const auto offsets = offsetsOfCells(stencil, nodes.stride);
  Octet value;
  std::array<Quad, D> gradient{};
  for (int c = 0; c < Stencil::corners; ++c) {
    const NodeRecord* const cell = nodes.origin + offsets[c];
    Octet at;
    forEachNodeOfCell<D>(nodes.stride, [&](std::ptrdiff_t offset, std::size_t k) {
      at = multiplyAdd(stencil.weights[k][c], Octet(cell[offset]), at);
    });
    value = multiplyAdd(Stencil::share, at, value);
    for (std::size_t d = 0; d < D; ++d) gradient[d] = multiplyAdd(stencil.slope[d][c], at.low(), gradient[d]);
  }
  value.copyTo(sums.value);
  sums.gradient = gradient;
  if constexpr (Stencil::axisymmetric) sums.hoop = stencil.inverseRadius * sums.value.low;
}

}  // namespace tushar::mpm::solid
