#pragma once

#include "components/euler/tasks/check_state.hpp"

namespace tushar::euler {

/// Returns the largest sum_d (|v_d| + c) / h_d [1/s] on the patch, for a gas with its own law. Throws NumericalError
/// where a state is impossible.
template <int D>
double greatestRate(const Patch& patch, const Gas& gas, const StateViews<D, const double>& state) {
  refuseBroken<D, const double>(patch, gas, state, nullptr);
  double greatest = 0;
  gas.withLaw([&](const auto& law) {
    forEach<D>(patch.cells(), [&](const Index<D>& cell) {
      const double rho = state.density[cell];
      const double c2 = law.soundSpeedSquared(rho, law.last(rho, internalEnergyIn<D, const double>(state, cell)));
      double rate = 0;
      for (int d = 0; d < D; ++d)
        rate += (std::abs(state.momentum[cell][d]) / rho + std::sqrt(c2)) * patch.level().inverseSpacing(d);
      greatest = rate > greatest ? rate : greatest;
    });
  });
  return greatest;
}

/// Computes dt = cfl / max(sum_d (|v_d| + c) / h_d).
/// Throws NumericalError where a density, or p + p_inf, is not positive.
template <int D>
void computeStableTimeStep(const Patch& patch, const Gas& gas, double cfl, CellView<const double> density,
                           CellView<const Vec<D>> momentum, CellView<const double> totalEnergy, Minimum& dt) {
  if (gas.law) {
    const double most = greatestRate<D>(patch, gas, {density, momentum, totalEnergy});
    if (most > 0) dt.add(cfl / most, "CFL");
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
      rate[i] = sum * inverse + std::sqrt(stiffened.gamma * p * inverse) * widths;
    }
    if (bad != 0) refuseBroken<D, const double>(patch, gas, {density, momentum, totalEnergy}, nullptr);
  });
  if (most > 0) dt.add(cfl / most, "CFL");
}

}  // namespace tushar::euler
