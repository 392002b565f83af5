#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "components/mpm/solid/transfer/node_record.hpp"

namespace tushar::mpm::solid {

/// Records of nodes relative to one of them: those along x are next to each other.
template <class Record, int D>
struct NodeWindow {
  Record* origin;                          ///< of the first node that a particle touches
  std::array<std::ptrdiff_t, D> stride{};  ///< records from one node to the next along each axis
};

/// The factors of a row of nodes along the first axis, in the lanes: of S, and of its slopes along the second and
/// third.
using RowFactors = Quad;

/// Factors of rows j from the second axis, and of rows k from the third.
template <class Stencil>
[[gnu::always_inline]] inline RowFactors secondFactors(const Stencil& stencil, std::size_t j) {
  return __builtin_shufflevector(stencil.s[j], stencil.ds[j], 1, 5, 1, 1);
}
template <class Stencil>
[[gnu::always_inline]] inline RowFactors thirdFactors(const Stencil& stencil, std::size_t k) {
  return __builtin_shufflevector(stencil.s[k], stencil.ds[k], 2, 2, 6, 2);
}

/// Calls `visit(offset, factors)` for each row of nodes that a particle touches.
template <class Stencil, int D, class Visit>
[[gnu::always_inline]] inline void forEachRow(const Stencil& stencil,
                                              const std::array<std::ptrdiff_t, Stencil::dimension>& stride,
                                              Visit&& visit) {
  constexpr int n = Stencil::nodes;
  if constexpr (D == 1) {
    visit(std::ptrdiff_t{0}, quadOf(1.0));
  } else {
    std::array<Quad, n> second;
    for (std::size_t j = 0; j < n; ++j) second[j] = secondFactors(stencil, j);
    if constexpr (D == 2) {
      for (std::size_t j = 0; j < n; ++j) visit(static_cast<std::ptrdiff_t>(j) * stride[1], second[j]);
    } else {
      for (std::size_t k = 0; k < n; ++k) {
        const Quad third = thirdFactors(stencil, k);
        for (std::size_t j = 0; j < n; ++j)
          visit(static_cast<std::ptrdiff_t>(j) * stride[1] + static_cast<std::ptrdiff_t>(k) * stride[2],
                second[j] * third);
      }
    }
  }
}

/// The contribution of a particle to a row of nodes along the first axis, without the factors of that axis.
struct RowShare {
  Octet value, change, round;

  template <std::size_t D>
  [[gnu::always_inline]] RowShare(const RowFactors& f, const NodeRecord& of, const std::array<Quad, D>& slope,
                                  const Quad& hoop) {
    const Quad share = broadcast<0>(f);
    Quad high = share * of.high;
    if constexpr (D > 1) high = multiplyAdd(broadcast<1>(f), slope[1], high);
    if constexpr (D > 2) high = multiplyAdd(broadcast<2>(f), slope[2], high);
    value = Octet(share * of.low, high);
    change = Octet(Quad{}, share * slope[0]);
    round = Octet(Quad{}, share * hoop);
  }

  /// To node i of the row.
  template <class Stencil>
  [[gnu::always_inline]] void addTo(NodeRecord& record, const Stencil& stencil, std::size_t i) const {
    Octet sum = multiplyAdd(stencil.s[i][0], value, multiplyAddHigh(stencil.ds[i][0], change, Octet(record)));
    if constexpr (Stencil::axisymmetric) sum = multiplyAddHigh(stencil.hoop[i], round, sum);
    sum.copyTo(record);
  }
};

/// record_i += S_i value, and to its high half sum_d dS_i/dx_d slope_d (+ S_i / r hoop where axisymmetric), for the
/// nodes i of a stencil.
template <class Stencil, int D = Stencil::dimension>
[[gnu::always_inline]] inline void scatter(const Stencil& stencil, const NodeWindow<NodeRecord, D>& nodes,
                                           const NodeRecord& value, const std::array<Quad, Stencil::dimension>& slope,
                                           const Quad& hoop = Quad{}) {
  forEachRow<Stencil, D>(stencil, nodes.stride, [&](std::ptrdiff_t offset, const RowFactors& f) {
    const RowShare share(f, value, slope, hoop);
    for (std::size_t i = 0; i < Stencil::nodes; ++i)
      share.addTo(nodes.origin[offset + static_cast<std::ptrdiff_t>(i)], stencil, i);
  });
}

/// Calls `visit` for the numbers from `first` up to `end` that are below n: written out, so that each is a constant.
template <int n, class Visit>
[[gnu::always_inline]] inline void forEachOf(int first, int end, Visit&& visit) {
#pragma GCC unroll 8
  for (int k = 0; k < n; ++k)
    if (k >= first && k < end) visit(k);
}

/// scatter to those nodes of a stencil that lie within a box; `origin` is where the record of the first node would
/// stand, stored or not.
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
  const auto addRow = [&](std::ptrdiff_t offset, const RowFactors& f) {
    const RowShare share(f, value, slope, hoop);
    forEachOf<Stencil::nodes>(
        first[0], end[0], [&](int i) { share.addTo(nodes.origin[offset + i], stencil, static_cast<std::size_t>(i)); });
  };
  if constexpr (D == 1) {
    addRow(0, quadOf(1.0));
  } else if constexpr (D == 2) {
    for (int j = first[1]; j < end[1]; ++j) addRow(j * nodes.stride[1], secondFactors(stencil, j));
  } else {
    for (int k = first[2]; k < end[2]; ++k)
      for (int j = first[1]; j < end[1]; ++j)
        addRow(j * nodes.stride[1] + k * nodes.stride[2], secondFactors(stencil, j) * thirdFactors(stencil, k));
  }
}

/// The values that a particle interpolates from the nodes: sum_i S_i record_i; of the low halves the gradient and sum_i
/// S_i / r record_i, too.
template <int D>
struct Gathered {
  NodeRecord value{};
  std::array<Quad, D> gradient{};
  Quad hoop{};
};

template <class Stencil, int D = Stencil::dimension>
[[gnu::always_inline]] inline Gathered<D> gather(const Stencil& stencil, const NodeWindow<const NodeRecord, D>& nodes) {
  Octet value;
  Gathered<D> sums;
  forEachRow<Stencil, D>(stencil, nodes.stride, [&](std::ptrdiff_t offset, const RowFactors& f) {
    const NodeRecord* row = nodes.origin + offset;
    const Octet first(row[0]);
    Octet both = stencil.s[0][0] * first;
    Quad change = stencil.ds[0][0] * first.low(), round{};
    if constexpr (Stencil::axisymmetric) round = stencil.hoop[0] * first.low();
    for (std::size_t i = 1; i < Stencil::nodes; ++i) {
      const Octet record(row[i]);
      both = multiplyAdd(stencil.s[i][0], record, both);
      change = multiplyAdd(stencil.ds[i][0], record.low(), change);
      if constexpr (Stencil::axisymmetric) round = multiplyAdd(stencil.hoop[i], record.low(), round);
    }
    value = multiplyAdd(f[0], both, value);
    sums.gradient[0] = multiplyAdd(f[0], change, sums.gradient[0]);
    if constexpr (D > 1) sums.gradient[1] = multiplyAdd(f[1], both.low(), sums.gradient[1]);
    if constexpr (D > 2) sums.gradient[2] = multiplyAdd(f[2], both.low(), sums.gradient[2]);
    if constexpr (Stencil::axisymmetric) sums.hoop = multiplyAdd(f[0], round, sums.hoop);
  });
  value.copyTo(sums.value);
  return sums;
}

}  // namespace tushar::mpm::solid
