#include "components/mpm/gas/conserving/cells.hpp"

#include <Eigen/Geometry>

namespace tushar::mpm::gas::conserving {

namespace {

/// Harmonic mean; 0 if the signs differ.
double harmonicMean(double a, double b) { return a * b > 0 ? 2 * a * b / (a + b) : 0.0; }

/// 0 if a velocity difference is below .05 c, 1 from .15 c on.
double sensor(double difference, double soundSpeed) {
  if (!(soundSpeed > 0)) return 1;
  return std::clamp(10 * (difference / soundSpeed - 0.05), 0.0, 1.0);
}

/// The compression of a cell and its neighbours, from the velocity gradients.
template <int D>
Compression compressionOf(const Level& level, CellView<const Tensor<D>> gradient, const Index<D>& cell) {
  const double h = level.minSpacing();
  Compression result;
  result.difference = h * gradient[cell].trace();
  result.nearby = -result.difference;
  for (int d = 0; d < D; ++d) {
    const double own = h * gradient[cell](d, d);
    double explained = 0;
    for (const int side : {-1, 1}) {
      Index<D> next = cell;
      next[d] += side;
      if (!gradient.box().contains(next)) next = cell;
      explained += harmonicMean(own, h * gradient[next](d, d));
      result.nearby = std::max(result.nearby, -h * gradient[next].trace());
    }
    result.smooth += own - 0.5 * explained;
  }
  return result;
}

template <int D>
Tensor<D> cofactor(const Tensor<D>& f) {
  Tensor<D> c;
  if constexpr (D == 1) {
    c(0, 0) = 1;
  } else if constexpr (D == 2) {
    c << f(1, 1), -f(1, 0), -f(0, 1), f(0, 0);
  } else {
    for (int d = 0; d < 3; ++d) c.col(d) = f.col((d + 1) % 3).cross(f.col((d + 2) % 3));
  }
  return c;
}

}  // namespace

CellState shockViscosity(double pressure, double density, double soundSpeed, double difference,
                         const Viscosity& viscosity) {
  const double jump = std::max(-difference, 0.0);
  return {pressure, density * jump * (viscosity.quadratic * jump + viscosity.linear * soundSpeed), 1};
}

CellState smoothViscosity(double pressure, double density, double soundSpeed, const Compression& compression,
                          const Viscosity& viscosity) {
  const double difference = compression.difference;
  CellState state{pressure, 0, sensor(std::abs(difference), soundSpeed)};
  if (difference < 0) {
    const double s = sensor(-difference, soundSpeed);
    const double j = -(s * difference + (1 - s) * std::max(difference, std::min(0.0, compression.smooth)));
    state.viscosity = density * j * (viscosity.quadratic * j + viscosity.linear * soundSpeed);
  } else if (difference > 0) {
    const double z =
        std::clamp(compression.smooth, 0.0, difference) * std::clamp(compression.nearby / difference, 0.0, 1.0);
    state.viscosity = -std::min(viscosity.linear * density * soundSpeed * z, 0.4 * pressure);
  }
  return state;
}

template <int D, class Scheme>
void computePressure(const Patch& patch, const Gas& gas, const Viscosity& viscosity, CellView<const double> mass,
                     CellView<const double> internalEnergy, CellView<const Tensor<D>> gradient,
                     CellView<double> pressure, CellView<double> artificial, CellView<double> shock) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    CellState state;
    if (mass[cell] > 0) {
      const double p = (gas.gamma - 1) * internalEnergy[cell] / level.cellVolume();
      const double rho = mass[cell] / level.cellVolume(), c = std::sqrt(gas.gamma * p / rho);
      if constexpr (Scheme::transfer == Transfer::apic)
        state = shockViscosity(p, rho, c, level.minSpacing() * gradient[cell].trace(), viscosity);
      else
        state = smoothViscosity(p, rho, c, compressionOf<D>(level, gradient, cell), viscosity);
    }
    pressure[cell] = state.pressure;
    artificial[cell] = state.viscosity;
    shock[cell] = state.shock;
  });
}

template <int D, class Scheme>
void computeStress(const Patch& patch, const Gas& gas, CellView<const double> pressure,
                   CellView<const double> artificial, CellView<const Tensor<D>> gradient, double dt,
                   CellView<Tensor<D>> stress) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if constexpr (Scheme::transfer == Transfer::apic) {
      stress[cell] = (pressure[cell] + artificial[cell]) * Tensor<D>::Identity();
    } else {
      const Tensor<D> half = 0.5 * dt * gradient[cell];
      const double later = pressure[cell] * std::clamp(1 - gas.gamma * half.trace(), 0.3, 2.0) + artificial[cell];
      stress[cell] = later * cofactor<D>(Tensor<D>::Identity() + half);
    }
  });
}

#define TUSHAR_INSTANTIATE(D, Scheme)                                                                              \
  template void computePressure<D, Scheme>(const Patch&, const Gas&, const Viscosity&, CellView<const double>,     \
                                           CellView<const double>, CellView<const Tensor<D>>, CellView<double>,    \
                                           CellView<double>, CellView<double>);                                    \
  template void computeStress<D, Scheme>(const Patch&, const Gas&, CellView<const double>, CellView<const double>, \
                                         CellView<const Tensor<D>>, double, CellView<Tensor<D>>);
TUSHAR_INSTANTIATE(1, Apic)
TUSHAR_INSTANTIATE(2, Apic)
TUSHAR_INSTANTIATE(3, Apic)
TUSHAR_INSTANTIATE(1, AffineFlip)
TUSHAR_INSTANTIATE(2, AffineFlip)
TUSHAR_INSTANTIATE(3, AffineFlip)
#undef TUSHAR_INSTANTIATE

}  // namespace tushar::mpm::gas::conserving
