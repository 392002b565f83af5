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

/// Limited slopes per cell width, of one number; neighbours are `stride` apart.
template <class Limited>
void limitRow(const double* w, std::ptrdiff_t stride, int count, double* slope) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) slope[i] = Limited::slope(w[i] - w[i - stride], w[i + stride] - w[i]);
}

/// dW/dt dt/2 = -sum_d A_d(W) slope_d (dt / 2 h_d), Toro (14.39)-(14.40) with `halfStep` = dt / 2 h_d of each axis.
template <int D>
State<D> halfStepChange(const Gas& gas, const State<D>& w,
                        const std::array<State<D>, static_cast<std::size_t>(D)>& slope,
                        const std::array<double, 3>& halfStep) {
  const double inverse = 1 / w[kDensity];
  const double stiffness = gas.gamma * (w[kPressure<D>] + gas.pInfinity);
  State<D> change{};
  for (int d = 0; d < D; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    const State<D>& s = slope[axis];
    const double h = halfStep[axis], u = w[kVelocity(d)];
    change[kDensity] -= h * (u * s[kDensity] + w[kDensity] * s[kVelocity(d)]);
    for (int k = 0; k < D; ++k)
      change[kVelocity(k)] -= h * (k == d ? u * s[kVelocity(k)] + s[kPressure<D>] * inverse : u * s[kVelocity(k)]);
    change[kPressure<D>] -= h * (u * s[kPressure<D>] + stiffness * s[kVelocity(d)]);
  }
  return change;
}

/// W half a step later. Where a face of the cell would lose its positive density or p + p_inf: W itself, and no slope.
template <int D>
void predictRow(const Gas& gas, const std::array<double, 3>& halfStep, const Pointers<D>& w,
                const AxisPointers<D>& slopes, int count, const Pointers<D>& predicted) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const State<D> before = load<D>(w, i);
    std::array<State<D>, static_cast<std::size_t>(D)> slope;
    for (std::size_t d = 0; d < slope.size(); ++d) slope[d] = load<D>(slopes[d], i);
    const State<D> change = halfStepChange<D>(gas, before, slope, halfStep);
    double densityDrop = 0, pressureDrop = 0;
    for (const State<D>& s : slope) {
      const double density = 0.5 * std::abs(s[kDensity]), pressure = 0.5 * std::abs(s[kPressure<D>]);
      densityDrop = density > densityDrop ? density : densityDrop;
      pressureDrop = pressure > pressureDrop ? pressure : pressureDrop;
    }
    const double leastDensity = before[kDensity] + change[kDensity] - densityDrop;
    const double leastPressure = before[kPressure<D>] + change[kPressure<D>] + gas.pInfinity - pressureDrop;
    const double least = leastDensity < leastPressure ? leastDensity : leastPressure;
    const double keep = least > 0 ? 1.0 : 0.0;
    for (std::size_t k = 0; k < before.size(); ++k) {
      predicted[k][i] = before[k] + keep * change[k];
      for (std::size_t d = 0; d < slope.size(); ++d) slopes[d][k][i] = keep * slope[d][k];
    }
  }
}

/// Fluxes through the lower faces of `count` cells across `Axis`, from constant cells.
template <int D, class Flux, int Axis>
void fluxRow(const Gas& gas, const Pointers<D>& w, std::ptrdiff_t stride, int count, const Pointers<D>& flux) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i)
    store<D>(flux, i, fluxOf<D, Axis>(Flux::template solve<D, Axis>(gas, load<D>(w, i - stride), load<D>(w, i))));
}

/// The same from cells with slopes.
template <int D, class Flux, int Axis>
void slopedFluxRow(const Gas& gas, const Pointers<D>& w, const Pointers<D>& slope, std::ptrdiff_t stride, int count,
                   const Pointers<D>& flux) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    State<D> left, right;
    for (std::size_t k = 0; k < left.size(); ++k) {
      left[k] = w[k][i - stride] + 0.5 * slope[k][i - stride];
      right[k] = w[k][i] - 0.5 * slope[k][i];
    }
    store<D>(flux, i, fluxOf<D, Axis>(Flux::template solve<D, Axis>(gas, left, right)));
  }
}

/// new = old - ratio (flux of the upper face - flux of the lower face) of one number, `step` apart in old and new,
/// which may be the same.
inline void updateRow(const double* old, const double* flux, std::ptrdiff_t stride, double ratio, int step, int count,
                      double* result) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) result[i * step] = old[i * step] - ratio * (flux[i + stride] - flux[i]);
}

}  // namespace tushar::euler
