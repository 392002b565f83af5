#pragma once

#include "components/euler/gas.hpp"
#include "components/reference/riemann_solution.hpp"

namespace tushar::euler {

/// The state of the gas at a face where two states meet: rho, v and the pressure in `w`, and the total energy per
/// volume.
template <int D, int K = 1, class Number = double>
struct FaceState {
  State<D, K, Number> w;
  Number energy;
};

/// The flux F = (m, m v + p n, (E + p) v_n) through a face normal to `Axis`, where m = rho v_n. For several gases, it
/// also contains the mass and the volume fraction of each gas, times v_n.
template <int D, int Axis, int K, class Number>
[[gnu::always_inline]] inline State<D, K, Number> fluxOf(const FaceState<D, K, Number>& face) {
  const Number normal = face.w[kVelocity(Axis)];
  const Number mass = face.w[kDensity] * normal;
  State<D, K, Number> flux;
  flux[kDensity] = mass;
  for (int k = 0; k < D; ++k) flux[kVelocity(k)] = mass * face.w[kVelocity(k)];
  flux[kVelocity(Axis)] += face.w[kPressure<D>];
  flux[kPressure<D>] = (face.energy + face.w[kPressure<D>]) * normal;
  for (std::size_t k = D + 2; k < flux.size(); ++k) flux[k] = face.w[k] * normal;
  return flux;
}

/// The squared speeds of sound in two states [m²/s²].
template <int D, class G, class Number, std::size_t N>
[[gnu::always_inline]] inline std::array<Number, 2> soundSpeedsSquared(const G& lawL, const std::array<Number, N>& left,
                                                                       const G& lawR,
                                                                       const std::array<Number, N>& right) {
  if constexpr (std::is_same_v<G, StiffenedGas>) {  // with one division
    const Number inverse = lawL.gamma / (left[kDensity] * right[kDensity]);
    return {lawL.heat(left[kDensity], left[kPressure<D>]) * right[kDensity] * inverse,
            lawR.heat(right[kDensity], right[kPressure<D>]) * left[kDensity] * inverse};
  } else {
    return {lawL.soundSpeedSquared(left[kDensity], left[kPressure<D>]),
            lawR.soundSpeedSquared(right[kDensity], right[kPressure<D>])};
  }
}

/// The approximate Riemann solver with three waves (HLLC).
///
/// Wave speeds: for the outer waves, those of both states and of Einfeldt's mean (section 10.5); for the contact,
/// (10.37). Between the waves: the states (10.39), with the mean of the two pressures (10.36). These are equal except
/// for round-off; the mean makes the flux of the mirrored problem bitwise mirrored. Source: E. F. Toro, Riemann Solvers
/// and Numerical Methods for Fluid Dynamics, 3rd ed., chapter 10.
struct Hllc {
  template <int D, int Axis, class G, class Number, std::size_t N>
  [[gnu::always_inline]] static FaceState<D, kGases<G>, Number> solve(const G& gas, const std::array<Number, N>& left,
                                                                      const std::array<Number, N>& right) {
    using std::sqrt;
    constexpr int gases = kGases<G>;
    const auto &lawL = lawIn<D>(gas, left), &lawR = lawIn<D>(gas, right);
    const Number rhoL = left[kDensity], uL = left[kVelocity(Axis)], pL = lawL.pressureOf(rhoL, left[kPressure<D>]);
    const Number rhoR = right[kDensity], uR = right[kVelocity(Axis)], pR = lawR.pressureOf(rhoR, right[kPressure<D>]);
    const auto [cL2, cR2] = soundSpeedsSquared<D>(lawL, left, lawR, right);
    // Einfeldt's mean, whose weights sqrt(rho) are multiplied by the sum of both, so that one root suffices.
    const Number root = sqrt(rhoL * rhoR), weightL = rhoL + root, weightR = rhoR + root, weights = weightL + weightR;
    const Number inWeights = 1.0 / weights, jump = uR - uL;
    const Number u = (weightL * uL + weightR * uR) * inWeights;
    const Number c = sqrt((weightL * cL2 + weightR * cR2 + 0.5 * root * (jump * jump)) * weights) * inWeights;
    const Number slowL = uL - sqrt(cL2), slow = u - c, fastR = uR + sqrt(cR2), fast = u + c;
    const Number sL = select(slowL < slow, slowL, slow);
    const Number sR = select(fastR > fast, fastR, fast);
    const Number mL = rhoL * (sL - uL), mR = rhoR * (sR - uR);
    const Number push = (pR - pL) + (mL * uL - mR * uR), inertia = mL - mR, contact = push / inertia;
    const Number pStar = 0.5 * ((pL + mL * (contact - uL)) + (pR + mR * (contact - uR)));

    const auto fromLeft = contact >= 0.0;
    const auto between = (sL < 0.0) & (sR > 0.0);
    FaceState<D, gases, Number> face;
    for (std::size_t k = 0; k < face.w.size(); ++k) face.w[k] = select(fromLeft, left[k], right[k]);
    const Number s = select(fromLeft, sL, sR);
    const Number m = select(fromLeft, mL, mR);
    const Number side = face.w[kVelocity(Axis)], p = select(fromLeft, pL, pR);
    const Number internal = lawIn<D>(gas, face.w).energyOf(face.w[kDensity], face.w[kPressure<D>]);
    const Number energy = internal + 0.5 * face.w[kDensity] * speedSquared<D>(face.w);
    const Number inverse = inertia / (s * inertia - push);  // 1 / (s - contact), without waiting for the contact
    const Number energyStar = ((s - side) * energy - p * side + pStar * contact) * inverse;
    const Number rhoStar = m * inverse;
    if constexpr (gases > 1) {
      const double thicker = between ? (s - side) * inverse : 1;
      for (int k = 0; k < gases; ++k) face.w[kMass<D>(k)] *= thicker;
    }
    face.w[kDensity] = select(between, rhoStar, face.w[kDensity]);
    face.w[kVelocity(Axis)] = select(between, contact, side);
    face.w[kPressure<D>] = select(between, pStar, p);
    face.energy = select(between, energyStar, energy);
    return face;
  }
};

/// The exact solution of the Riemann problem at x/t = 0 (Toro, chapter 4), for an ideal gas with the pressure p +
/// p_inf.
struct ExactFlux {
  template <int D, int Axis, class G>
  static FaceState<D> solve(const G& gas, const State<D>& left, const State<D>& right) {
    const auto side = [&](const State<D>& w) {
      return reference::RiemannState{w[kDensity], w[kVelocity(Axis)], w[kPressure<D>] + gas.pInfinity};
    };
    const reference::RiemannSolution solution = reference::solveRiemann(side(left), side(right), gas.gamma);
    const reference::RiemannState middle = solution.sample(0);
    FaceState<D> face;
    face.w = solution.starVelocity > 0 ? left : right;
    face.w[kDensity] = middle.density;
    face.w[kVelocity(Axis)] = middle.velocity;
    face.w[kPressure<D>] = middle.pressure - gas.pInfinity;
    face.energy = gas.energyOf(middle.density, face.w[kPressure<D>]) + 0.5 * face.w[kDensity] * speedSquared<D>(face.w);
    return face;
  }
};

}  // namespace tushar::euler
