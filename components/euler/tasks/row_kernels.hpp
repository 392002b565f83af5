#pragma once

#include "components/euler/blend.hpp"
#include "components/euler/fluxes.hpp"
#include "components/euler/rows.hpp"

// The equations, as loops over the cells of a row. No iteration reads what another one writes, as the pragma ivdep
// declares. All loops except that of the exact flux are vectorised; the values of a cell are bitwise independent of
// where its row begins.

namespace tushar::euler {

template <int D, int K = 1>
using Pointers = typename Rows<D, K>::Pointers;

/// Whether states of gases contain G and S in place of volume fractions; never those of one gas.
template <class G>
constexpr bool areBlended(const G&) {
  return false;
}
template <int K>
constexpr bool areBlended(const Mixture<K>& gases) {
  return gases.blend != nullptr;
}

/// Computes rho, v, p of `count` cells from rho, rho v (D numbers per cell) and E; for several gases, `w` already
/// contains the masses and volume fractions.
template <int D, class G>
void recoverRow(const G& gas, const double* density, const double* momentum, const double* energy, int count,
                const Pointers<D, kGases<G>>& w) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    State<D, kGases<G>> u;
    for (std::size_t k = D + 2; k < u.size(); ++k) u[k] = w[k][i];
    u[kDensity] = density[i];
    for (int k = 0; k < D; ++k) u[kVelocity(k)] = momentum[i * D + k];
    u[kPressure<D>] = energy[i];
    store<D>(w, i, primitive<D>(gas, u));
  }
}

/// Like recoverRow for gases with laws of their own: also computes G and S, in place of the volume fractions.
template <int D, int K>
void blendRow(const BlendLaws& laws, const double* density, const double* momentum, const double* energy, int count,
              const Pointers<D, K>& w) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    State<D, K> u;
    for (std::size_t k = D + 2; k < u.size(); ++k) u[k] = w[k][i];
    u[kDensity] = density[i];
    for (int k = 0; k < D; ++k) u[kVelocity(k)] = momentum[i * D + k];
    u[kPressure<D>] = energy[i];
    store<D>(w, i, laws.recover<D, K>(u));
  }
}

/// Computes w -+ slope / 2 for one component, with a limited slope from the rows of the neighbours below and above.
template <class Limited>
void reconstructRow(const double* below, const double* w, const double* above, int count, double* lower,
                    double* upper) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double half = Limited::half(w[i] - below[i], above[i] - w[i]);
    lower[i] = w[i] - half;
    upper[i] = w[i] + half;
  }
}

/// Computes the flux F along an axis from primitive values.
template <int D, int Axis, class G, class Number, std::size_t N>
[[gnu::always_inline]] inline std::array<Number, N> fluxOf(const G& gas, const std::array<Number, N>& w) {
  FaceState<D, kGases<G>, Number> face;
  for (std::size_t k = 0; k < N; ++k) face.w[k] = w[k];
  face.energy = conserved<D>(gas, w)[kPressure<D>];
  face.w[kPressure<D>] = lawIn<D>(gas, w).pressureOf(w[kDensity], w[kPressure<D>]);
  return fluxOf<D, Axis>(face);
}

/// Adds to `change` the half-step change of cells due to the fluxes of their own face values along an axis (Toro,
/// section 14.4); `ratio` is dt / 2 h.
template <int D, int Axis, class G>
void halfStepRow(const G& gas, const Pointers<D, kGases<G>>& lower, const Pointers<D, kGases<G>>& upper, double ratio,
                 int count, const Pointers<D, kGases<G>>& change) {
  constexpr int gases = kGases<G>;
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto below = load<D>(lower, i), above = load<D>(upper, i);
    const auto in = fluxOf<D, Axis>(gas, below), out = fluxOf<D, Axis>(gas, above);
    State<D, gases> sum = Axis == 0 ? State<D, gases>{} : load<D>(change, i);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += ratio * (in[k] - out[k]);
    if constexpr (gases > 1) {
      const double narrows = ratio * (below[kVelocity(Axis)] - above[kVelocity(Axis)]);
      for (std::size_t k = kShare<D, gases>(0); k < sum.size(); ++k) sum[k] -= 0.5 * (below[k] + above[k]) * narrows;
    }
    store<D>(change, i, sum);
  }
}

