#pragma once

#include "components/euler/gas.hpp"
#include "components/reference/riemann_solution.hpp"

namespace tushar::euler {

/// The state of the gas at a face where two states meet: rho, v and the pressure in `w`, and the total energy per
/// volume.
template <int D, int K = 1>
struct FaceState {
  State<D, K> w;
  double energy;
};

/// The flux F = (m, m v + p n, (E + p) v_n) through a face normal to `Axis`, where m = rho v_n. For several gases, it
/// also contains the mass and the volume fraction of each gas, times v_n.
template <int D, int Axis, int K>
State<D, K> fluxOf(const FaceState<D, K>& face) {
  const double normal = face.w[kVelocity(Axis)];
  const double mass = face.w[kDensity] * normal;
  State<D, K> flux;
  flux[kDensity] = mass;
  for (int k = 0; k < D; ++k) flux[kVelocity(k)] = mass * face.w[kVelocity(k)];
  flux[kVelocity(Axis)] += face.w[kPressure<D>];
  flux[kPressure<D>] = (face.energy + face.w[kPressure<D>]) * normal;
  for (std::size_t k = D + 2; k < flux.size(); ++k) flux[k] = face.w[k] * normal;
  return flux;
}

/// The approximate Riemann solver with three waves (HLLC).
///
/// Wave speeds: for the outer waves, those of both states and of Einfeldt's mean (section 10.5); for the contact,
/// (10.37). Between the waves: the states (10.39), with the mean of the two pressures (10.36). These are equal except
/// for round-off; the mean makes the flux of the mirrored problem bitwise mirrored. Source: E. F. Toro, Riemann Solvers
/// and Numerical Methods for Fluid Dynamics, 3rd ed., chapter 10.
struct Hllc {
  template <int D, int Axis, class G>
  static FaceState<D, kGases<G>> solve(const G& gas, const State<D, kGases<G>>& left,
                                       const State<D, kGases<G>>& right) {
    constexpr int gases = kGases<G>;
    const auto &lawL = lawIn<D>(gas, left), &lawR = lawIn<D>(gas, right);
    const double rhoL = left[kDensity], uL = left[kVelocity(Axis)], pL = lawL.pressureOf(rhoL, left[kPressure<D>]);
    const double rhoR = right[kDensity], uR = right[kVelocity(Axis)], pR = lawR.pressureOf(rhoR, right[kPressure<D>]);
    const double cL2 = lawL.soundSpeedSquared(rhoL, left[kPressure<D>]);
    const double cR2 = lawR.soundSpeedSquared(rhoR, right[kPressure<D>]);
    const double rootL = std::sqrt(rhoL), rootR = std::sqrt(rhoR), weight = 1 / (rootL + rootR);
    const double spread = (uR - uL) * weight;
    const double u = (rootL * uL + rootR * uR) * weight;
    const double c = std::sqrt((rootL * cL2 + rootR * cR2) * weight + 0.5 * rootL * rootR * (spread * spread));
    const double slowL = uL - std::sqrt(cL2), slow = u - c, fastR = uR + std::sqrt(cR2), fast = u + c;
    const double sL = slowL < slow ? slowL : slow;
    const double sR = fastR > fast ? fastR : fast;
    const double mL = rhoL * (sL - uL), mR = rhoR * (sR - uR);
    const double contact = ((pR - pL) + (mL * uL - mR * uR)) / (mL - mR);
    const double pStar = 0.5 * ((pL + mL * (contact - uL)) + (pR + mR * (contact - uR)));

    const bool fromLeft = contact >= 0;
    const bool between = sL < 0 && sR > 0;
    FaceState<D, gases> face;
    for (std::size_t k = 0; k < face.w.size(); ++k) face.w[k] = fromLeft ? left[k] : right[k];
    const double s = fromLeft ? sL : sR;
    const double m = fromLeft ? mL : mR;
    const double side = face.w[kVelocity(Axis)], p = fromLeft ? pL : pR;
    const double internal = lawIn<D>(gas, face.w).energyOf(face.w[kDensity], face.w[kPressure<D>]);
    const double energy = internal + 0.5 * face.w[kDensity] * speedSquared<D>(face.w);
    const double inverse = 1 / (s - contact);
    const double energyStar = ((s - side) * energy - p * side + pStar * contact) * inverse;
    const double rhoStar = m * inverse;
    if constexpr (gases > 1) {
      const double thicker = between ? (s - side) * inverse : 1;
      for (int k = 0; k < gases; ++k) face.w[kMass<D>(k)] *= thicker;
    }
    face.w[kDensity] = between ? rhoStar : face.w[kDensity];
    face.w[kVelocity(Axis)] = between ? contact : side;
    face.w[kPressure<D>] = between ? pStar : p;
    face.energy = between ? energyStar : energy;
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
