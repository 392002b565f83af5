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
  const double most = greatestInRows<D>(patch.cells(), [&](const Index<D>& first, int count, double* rate) {
    const double *rho = rowOf(density, first, count), *energy = rowOf(totalEnergy, first, count);
    const double* m = rowOf(momentum, first, count)->data();
    double bad = 0;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const double inverse = 1 / rho[i];
      double squared = 0, sum = 0;
      for (int d = 0; d < D; ++d) {
        squared += m[i * D + d] * m[i * D + d];
        sum += std::abs(m[i * D + d]) * perWidth[d];
      }
      const double p = stiffened.pressure(rho[i], energy[i] - 0.5 * squared * inverse) + stiffened.pInfinity;
      const double least = rho[i] < p ? rho[i] : p;
      bad = least > 0 ? bad : 1.0;
      const double sound = std::sqrt(stiffened.gamma * p * inverse);
      double greatest = 0;
      for (int d = 0; d < D; ++d) {
        const double one = (std::abs(m[i * D + d]) * inverse + sound) * perWidth[d];
        greatest = one > greatest ? one : greatest;
      }
      rate[i] = crossing(sum * inverse + sound * widths, greatest);
    }
    if (bad != 0) refuseBroken<D, const double>(patch, gas, {density, momentum, totalEnergy}, nullptr);
  });
  if (most > 0) dt.add(courant.number / most, "CFL");
}

}  // namespace tushar::euler
