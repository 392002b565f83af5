#pragma once

#include <array>
#include <cstddef>

#include "components/mpm/solid/kernels/octet.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// Records of nodes as one sees them from a node: those along x are next to each other.
template <class Record, int D>
struct NodeWindow {
  Record* origin;                          ///< of the first node that a particle touches
  std::array<std::ptrdiff_t, D> stride{};  ///< records from one node to the next along each axis
};

/// The factors of a row of nodes along the first axis: of S, and of its slopes along the other axes.
template <int D>
struct RowFactors {
  double s = 1;
  std::array<double, D> slope{};  ///< [0] is unused
};

/// Calls `visit(offset, factors)` for each row of nodes that a particle touches.
template <class Stencil, int D, class Visit>
[[gnu::always_inline]] inline void forEachRow(const Stencil& stencil,
                                              const std::array<std::ptrdiff_t, Stencil::dimension>& stride,
                                              Visit&& visit) {
  constexpr int n = Stencil::nodes;
  if constexpr (D == 1) {
    visit(std::ptrdiff_t{0}, RowFactors<1>{});
  } else if constexpr (D == 2) {
    for (std::size_t j = 0; j < n; ++j)
      visit(static_cast<std::ptrdiff_t>(j) * stride[1], RowFactors<2>{stencil.s[1][j], {0, stencil.ds[1][j]}});
  } else {
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j) {
        const double s = stencil.s[1][j] * stencil.s[2][k];
        visit(static_cast<std::ptrdiff_t>(j) * stride[1] + static_cast<std::ptrdiff_t>(k) * stride[2],
              RowFactors<3>{s, {0, stencil.ds[1][j] * stencil.s[2][k], stencil.s[1][j] * stencil.ds[2][k]}});
      }
  }
}

/// record_i += S_i value, and to its high half sum_d dS_i/dx_d slope_d (+ S_i / r hoop where axisymmetric), for the nodes
/// i of a stencil.
template <class Stencil, int D = Stencil::dimension>
[[gnu::always_inline]] inline void scatter(const Stencil& stencil, const NodeWindow<Octet, D>& nodes, const Octet& value,
                                           const std::array<Quad, Stencil::dimension>& slope, const Quad& hoop = Quad{}) {
  forEachRow<Stencil, D>(stencil, nodes.stride, [&](std::ptrdiff_t offset, const RowFactors<D>& f) {
    const Quad low = f.s * value.low, change = f.s * slope[0], round = f.s * hoop;
    Quad high = f.s * value.high;
    for (std::size_t d = 1; d < D; ++d) high = multiplyAdd(f.slope[d], slope[d], high);
    Octet* row = nodes.origin + offset;
    for (std::size_t i = 0; i < Stencil::nodes; ++i) {
      row[i].low = multiplyAdd(stencil.s[0][i], low, row[i].low);
      row[i].high = multiplyAdd(stencil.s[0][i], high, multiplyAdd(stencil.ds[0][i], change, row[i].high));
      if constexpr (Stencil::axisymmetric) row[i].high = multiplyAdd(stencil.hoop[i], round, row[i].high);
    }
  });
}

/// What a particle takes from the nodes: sum_i S_i record_i; of the low halves the gradient and sum_i S_i / r record_i, too.
template <int D>
struct Gathered {
  Octet value{};
  std::array<Quad, D> gradient{};
  Quad hoop{};
};

template <class Stencil, int D = Stencil::dimension>
[[gnu::always_inline]] inline Gathered<D> gather(const Stencil& stencil, const NodeWindow<const Octet, D>& nodes) {
  Gathered<D> sums;
  forEachRow<Stencil, D>(stencil, nodes.stride, [&](std::ptrdiff_t offset, const RowFactors<D>& f) {
    const Octet* row = nodes.origin + offset;
    Quad low = stencil.s[0][0] * row[0].low, high = stencil.s[0][0] * row[0].high;
    Quad change = stencil.ds[0][0] * row[0].low, round{};
    if constexpr (Stencil::axisymmetric) round = stencil.hoop[0] * row[0].low;
    for (std::size_t i = 1; i < Stencil::nodes; ++i) {
      low = multiplyAdd(stencil.s[0][i], row[i].low, low);
      high = multiplyAdd(stencil.s[0][i], row[i].high, high);
      change = multiplyAdd(stencil.ds[0][i], row[i].low, change);
      if constexpr (Stencil::axisymmetric) round = multiplyAdd(stencil.hoop[i], row[i].low, round);
    }
    sums.value.low = multiplyAdd(f.s, low, sums.value.low);
    sums.value.high = multiplyAdd(f.s, high, sums.value.high);
    sums.gradient[0] = multiplyAdd(f.s, change, sums.gradient[0]);
    for (std::size_t d = 1; d < D; ++d) sums.gradient[d] = multiplyAdd(f.slope[d], low, sums.gradient[d]);
    if constexpr (Stencil::axisymmetric) sums.hoop = multiplyAdd(f.s, round, sums.hoop);
  });
  return sums;
}

}  // namespace tushar::mpm::solid
