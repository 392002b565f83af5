#pragma once

#include "components/mpm/solid/transfer/cpdi_transfer.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// The velocities that several particles of a cell interpolate from the nodes, one particle in each lane; bitwise equal
/// to the results of Gathered.
template <int D>
struct GatheredLanes {
  std::array<Lanes, D> after, before;            ///< sum_i S_i v*_i and sum_i S_i v_i [m/s]
  std::array<std::array<Lanes, D>, D> gradient;  ///< gradient of v* [1/s], by axis and component
};

/// Gathers for particles that contribute only to the nodes of their cell: each number of a node is loaded once for all
/// of them.
template <class Stencils, int D = Stencils::dimension>
[[gnu::always_inline]] inline GatheredLanes<D> gatherOfCell(const Stencils& stencils,
                                                            const NodeWindow<const NodeRecord, D>& nodes) {
  GatheredLanes<D> sums{};
  const Lanes s0 = stencils.valueAlongRow(0), s1 = stencils.valueAlongRow(1);
  const Lanes ds0 = stencils.slopeAlongRow(0), ds1 = stencils.slopeAlongRow(1);
  forEachRow<Stencils, D>(stencils, nodes.stride, [&](std::ptrdiff_t offset, const std::array<Lanes, D>& f) {
    const NodeRecord &lower = nodes.origin[offset], &upper = nodes.origin[offset + 1];
    for (int i = 0; i < D; ++i) {
      const double before0 = lower[lane::before + i], before1 = upper[lane::before + i];
      const double after0 = lower[lane::velocity + i], after1 = upper[lane::velocity + i];
      const Lanes after = multiplyAdd(s1, after1, s0 * after0), change = multiplyAdd(ds1, after1, ds0 * after0);
      sums.before[i] = multiplyAdd(f[0], multiplyAdd(s1, before1, s0 * before0), sums.before[i]);
      sums.after[i] = multiplyAdd(f[0], after, sums.after[i]);
      sums.gradient[0][i] = multiplyAdd(f[0], change, sums.gradient[0][i]);
      for (std::size_t d = 1; d < D; ++d) sums.gradient[d][i] = multiplyAdd(f[d], after, sums.gradient[d][i]);
    }
  });
  return sums;
}

/// The values gathered by a single particle.
template <int D>
struct GatheredAlone {
  NodeRecord value;
  std::array<Quad, D> gradient;
};

/// Combines the values of `count` particles, each of which was gathered separately.
template <int D>
[[gnu::always_inline]] inline GatheredLanes<D> lanesOf(const std::array<GatheredAlone<D>, Lanes::count>& gathered,
                                                       int count) {
  const auto of = [&](int k) -> const GatheredAlone<D>& { return gathered[std::min(k, count - 1)]; };
  const auto value = columnsOf<8>([&](int k) { return reinterpret_cast<const double*>(&of(k).value); });
  GatheredLanes<D> sums;
  for (std::size_t i = 0; i < D; ++i) {
    sums.after[i] = value[lane::velocity + i];
    sums.before[i] = value[lane::before + i];
  }
  for (std::size_t d = 0; d < D; ++d) {
    const auto change = columnsOf<D>([&](int k) { return reinterpret_cast<const double*>(&of(k).gradient[d]); });
    for (std::size_t i = 0; i < D; ++i) sums.gradient[d][i] = change[i];
  }
  return sums;
}

/// Gathers the values that up to Lanes::count particles of a cell, starting with `first`, interpolate from the nodes;
/// missing lanes repeat one of these particles.
template <class Shape, int D = Shape::dimension>
[[gnu::always_inline]] inline GatheredLanes<D> gatherLanes(const CellFrame<D>& frame, const Index<D>& cell,
                                                           const Vec<D>* x, const Extents<Shape>& extents, int first,
                                                           int count, const NodeView<const NodeRecord>& record) {
  if constexpr (sharesNodes<Shape>) {
    const typename Shape::Stencils stencils(frame, cell, vectorsOf<D>(x + first, count), extents.sizes(first, count));
    return gatherOfCell(stencils, windowOf<const NodeRecord>(record, stencils[0]));
  } else {
    std::array<GatheredAlone<D>, Lanes::count> gathered;
    forEachStencilOf(frame, cell, x, extents, first, count, [&](int k, const auto& stencil) {
      gatherInto(gathered[k], stencil, windowOf<const NodeRecord>(record, stencil));
    });
    return lanesOf(gathered, count);
  }
}

}  // namespace tushar::mpm::solid
