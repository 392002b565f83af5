#pragma once

#include "components/euler/fluxes.hpp"
#include "components/euler/rows.hpp"

// The equations, as loops over the cells of a row. No iteration of a loop reads what another one writes, which
// ivdep tells the compiler; all loops but that of the exact flux vectorise, to the same bits of a cell wherever its row
// begins.

namespace tushar::euler {

template <int D>
using Pointers = typename Rows<D>::Pointers;

/// rho, v, p of `count` cells whose rho, rho v (D numbers per cell) and E are given.
template <int D, class G>
void recoverRow(const G& gas, const double* density, const double* momentum, const double* energy, int count,
                const Pointers<D>& w) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    State<D> u;
    u[kDensity] = density[i];
    for (int k = 0; k < D; ++k) u[kVelocity(k)] = momentum[i * D + k];
    u[kPressure<D>] = energy[i];
    store<D>(w, i, primitive<D>(gas, u));
  }
}

/// w -+ slope / 2 of one number, with limited slopes; neighbours are `stride` apart.
template <class Limited>
void reconstructRow(const double* w, std::ptrdiff_t stride, int count, double* lower, double* upper) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double half = 0.5 * Limited::slope(w[i] - w[i - stride], w[i + stride] - w[i]);
    lower[i] = w[i] - half;
    upper[i] = w[i] + half;
  }
}

/// F of primitive values, across an axis.
template <int D, int Axis, class G>
State<D> fluxOf(const G& gas, const State<D>& w) {
  FaceState<D> face{w, conserved<D>(gas, w)[kPressure<D>]};
  face.w[kPressure<D>] = gas.pressureOf(w[kDensity], w[kPressure<D>]);
  return fluxOf<D, Axis>(face);
}

/// Adds the half-step change of a cell by the fluxes of its own face values across an axis (Toro, section 14.4) to the
/// change by the previous axes; `ratio` is dt / 2 h.
template <int D, int Axis, class G>
void halfStepRow(const G& gas, const Pointers<D>& lower, const Pointers<D>& upper, double ratio, int count,
                 const Pointers<D>& change) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const State<D> in = fluxOf<D, Axis>(gas, load<D>(lower, i)), out = fluxOf<D, Axis>(gas, load<D>(upper, i));
    State<D> sum = Axis == 0 ? State<D>{} : load<D>(change, i);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += ratio * (in[k] - out[k]);
    store<D>(change, i, sum);
  }
}

/// Changes primitive values by a change of the conserved ones; lowers `least` to the density and p + p_inf, or
/// what a law has in its place, found.
template <int D, class G>
void changeRow(const G& gas, const Pointers<D>& change, int count, const Pointers<D>& values, double* least) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    State<D> u = conserved<D>(gas, load<D>(values, i));
    for (std::size_t k = 0; k < u.size(); ++k) u[k] += change[k][i];
    const State<D> w = primitive<D>(gas, u);
    const double stiff = gas.heat(w[kDensity], w[kPressure<D>]);
    const double lower = w[kDensity] < stiff ? w[kDensity] : stiff;
    least[i] = lower < least[i] ? lower : least[i];
    store<D>(values, i, w);
  }
}

/// Treats cells whose `least` is not positive as constant: their values at both faces become those of the cell.
template <int D>
void flattenRow(const double* least, const Pointers<D>& w, int count, const Pointers<D>& lower,
                const Pointers<D>& upper) {
  for (std::ptrdiff_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < w.size() && !(least[i] > 0); ++k) lower[k][i] = upper[k][i] = w[k][i];
}

/// Fluxes through the lower faces of `count` cells across `Axis`, from the states on both sides.
template <int D, class Flux, int Axis, class G>
void fluxRow(const G& gas, const Pointers<D>& below, const Pointers<D>& above, int count, const Pointers<D>& flux) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i)
    store<D>(flux, i, fluxOf<D, Axis>(Flux::template solve<D, Axis>(gas, load<D>(below, i), load<D>(above, i))));
}

/// new = old - ratio (flux of the upper face - flux of the lower face) of one number, `step` apart in old and new,
/// which may be the same.
inline void updateRow(const double* old, const double* flux, std::ptrdiff_t stride, double ratio, int step, int count,
                      double* result) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) result[i * step] = old[i * step] - ratio * (flux[i + stride] - flux[i]);
}

}  // namespace tushar::euler
