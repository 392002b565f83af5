#pragma once

#include "components/euler/courant.hpp"
#include "components/euler/tasks/check_state.hpp"

namespace tushar::euler {

/// Returns the greatest CrossingRate [1/s] on the patch, from (|v_d| + c) / h_d along each axis, for a gas with its own
/// law. Throws NumericalError where a state is impossible.
template <int D>
double greatestRate(const Patch& patch, const Gas& gas, const CrossingRate<D>& crossing,
                    const StateViews<D, const double>& state) {
  refuseBroken<D, const double>(patch, gas, state, nullptr);
  double greatest = 0;
  gas.withLaw([&](const auto& law) {
    forEach<D>(patch.cells(), [&](const Index<D>& cell) {
      const double rho = state.density[cell];
      const double c2 = law.soundSpeedSquared(rho, law.last(rho, internalEnergyIn<D, const double>(state, cell)));
      const double rate = crossing.ofAxes([&](int d) {
        return (std::abs(state.momentum[cell][d]) / rho + std::sqrt(c2)) * patch.level().inverseSpacing(d);
      });
      greatest = std::max(greatest, rate);
    });
  });
  return greatest;
}

/// Computes dt = cfl / r, where r is the greatest CrossingRate from (|v_d| + c) / h_d along each axis.
/// Throws NumericalError where a density, or p + p_inf, is not positive.
template <int D>
void computeStableTimeStep(const Patch& patch, const Gas& gas, const Courant& courant, CellView<const double> density,
                           CellView<const Vec<D>> momentum, CellView<const double> totalEnergy, Minimum& dt) {
  const CrossingRate<D> crossing(courant);
  if (gas.law) {
    const double most = greatestRate<D>(patch, gas, crossing, {density, momentum, totalEnergy});
    if (most > 0) dt.add(courant.number / most, "CFL");
    return;
  }
  const StiffenedGas stiffened = lawOf<StiffenedGas>(gas);
  std::array<double, D> perWidth;
  double widths = 0;
  for (int d = 0; d < D; ++d) widths += perWidth[d] = patch.level().inverseSpacing(d);
  Lanes::Mask isFine = Lanes(0) < Lanes(1);
  const double most = greatestInRows<D>(patch.cells(), [&](const Index<D>& first, int count) {
    const double *density0 = rowOf(density, first, count), *energy0 = rowOf(totalEnergy, first, count);
    const double* momentum0 = rowOf(momentum, first, count)->data();
    return [ =, &isFine ](const LanesOfRow& cells) __attribute__((always_inline)) {
      const Lanes rho = cells.at(density0), inverse = 1 / rho;
      const std::array<Lanes, D> m = cells.template vectorsAt<D>(momentum0);
      Lanes squared = 0, sum = 0;
      for (std::size_t d = 0; d < D; ++d) {
        squared += m[d] * m[d];
        sum += abs(m[d]) * perWidth[d];
      }
      const Lanes p = stiffened.pressure(rho, cells.at(energy0) - 0.5 * squared * inverse) + stiffened.pInfinity;
      isFine &= (rho > 0) & (p > 0);
      const Lanes sound = sqrt(stiffened.gamma * p * inverse);
      Lanes greatest = 0;
      for (std::size_t d = 0; d < D; ++d) greatest = max(greatest, (abs(m[d]) * inverse + sound) * perWidth[d]);
      return crossing(sum * inverse + sound * widths, greatest);
    };
  });
  if (!all(isFine)) refuseBroken<D, const double>(patch, gas, {density, momentum, totalEnergy}, nullptr);
  if (most > 0) dt.add(courant.number / most, "CFL");
}

}  // namespace tushar::euler
