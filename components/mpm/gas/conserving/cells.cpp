#include "components/mpm/gas/conserving/cells.hpp"

#include <Eigen/Geometry>
#include <optional>

#include "components/mpm/gas/conserving/grid_fields.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

/// Harmonic mean; 0 if the signs differ.
Lanes harmonicMean(Lanes a, Lanes b) { return select(a * b > 0, 2 * a * b / (a + b), 0); }

/// The shock sensor: 0 if the velocity difference is below .05 c, and 1 if it is above .15 c or if c is 0.
Lanes sensor(Lanes differenceOverSpeed, Lanes soundSpeed) {
  return select(soundSpeed > 0, clamp(10 * (differenceOverSpeed - 0.05), 0.0, 1.0), 1);
}

/// Computes the velocity differences over cells along each axis, and their sum Delta. A cell at the rim of the grid
/// counts as its own neighbour beyond the rim.
template <int D>
class Differences : public GridFields<D, D + 1> {
 public:
  static constexpr std::size_t total = D;

  Differences(const Patch& patch, const CellView<const Tensor<D>>& gradient)
      : GridFields<D, D + 1>(patch.cells(), false) {
    const double h = patch.level().minSpacing();
    const auto set = [&](const Index<D>& cell, const Tensor<D>& of) {
      for (int d = 0; d < D; ++d) this->at(static_cast<std::size_t>(d), cell) = h * of(d, d);
      this->at(total, cell) = h * of.trace();
    };
    const Box& cells = gradient.box();
    forEachRowPart<D>(cells, [&](const RowPart<D>& part) {
      const LanesTensor<D> of = load(gradient, part);
      for (int d = 0; d < D; ++d) this->writeRow(static_cast<std::size_t>(d), part, h * of(d, d));
      this->writeRow(total, part, h * of.trace());
    });
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        if (cells.lower[d] < patch.cells().lower[d] && side == 0) continue;
        if (cells.upper[d] > patch.cells().upper[d] && side == 1) continue;
        Box rim = patch.cells();
        (side == 0 ? rim.upper[d] : rim.lower[d]) = side == 0 ? rim.lower[d] + 1 : rim.upper[d] - 1;
        forEach<D>(rim, [&](const Index<D>& cell) { set(cell + Index<D>::unit(d) * (2 * side - 1), gradient[cell]); });
      }
  }
};

/// Computes the compression of cells and their neighbours.
template <int D>
[[gnu::always_inline]] inline Compression compressionOf(const Differences<D>& differences, const Index<D>& first) {
  constexpr std::size_t total = Differences<D>::total;
  Compression result;
  result.difference = differences.readRow(total, first);
  result.nearby = -result.difference;
  for (int d = 0; d < D; ++d) {
    const std::size_t along = static_cast<std::size_t>(d);
    const Lanes own = differences.readRow(along, first);
    Lanes explained = 0;
    for (const Index<D>& next : {first - Index<D>::unit(d), first + Index<D>::unit(d)}) {
      explained += harmonicMean(own, differences.readRow(along, next));
      result.nearby = max(result.nearby, -differences.readRow(total, next));
    }
    result.smooth += own - 0.5 * explained;
  }
  return result;
}

template <int D>
LanesTensor<D> cofactor(const LanesTensor<D>& f) {
  LanesTensor<D> c;
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

CellState shockViscosity(Lanes pressure, Lanes density, Lanes soundSpeed, Lanes difference,
                         const Viscosity& viscosity) {
  const Lanes jump = max(-difference, 0.0);
  return {pressure, density * jump * (viscosity.quadratic * jump + viscosity.linear * soundSpeed), 1};
}

CellState smoothViscosity(Lanes pressure, Lanes density, Lanes soundSpeed, const Compression& compression,
                          const Viscosity& viscosity) {
  const Lanes difference = compression.difference, ratio = difference / soundSpeed, s = sensor(-ratio, soundSpeed);
  const Lanes j = -(s * difference + (1 - s) * max(difference, min(0.0, compression.smooth)));
  const Lanes compressed = density * j * (viscosity.quadratic * j + viscosity.linear * soundSpeed);
  const Lanes z = clamp(compression.smooth, 0.0, difference) * clamp(compression.nearby / difference, 0.0, 1.0);
  const Lanes expanding = -min(viscosity.linear * density * soundSpeed * z, 0.4 * pressure);
  return {pressure, select(difference < 0, compressed, select(difference > 0, expanding, 0)),
          sensor(abs(ratio), soundSpeed)};
}

template <int D, class Scheme>
void computePressure(const Patch& patch, const Gas& gas, const Viscosity& viscosity, CellView<const double> mass,
                     CellView<const double> internalEnergy, CellView<const Tensor<D>> gradient,
                     CellView<double> pressure, CellView<double> artificial, CellView<double> shock) {
  const double perVolume = 1 / patch.level().cellVolume(), h = patch.level().minSpacing();
  const double pressureOfEnergy = (gas.gamma - 1) * perVolume, squareOfEnergy = gas.soundSpeedSquared(1);
  constexpr bool isSmooth = Scheme::transfer == Transfer::affineFlip;
  std::optional<Differences<D>> differences;
  if (isSmooth) differences.emplace(patch, gradient);
  forEachRowPart<D>(patch.cells(), [&](const RowPart<D>& cells) {
    const Lanes m = load(mass, cells), energy = load(internalEnergy, cells);
    const Lanes p = pressureOfEnergy * energy, rho = perVolume * m, c = sqrt(squareOfEnergy * energy / m);
    CellState state;
    if constexpr (isSmooth)
      state = smoothViscosity(p, rho, c, compressionOf<D>(*differences, cells.first), viscosity);
    else
      state = shockViscosity(p, rho, c, h * load(gradient, cells).trace(), viscosity);
    const Lanes::Mask holdsGas = m > 0;
    store(select(holdsGas, state.pressure, 0), pressure, cells);
    store(select(holdsGas, state.viscosity, 0), artificial, cells);
    store(select(holdsGas, state.shock, 1), shock, cells);
  });
}

template <int D, class Scheme>
void computeStress(const Patch& patch, const Gas& gas, CellView<const double> pressure,
                   CellView<const double> artificial, CellView<const Tensor<D>> gradient, double dt,
                   CellView<Tensor<D>> stress) {
  forEachRowPart<D>(patch.cells(), [&](const RowPart<D>& cells) {
    const Lanes p = load(pressure, cells), q = load(artificial, cells);
    LanesTensor<D> all = LanesTensor<D>::Identity();
    if constexpr (Scheme::transfer == Transfer::apic) {
      all *= p + q;
    } else {
      const LanesTensor<D> half = 0.5 * dt * load(gradient, cells);
      const Lanes later = p * clamp(1 - gas.gamma * half.trace(), 0.3, 2.0) + q;
      all = later * cofactor<D>(all + half);
    }
    store(all, stress, cells);
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
