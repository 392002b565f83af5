#pragma once

#include "components/euler/gas.hpp"
#include "components/euler/labels.hpp"
#include "components/euler/rows.hpp"

namespace tushar::euler {

/// Adds a cell variable times the volume of the cells.
template <int D>
void sumOverCells(const Patch& patch, CellView<const double> values, Sum& total) {
  WideSum sum(total);
  const double volume = patch.level().cellVolume();
  forEachRow<D>(patch.cells(), [&](const Index<D>& first, int count) {
    const double* row = &values[first];
    sum.addAll(count, [&](int k) { return volume * row[k]; });
  });
}

/// Computes the mass in the patch [kg].
template <int D>
void sumMass(const Patch& patch, CellView<const double> density, Sum& mass) {
  sumOverCells<D>(patch, density, mass);
}

/// Computes the momentum in the patch [kg m/s].
template <int D>
void sumMomentum(const Patch& patch, CellView<const Vec<D>> momentum, VectorSum& total) {
  const double volume = patch.level().cellVolume();
  for (int d = 0; d < D; ++d) {
    const int axis = patch.level().axis(d);
    WideSum sum(axis == 0 ? total.x : axis == 1 ? total.y : total.z);
    forEachRow<D>(patch.cells(), [&](const Index<D>& first, int count) {
      const double* row = momentum[first].data() + d;
      sum.addAll(count, [&](int k) { return volume * row[k * D]; });
    });
  }
}

/// Computes the internal and kinetic energy in the patch [J].
template <int D>
void sumEnergy(const Patch& patch, CellView<const double> totalEnergy, Sum& energy) {
  sumOverCells<D>(patch, totalEnergy, energy);
}

/// The square of vector `k` of a row, given the numbers of the row.
template <int D>
double squaredNormAt(const double* row, int k) {
  double sum = 0;
  for (int d = 0; d < D; ++d) sum += row[k * D + d] * row[k * D + d];
  return sum;
}

/// Computes the kinetic energy in the patch [J].
template <int D>
void sumKineticEnergy(const Patch& patch, CellView<const double> density, CellView<const Vec<D>> momentum,
                      Sum& energy) {
  WideSum sum(energy);
  const double half = 0.5 * patch.level().cellVolume();
  forEachRow<D>(patch.cells(), [&](const Index<D>& first, int count) {
    const double *m = momentum[first].data(), *rho = &density[first];
    sum.addAll(count, [&](int k) { return half * squaredNormAt<D>(m, k) / rho[k]; });
  });
}

/// Internal energy per volume [J/m³] of a cell: E - rho v² / 2.
template <int D>
double internalEnergyPerVolume(double density, const Vec<D>& momentum, double totalEnergy) {
  return totalEnergy - 0.5 * momentum.squaredNorm() / density;
}

/// Computes the smallest density [kg/m³] and internal energy [J/kg] of any cell.
template <int D>
void findLeast(const Patch& patch, CellView<const double> density, CellView<const Vec<D>> momentum,
               CellView<const double> totalEnergy, Minimum& leastDensity, Minimum& leastEnergy) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    leastDensity.add(density[cell]);
    leastEnergy.add(internalEnergyPerVolume<D>(density[cell], momentum[cell], totalEnergy[cell]) / density[cell]);
  });
}

/// Computes the sum of m (ln((p + p_inf) / ((gamma - 1) rho)) - (gamma - 1) ln rho) [kg]: the entropy divided by c_v,
/// up to a constant that depends on the units. A gas with its own law has its own entropy.
template <int D>
void sumEntropy(const Patch& patch, const Gas& gas, CellView<const double> density, CellView<const Vec<D>> momentum,
                CellView<const double> totalEnergy, Sum& entropy) {
  WideSum sum(entropy);
  const double volume = patch.level().cellVolume(), less = gas.gamma - 1;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double rho = density[cell], energy = internalEnergyPerVolume<D>(rho, momentum[cell], totalEnergy[cell]);
    if (gas.law) {
      sum.add(volume * rho * std::visit([&](const auto& law) { return law.entropy(rho, energy); }, *gas.law));
      return;
    }
    const double p = gas.pressure(rho, energy);
    sum.add(volume * rho * (std::log((p + gas.pInfinity) / (less * rho)) - less * std::log(rho)));
  });
}

/// Calls `visit(law, k, density, internal energy per volume)` for the cells of a row, k = 0 to `count` - 1, in a loop
/// for the law of the gas that is vectorised if the law allows it. The energy is bitwise that of
/// internalEnergyPerVolume; `momentum` has D numbers per cell.
template <int D, class Visit>
void forEachState(const Gas& gas, const double* density, const double* momentum, const double* totalEnergy, int count,
                  Visit&& visit) {
  gas.withLaw([&](const auto& law) {
#pragma GCC ivdep
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      const double* m = momentum + k * D;
      double squared = m[D - 1] * m[D - 1];  // from the last axis to the first, as Eigen adds
      for (int d = D - 2; d >= 0; --d) squared = m[d] * m[d] + squared;
      visit(law, k, density[k], totalEnergy[k] - 0.5 * squared / density[k]);
    }
  });
}

template <int D>
void computePressure(const Patch& patch, const Gas& gas, CellView<const double> density,
                     CellView<const Vec<D>> momentum, CellView<const double> totalEnergy, CellView<double> pressure) {
  forEachRow<D>(patch.cells(), [&](const Index<D>& first, int count) {
    double* to = rowOf(pressure, first, count);
    forEachState<D>(gas, rowOf(density, first, count), rowOf(momentum, first, count)->data(),
                    rowOf(totalEnergy, first, count), count,
                    [to](const auto& law, std::ptrdiff_t k, double rho, double e) { to[k] = law.pressure(rho, e); });
  });
}

template <int D>
void computeVelocity(const Patch& patch, CellView<const double> density, CellView<const Vec<D>> momentum,
                     CellView<Vec<D>> velocity) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { velocity[cell] = momentum[cell] / density[cell]; });
}

template <int D>
void computeMach(const Patch& patch, const Gas& gas, CellView<const double> density, CellView<const Vec<D>> momentum,
                 CellView<const double> totalEnergy, CellView<Vec<D>> mach) {
  forEachRow<D>(patch.cells(), [&](const Index<D>& first, int count) {
    const double* from = rowOf(momentum, first, count)->data();
    double* to = rowOf(mach, first, count)->data();
    forEachState<D>(gas, rowOf(density, first, count), from, rowOf(totalEnergy, first, count), count,
                    [from, to](const auto& law, std::ptrdiff_t k, double rho, double e) {
                      const double sound = std::sqrt(law.soundSpeedSquared(rho, law.last(rho, e)));
                      for (int d = 0; d < D; ++d) to[k * D + d] = from[k * D + d] / (rho * sound);
                    });
  });
}

template <int D>
void computeInternalEnergy(const Patch& patch, CellView<const double> density, CellView<const Vec<D>> momentum,
                           CellView<const double> totalEnergy, CellView<double> internalEnergy) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    internalEnergy[cell] = internalEnergyPerVolume<D>(density[cell], momentum[cell], totalEnergy[cell]) / density[cell];
  });
}

}  // namespace tushar::euler