/// Changes primitive values by a change of the conserved ones. Lowers `least` to the smallest density and p + p_inf
/// found (for a gas with its own law, its heat), and below 0 if one of several gases has a negative amount. Negative
/// traces, below round-off of the whole, count as none and become 0: they must not change how the whole moves.
template <int D, class G>
void changeRow(const G& gas, const Pointers<D, kGases<G>>& change, int count, const Pointers<D, kGases<G>>& values,
               double* least) {
  constexpr double trace = 1e-14;
  const bool haveShares = !areBlended(gas);  // in place of volume fractions there may be numbers of any sign
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    State<D, kGases<G>> u = conserved<D>(gas, load<D>(values, i));
    for (std::size_t k = 0; k < u.size(); ++k) u[k] += change[k][i];
    State<D, kGases<G>> w = primitive<D>(gas, u);
    const double stiff = lawIn<D>(gas, w).heat(w[kDensity], w[kPressure<D>]);
    double lower = w[kDensity] < stiff ? w[kDensity] : stiff;
    if constexpr (constexpr int gases = kGases<G>; gases > 1)
      for (int k = 0; k < gases; ++k) {
        double &mass = w[kMass<D>(k)], &share = w[kShare<D, gases>(k)];
        lower = mass < -trace * w[kDensity] ? -1.0 : lower;
        lower = haveShares && share < -trace ? -1.0 : lower;
        mass = mass < 0 ? 0.0 : mass;
        share = haveShares && share < 0 ? 0.0 : share;
      }
    least[i] = lower < least[i] ? lower : least[i];
    store<D>(values, i, w);
  }
}

/// Scales the masses and volume fractions of several gases so that the fractions add up to 1, and sets the density to
/// the sum of the masses; limited slopes need not be consistent.
template <int D, int K>
void closeRow(int count, const Pointers<D, K>& values) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double shares = 0, density = 0;
    for (int k = 0; k < K; ++k) shares += values[kShare<D, K>(k)][i];
    for (std::size_t k = D + 2; k < values.size(); ++k) values[k][i] /= shares;
    for (int k = 0; k < K; ++k) density += values[kMass<D>(k)][i];
    values[kDensity][i] = density;
  }
}

/// Sets the density of gases with laws of their own to the sum of their masses, and S so that the energy per volume e =
/// p G + S has a limited slope, like the masses; `sign` is -1 for the lower faces of the cells, 1 for the upper ones.
/// So p and v stay uniform across a contact.
template <class Limited, int D, int K>
void closeBlendRow(const Pointers<D, K>& below, const Pointers<D, K>& w, const Pointers<D, K>& above, int count,
                   double sign, const Pointers<D, K>& values) {
  const auto energy = [](const Pointers<D, K>& of, std::ptrdiff_t i) {
    return of[kPressure<D>][i] * of[kShare<D, K>(0)][i] + of[kShare<D, K>(1)][i];
  };
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double density = 0;
    for (int k = 0; k < K; ++k) density += values[kMass<D>(k)][i];
    values[kDensity][i] = density;
    const double own = energy(w, i), slope = Limited::slope(own - energy(below, i), energy(above, i) - own);
    values[kShare<D, K>(1)][i] = own + sign * 0.5 * slope - values[kPressure<D>][i] * values[kShare<D, K>(0)][i];
  }
}

/// Makes the state constant in each cell in which `least` is not positive: sets the values at both faces to those of
/// the cell.
template <int D, int K = 1>
void flattenRow(const double* least, const Pointers<D, K>& w, int count, const Pointers<D, K>& lower,
                const Pointers<D, K>& upper) {
  for (std::ptrdiff_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < w.size() && !(least[i] > 0); ++k) lower[k][i] = upper[k][i] = w[k][i];
}

/// Computes the fluxes along `Axis` through the lower faces of `count` cells, from the states on both sides.
template <int D, class Flux, int Axis, class G>
void fluxRow(const G& gas, const Pointers<D, kGases<G>>& below, const Pointers<D, kGases<G>>& above, int count,
             const Pointers<D, kGases<G>>& flux) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i)
    store<D>(flux, i, fluxOf<D, Axis>(Flux::template solve<D, Axis>(gas, load<D>(below, i), load<D>(above, i))));
}

/// Computes new = old - ratio (flux of the upper face - flux of the lower face) for one component. In `old` and
/// `result`, which may be the same array, neighbouring cells are `step` places apart.
inline void updateRow(const double* old, const double* below, const double* above, double ratio, int step, int count,
                      double* result) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) result[i * step] = old[i * step] - ratio * (above[i] - below[i]);
}

/// Updates a volume fraction, which is not conserved as mass is: z' = z - ratio (F_upper - F_lower - z (v_upper -
/// v_lower)). The velocity v of a face is the sum of the fluxes of all volume fractions, since these add up to 1. So
/// uniform volume fractions stay uniform.
template <int K>
void updateShareRow(const double* start, const double* old, const std::array<const double*, K>& below,
                    const std::array<const double*, K>& above, int gas, double ratio, int count, double* result) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double widens = 0;
    for (int k = 0; k < K; ++k) widens += above[k][i] - below[k][i];
    result[i] = old[i] - ratio * (above[gas][i] - below[gas][i] - start[i] * widens);
  }
}

}  // namespace tushar::euler
