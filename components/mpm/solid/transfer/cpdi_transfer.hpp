#pragma once

#include "components/mpm/solid/transfer/transfer.hpp"

namespace tushar::mpm::solid {

/// How many records lie from that of the first node of a stencil to the lower one of a corner's cell.
template <class Corner, std::size_t D>
std::ptrdiff_t offsetOf(const Corner& corner, const std::array<std::ptrdiff_t, D>& stride) {
  std::ptrdiff_t offset = 0;
  for (std::size_t d = 0; d < D; ++d) offset += corner.cell[static_cast<int>(d)] * stride[d];
  return offset;
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

/// The contribution of each corner to the high half of a record, apart from its slopes.
template <class Stencil>
[[gnu::always_inline]] inline Quad meanShare(const Stencil& stencil, const Quad& high, const Quad& hoop) {
  if constexpr (Stencil::axisymmetric) return Stencil::share * multiplyAdd(stencil.inverseRadius, hoop, high);
  return Stencil::share * high;
}

/// As for other shapes (see transfer.hpp): each corner adds its share to the nodes of its cell.
template <class Stencil, int D = Stencil::dimension>
requires(Stencil::corners > 0)
    [[gnu::always_inline]] inline void scatter(const Stencil& stencil, const NodeWindow<NodeRecord, D>& nodes,
                                               const NodeRecord& value,
                                               const std::array<Quad, Stencil::dimension>& slope,
                                               const Quad& hoop = Quad{}) {
  const Quad low = Stencil::share * value.low, mean = meanShare(stencil, value.high, hoop);
  for (const auto& corner : stencil.corner) {
    Quad high = mean;
    for (std::size_t d = 0; d < D; ++d) high = multiplyAdd(corner.slope[static_cast<int>(d)], slope[d], high);
    NodeRecord* const cell = nodes.origin + offsetOf(corner, nodes.stride);
    forEachNodeOfCell<D>(nodes.stride, [&](std::ptrdiff_t offset, std::size_t k) {
      cell[offset].low = multiplyAdd(corner.weights[k], low, cell[offset].low);
      cell[offset].high = multiplyAdd(corner.weights[k], high, cell[offset].high);
    });
  }
}

/// scatter to the nodes of a stencil that lie within a box; `origin` is the record of its first node, stored or not.
template <class Stencil, int D = Stencil::dimension>
requires(Stencil::corners >
         0) inline void scatterWithin(const Stencil& stencil, const Box& box, const NodeWindow<NodeRecord, D>& nodes,
                                      const NodeRecord& value, const std::array<Quad, Stencil::dimension>& slope,
                                      const Quad& hoop = Quad{}) {
  const Quad low = Stencil::share * value.low, mean = meanShare(stencil, value.high, hoop);
  for (const auto& corner : stencil.corner) {
    Quad high = mean;
    for (std::size_t d = 0; d < D; ++d) high = multiplyAdd(corner.slope[static_cast<int>(d)], slope[d], high);
    for (std::size_t k = 0; k < (1U << D); ++k) {
      Index<D> node;
      std::ptrdiff_t offset = 0;
      for (std::size_t d = 0; d < D; ++d) {
        const int upper = (k >> d) & 1U ? 1 : 0, at = corner.cell[static_cast<int>(d)] + upper;
        node[static_cast<int>(d)] = stencil.first[static_cast<int>(d)] + at;
        offset += at * nodes.stride[d];
      }
      if (!box.contains(node)) continue;
      NodeRecord& record = nodes.origin[offset];
      record.low = multiplyAdd(corner.weights[k], low, record.low);
      record.high = multiplyAdd(corner.weights[k], high, record.high);
    }
  }
}

template <class Stencil, int D = Stencil::dimension>
requires(Stencil::corners > 0)
    [[gnu::always_inline]] inline Gathered<D> gather(const Stencil& stencil,
                                                     const NodeWindow<const NodeRecord, D>& nodes) {
  Gathered<D> sums;
  for (const auto& corner : stencil.corner) {
    const NodeRecord* const cell = nodes.origin + offsetOf(corner, nodes.stride);
    NodeRecord at{};
    forEachNodeOfCell<D>(nodes.stride, [&](std::ptrdiff_t offset, std::size_t k) {
      at.low = multiplyAdd(corner.weights[k], cell[offset].low, at.low);
      at.high = multiplyAdd(corner.weights[k], cell[offset].high, at.high);
    });
    sums.value.low = multiplyAdd(Stencil::share, at.low, sums.value.low);
    sums.value.high = multiplyAdd(Stencil::share, at.high, sums.value.high);
    for (std::size_t d = 0; d < D; ++d)
      sums.gradient[d] = multiplyAdd(corner.slope[static_cast<int>(d)], at.low, sums.gradient[d]);
  }
  if constexpr (Stencil::axisymmetric) sums.hoop = stencil.inverseRadius * sums.value.low;
  return sums;
}

}  // namespace tushar::mpm::solid
