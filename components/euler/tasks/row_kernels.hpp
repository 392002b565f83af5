#pragma once

#include "components/euler/fluxes.hpp"
#include "components/euler/rows.hpp"

// The equations, as loops over the cells of a row. Rows overlap nowhere but where a comment says so, which the
// compiler is told by ivdep; all loops vectorise, with the same bits for each cell wherever a row begins.

namespace tushar::euler {

template <int D>
using Pointers = typename Rows<D>::Pointers;
template <int D>
using AxisPointers = std::array<Pointers<D>, static_cast<std::size_t>(D)>;

/// rho, v, p of `count` cells whose rho, rho v (D numbers per cell) and E are given.
template <int D>
void recoverRow(const Gas& gas, const double* density, const double* momentum, const double* energy, int count,
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

/// The values at both faces of a cell across each axis.
template <int D>
struct FaceValues {
  std::array<State<D>, static_cast<std::size_t>(D)> lower, upper;
};

/// W -+ slope / 2, with the limited slopes of cell `i`; neighbours along axis d are `stride[d]` apart.
template <int D, class Limited>
FaceValues<D> reconstruct(const Pointers<D>& w, const std::array<std::ptrdiff_t, 3>& stride, std::ptrdiff_t i) {
  FaceValues<D> faces;
  for (std::size_t d = 0; d < faces.lower.size(); ++d)
    for (std::size_t k = 0; k < w.size(); ++k) {
      const double half = 0.5 * Limited::slope(w[k][i] - w[k][i - stride[d]], w[k][i + stride[d]] - w[k][i]);
      faces.lower[d][k] = w[k][i] - half;
      faces.upper[d][k] = w[k][i] + half;
    }
  return faces;
}

/// F of primitive values, across an axis.
template <int D, int Axis>
State<D> fluxOf(const Gas& gas, const State<D>& w) {
  return fluxOf<D, Axis>(FaceState<D>{w, conserved<D>(gas, w)[kPressure<D>]});
}

/// Adds what the fluxes of a cell's own face values bring in half a step, Toro (14.42); `ratio` is dt / 2 h.
template <int D, int Axis>
void addHalfStep(const Gas& gas, const FaceValues<D>& faces, double ratio, State<D>& change) {
  const State<D> in = fluxOf<D, Axis>(gas, faces.lower[Axis]), out = fluxOf<D, Axis>(gas, faces.upper[Axis]);
  for (std::size_t k = 0; k < change.size(); ++k) change[k] += ratio * (in[k] - out[k]);
}

/// Primitive values after a change of the conserved ones.
template <int D>
State<D> later(const Gas& gas, const State<D>& w, const State<D>& change) {
  State<D> u = conserved<D>(gas, w);
  for (std::size_t k = 0; k < u.size(); ++k) u[k] += change[k];
  return primitive<D>(gas, u);
}

/// W at the faces of `count` cells half a step later; W of the cell itself at all of them where a face would lose its
/// positive density or p + p_inf. `ratio` is dt / 2 h of each axis.
template <int D, class Limited>
void predictRow(const Gas& gas, const Pointers<D>& w, const std::array<std::ptrdiff_t, 3>& stride,
                const std::array<double, 3>& ratio, int count, const AxisPointers<D>& lower,
                const AxisPointers<D>& upper) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    FaceValues<D> faces = reconstruct<D, Limited>(w, stride, i);
    State<D> change{};
    addHalfStep<D, 0>(gas, faces, ratio[0], change);
    if constexpr (D > 1) addHalfStep<D, 1>(gas, faces, ratio[1], change);
    if constexpr (D > 2) addHalfStep<D, 2>(gas, faces, ratio[2], change);
    double least = 1;
    for (auto* side : {&faces.lower, &faces.upper})
      for (State<D>& face : *side) {
        face = later<D>(gas, face, change);
        const double stiff = face[kPressure<D>] + gas.pInfinity;
        least = face[kDensity] < least ? face[kDensity] : least;
        least = stiff < least ? stiff : least;
      }
    for (std::size_t d = 0; d < lower.size(); ++d)
      for (std::size_t k = 0; k < w.size(); ++k) {
        lower[d][k][i] = least > 0 ? faces.lower[d][k] : w[k][i];
        upper[d][k][i] = least > 0 ? faces.upper[d][k] : w[k][i];
      }
  }
}

/// Fluxes through the lower faces of `count` cells across `Axis`, between what stands on both sides.
template <int D, class Flux, int Axis>
void fluxRow(const Gas& gas, const Pointers<D>& below, const Pointers<D>& above, int count, const Pointers<D>& flux) {
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
