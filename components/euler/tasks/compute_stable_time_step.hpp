#pragma once

#include "components/euler/tasks/check_state.hpp"

namespace tushar::euler {

/// dt = cfl / max(sum_d (|v_d| + c) / h_d).
/// Throws NumericalError where a density, or p + p_inf, is not positive.
template <int D>
void computeStableTimeStep(const Patch& patch, const Gas& gas, double cfl, CellView<const double> density,
                           CellView<const Vec<D>> momentum, CellView<const double> totalEnergy, Minimum& dt) {
  constexpr int chunk = 256, lanes = 8;
  std::array<double, chunk> rate{};
  std::array<double, lanes> greatest{};
  std::array<double, D> perWidth;
  double widths = 0;
  for (int d = 0; d < D; ++d) widths += perWidth[d] = patch.level().inverseSpacing(d);
  forEachRow<D>(patch.cells(), [&](Index<D> first, int cells) {
    for (int done = 0; done < cells; done += chunk, first[0] += chunk) {
      const int count = std::min(chunk, cells - done);
      const double *rho = rowOf(density, first, count), *energy = rowOf(totalEnergy, first, count);
      const double* m = rowOf(momentum, first, count)->data();
      double bad = 0;
      for (int i = 0; i < count; ++i) {
        const double inverse = 1 / rho[i];
        double squared = 0, sum = 0;
        for (int d = 0; d < D; ++d) {
          squared += m[i * D + d] * m[i * D + d];
          sum += std::abs(m[i * D + d]) * perWidth[d];
        }
        const double p = gas.pressure(energy[i] - 0.5 * squared * inverse) + gas.pInfinity;
        const double least = rho[i] < p ? rho[i] : p;
        bad = least > 0 ? bad : 1.0;
        rate[i] = sum * inverse + std::sqrt(gas.gamma * p * inverse) * widths;
      }
      if (bad != 0) refuseBroken<D, const double>(patch, gas, {density, momentum, totalEnergy}, nullptr);
      for (int i = count; i < chunk; ++i) rate[i] = 0;
      for (std::size_t i = 0; i < chunk; i += lanes)
        for (std::size_t k = 0; k < lanes; ++k) greatest[k] = rate[i + k] > greatest[k] ? rate[i + k] : greatest[k];
    }
  });
  const double most = *std::max_element(greatest.begin(), greatest.end());
  if (most > 0) dt.add(cfl / most, "CFL");
}

}  // namespace tushar::euler
