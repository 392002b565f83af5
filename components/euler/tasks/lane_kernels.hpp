#pragma once

#include "components/euler/state_views.hpp"
#include "components/euler/tasks/row_kernels.hpp"

// Parts of a step of one stiffened gas, for several cells at a time in the vector registers of the processor. The
// values of a cell are bitwise equal to those of row_kernels.hpp.

namespace tushar::euler {

/// Addresses of the conserved values of a row of cells; `momentum` contains D numbers per cell.
template <class T>
struct ConservedRow {
  T *density, *momentum, *energy;
};
/// The addresses of a row of `count` cells in views of a state.
template <int D, class T>
ConservedRow<T> conservedRow(const StateViews<D, T>& of, const Index<D>& first, int count) {
  return {rowOf(of.density, first, count), rowOf(of.momentum, first, count)->data(),
          rowOf(of.totalEnergy, first, count)};
}

/// The conserved values of the cell at position `i`, or of the cells that begin there.
template <int D, class Number>
[[gnu::always_inline]] inline State<D, 1, Number> loadConserved(const ConservedRow<const double>& row,
                                                                std::ptrdiff_t i) {
  State<D, 1, Number> u;
  u[kDensity] = numberAt<Number>(row.density + i);
  u[kPressure<D>] = numberAt<Number>(row.energy + i);
  if constexpr (std::is_same_v<Number, Lanes>) {
    const auto momentum = unpack<D>(row.momentum + i * D);
    for (int d = 0; d < D; ++d) u[kVelocity(d)] = momentum[d];
  } else {
    for (int d = 0; d < D; ++d) u[kVelocity(d)] = row.momentum[i * D + d];
  }
  return u;
}
template <int D, class Number>
[[gnu::always_inline]] inline void storeConserved(const State<D, 1, Number>& u, const ConservedRow<double>& row,
                                                  std::ptrdiff_t i) {
  put(u[kDensity], row.density + i);
  put(u[kPressure<D>], row.energy + i);
  if constexpr (std::is_same_v<Number, Lanes>) {
    std::array<Lanes, D> momentum;
    for (int d = 0; d < D; ++d) momentum[d] = u[kVelocity(d)];
    pack(momentum, row.momentum + i * D);
  } else {
    for (int d = 0; d < D; ++d) row.momentum[i * D + d] = u[kVelocity(d)];
  }
}

/// Like recoverRow.
template <int D, class G>
void recoverLanes(G gas, ConservedRow<const double> row, int count, const Pointers<D>& w) {
  forEachRegister(
      count, [&]<class Number>(Number, std::ptrdiff_t i) __attribute__((always_inline)) {
        store<D>(w, i, primitive<D>(gas, loadConserved<D, Number>(row, i)));
      });
}

/// Addresses of a row of cells: its primitive values, those of its neighbours below and above along each axis, and
/// those at its lower and upper faces.
template <int D>
struct RowOfFaces {
  Pointers<D> w;
  std::array<Pointers<D>, D> below, above, lower, upper;
};

/// Primitive values at the faces of a cell, for each axis.
template <int D, class Number>
struct CellFaces {
  std::array<State<D, 1, Number>, D> lower, upper;
};

/// Computes limited values at the faces of a cell along an axis and adds the change of the cell in half a step due to
/// their fluxes; `ratio` is dt / 2 h.
template <int D, class Limited, int Axis, class Number, class G>
[[gnu::always_inline]] inline void reconstructCell(const G& gas, const RowOfFaces<D>& row, std::ptrdiff_t i,
                                                   const State<D, 1, Number>& w, double ratio,
                                                   CellFaces<D, Number>& faces, State<D, 1, Number>& change) {
  auto &lower = faces.lower[Axis], &upper = faces.upper[Axis];
#pragma GCC unroll 16
  for (std::size_t k = 0; k < w.size(); ++k) {
    const auto below = numberAt<Number>(row.below[Axis][k] + i), above = numberAt<Number>(row.above[Axis][k] + i);
    const Number half = Limited::half(w[k] - below, above - w[k]);
    lower[k] = w[k] - half;
    upper[k] = w[k] + half;
  }
  const auto in = fluxOf<D, Axis>(gas, lower), out = fluxOf<D, Axis>(gas, upper);
#pragma GCC unroll 16
  for (std::size_t k = 0; k < w.size(); ++k) change[k] += ratio * (in[k] - out[k]);
}

/// Changes primitive values by a change of the conserved ones. Lowers `least` to the density or p + p_inf.
template <int D, class Number, class G>
[[gnu::always_inline]] inline void changeFace(const G& gas, const State<D, 1, Number>& change, State<D, 1, Number>& w,
                                              Number& least) {
  auto u = conserved<D>(gas, w);
#pragma GCC unroll 16
  for (std::size_t k = 0; k < u.size(); ++k) u[k] += change[k];
  const auto changed = primitive<D>(gas, u);
#pragma GCC unroll 16
  for (std::size_t k = 0; k < u.size(); ++k) w[k] = changed[k];
  const Number stiff = gas.heat(w[kDensity], w[kPressure<D>]);
  const Number lower = select(w[kDensity] < stiff, w[kDensity], stiff);
  least = select(lower < least, lower, least);
}

/// Computes the values at the faces of a row of cells, half a step later; `ratio` is dt / 2 h along each axis. Cells
/// with an impossible value at a face get their own values at all faces.
template <int D, class Limited, class G>
void predictRow(G gas, const RowOfFaces<D>& row, std::array<double, D> ratio, int count) {
  forEachRegister(
      count, [&]<class Number>(Number, std::ptrdiff_t i) __attribute__((always_inline)) {
        const State<D, 1, Number> w = load<D, Number>(row.w, i);
        CellFaces<D, Number> faces;
        State<D, 1, Number> change;
        change.fill(0.0);
        reconstructCell<D, Limited, 0>(gas, row, i, w, ratio[0], faces, change);
        if constexpr (D > 1) reconstructCell<D, Limited, 1>(gas, row, i, w, ratio[1], faces, change);
        if constexpr (D > 2) reconstructCell<D, Limited, 2>(gas, row, i, w, ratio[2], faces, change);
        Number least = 1.0;
#pragma GCC unroll 16
        for (std::size_t d = 0; d < D; ++d) {
          changeFace<D>(gas, change, faces.lower[d], least);
          changeFace<D>(gas, change, faces.upper[d], least);
        }
        const auto isPossible = least > 0.0;
#pragma GCC unroll 16
        for (std::size_t d = 0; d < D; ++d)
#pragma GCC unroll 16
          for (std::size_t k = 0; k < w.size(); ++k) {
            put(select(isPossible, faces.lower[d][k], w[k]), row.lower[d][k] + i);
            put(select(isPossible, faces.upper[d][k], w[k]), row.upper[d][k] + i);
          }
      });
}

/// Like fluxRow.
template <int D, class Flux, int Axis, class G>
void fluxLanes(G gas, const Pointers<D>& below, const Pointers<D>& above, int count, const Pointers<D>& flux) {
  forEachRegister(
      count, [&]<class Number>(Number, std::ptrdiff_t i) __attribute__((always_inline)) {
        const auto face = Flux::template solve<D, Axis>(gas, load<D, Number>(below, i), load<D, Number>(above, i));
        store<D>(flux, i, fluxOf<D, Axis>(face));
      });
}

/// Computes new = old - sum_d ratio_d (flux of the upper face - flux of the lower face) for a row of cells, axis by
/// axis.
template <int D>
void updateLanes(const ConservedRow<const double>& old, const std::array<Pointers<D>, D>& below,
                 const std::array<Pointers<D>, D>& above, std::array<double, D> ratio, int count,
                 const ConservedRow<double>& fresh) {
  forEachRegister(
      count, [&]<class Number>(Number, std::ptrdiff_t i) __attribute__((always_inline)) {
        State<D, 1, Number> u = loadConserved<D, Number>(old, i);
#pragma GCC unroll 16
        for (std::size_t d = 0; d < D; ++d)
#pragma GCC unroll 16
          for (std::size_t k = 0; k < u.size(); ++k)
            u[k] -= ratio[d] * (numberAt<Number>(above[d][k] + i) - numberAt<Number>(below[d][k] + i));
        storeConserved<D>(u, fresh, i);
      });
}

}  // namespace tushar::euler
