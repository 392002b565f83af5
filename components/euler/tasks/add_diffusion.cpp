#include "components/euler/tasks/add_diffusion.hpp"

#include "components/euler/boundary.hpp"
#include "components/euler/tasks/check_state.hpp"
#include "components/euler/tasks/diffusive_flux.hpp"

namespace tushar::euler {

template <int D>
void findTemperature(const Gas& gas, const Level& level, const StateViews<D, const double>& old, Rows<D>& rows) {
  const double perPressure = gas.specificHeat > 0 ? 1 / gas.gasConstant() : 0;
  forEachRow<D>(level.clipCells(rows.box()), [&](Index<D> cell, int count) {
    const auto to = rows.at(cell);
    for (std::ptrdiff_t i = 0; i < count; ++i, ++cell[0]) {
      State<D> w{};
      const double inverse = 1 / old.density[cell];
      w[kTemperature] = gas.law ? gas.temperature(old.density[cell], internalEnergyIn<D, const double>(old, cell))
                                : (pressureIn(gas, old, cell) + gas.pInfinity) * inverse * perPressure;
      for (int d = 0; d < D; ++d) w[kVelocity(d)] = old.momentum[cell][d] * inverse;
      store<D>(to, i, w);
    }
  });
}

template <int D>
void computeDiffusiveFluxes(const Diffusion& diffusion, const Level& level, const Box& faces, int axis, Rows<D>& w,
                            Rows<D>& flux) {
  const Spacing<D> spacing(level, w);
  forEachRow<D>(faces, [&](const Index<D>& first, int count) {
    const auto from = w.at(first), to = flux.at(first);
    forEachRegister(count, [&](auto number, std::ptrdiff_t i) {
      using Number = decltype(number);
      store<D, Number>(to, i, diffusiveFluxAt<D, Number>(diffusion, from, spacing, axis, i));
    });
  });
}

template <int D>
void addDiffused(double ratio, const Box& block, int axis, Rows<D>& flux, CellView<Vec<D>> momentum,
                 CellView<double> energy) {
  const std::ptrdiff_t next = flux.stride(axis);
  forEachRow<D>(block, [&](Index<D> cell, int count) {
    const auto f = flux.at(cell);
    for (std::ptrdiff_t i = 0; i < count; ++i, ++cell[0]) {
      for (int d = 0; d < D; ++d) momentum[cell][d] -= ratio * (f[kVelocity(d)][i + next] - f[kVelocity(d)][i]);
      energy[cell] -= ratio * (f[kPressure<D>][i + next] - f[kPressure<D>][i]);
    }
  });
}

template <int D>
void addDiffusion(const Patch& patch, const Gas& gas, const Diffusion& diffusion, const OldState<D>& old, double time,
                  double dt, CellView<Vec<D>> newMomentum, CellView<double> newTotalEnergy,
                  const DiffusionRims<D>& rims) {
  const Level& level = patch.level();
  const GhostRules<D> rules = diffusionRules<D>(level, gas, time);
  const std::size_t room = largestBlock<D>(patch.cells()).grown(1, D).size();
  Rows<D> w(room), flux(room);
  forEachBlock<D>(patch.cells(), [&](const Box& block) {
    w.hold(block.grown(1, D));
    flux.hold(w.box());
    findTemperature<D>(gas, level, old, w);
    fillBeyondGrid<D>(level, rules, w);
    for (int axis = 0; axis < D; ++axis) {
      Box faces = block;
      ++faces.upper[axis];
      computeDiffusiveFluxes<D>(diffusion, level, faces, axis, w, flux);
      keepDiffused<D>(rims, faces, axis, flux);
      addDiffused<D>(dt / level.spacing(axis), block, axis, flux, newMomentum, newTotalEnergy);
    }
  });
}

template <int D>
void limitDiffusion(const Patch& patch, const Gas& gas, const Diffusion& diffusion, double cfl,
                    CellView<const double> density, CellView<const Vec<D>> momentum, CellView<const double> totalEnergy,
                    Minimum& dt) {
  const Level& level = patch.level();
  double widths = 0, squares = 0, greatest = 0;
  for (int d = 0; d < D; ++d) widths += level.inverseSpacing(d);
  for (int d = 0; d < D; ++d) squares += level.inverseSpacing(d) * level.inverseSpacing(d);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double rho = density[cell];
    const double last = gas.last(rho, internalEnergyIn<D, const double>({density, momentum, totalEnergy}, cell));
    double rate = std::sqrt(gas.soundSpeedSquared(rho, last)) * widths + 2 * diffusion.greatest(gas, rho) * squares;
    for (int d = 0; d < D; ++d) rate += std::abs(momentum[cell][d]) / rho * level.inverseSpacing(d);
    greatest = rate > greatest ? rate : greatest;
  });
  if (greatest > 0) dt.add(cfl / greatest, "diffusion");
}

#define TUSHAR_DIFFUSION(D)                                                                                     \
  template void findTemperature<D>(const Gas&, const Level&, const StateViews<D, const double>&, Rows<D>&);     \
  template void computeDiffusiveFluxes<D>(const Diffusion&, const Level&, const Box&, int, Rows<D>&, Rows<D>&); \
  template void addDiffused<D>(double, const Box&, int, Rows<D>&, CellView<Vec<D>>, CellView<double>);          \
  template void addDiffusion<D>(const Patch&, const Gas&, const Diffusion&, const OldState<D>&, double, double, \
                                CellView<Vec<D>>, CellView<double>, const DiffusionRims<D>&);                   \
  template void limitDiffusion<D>(const Patch&, const Gas&, const Diffusion&, double, CellView<const double>,   \
                                  CellView<const Vec<D>>, CellView<const double>, Minimum&);
TUSHAR_DIFFUSION(1)
TUSHAR_DIFFUSION(2)
TUSHAR_DIFFUSION(3)

}  // namespace tushar::euler
