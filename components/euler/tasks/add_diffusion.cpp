#include "components/euler/tasks/add_diffusion.hpp"

#include "components/euler/boundary.hpp"
#include "components/euler/tasks/check_state.hpp"

namespace tushar::euler {

namespace {

/// T takes the place of the density in a State; that of the pressure is unused.
inline constexpr std::size_t kTemperature = kDensity;

/// Distances in memory of neighbours, and 1/h, along each axis.
template <int D>
struct Spacing {
  std::array<std::ptrdiff_t, D> stride;
  std::array<double, D> inverse;

  Spacing(const Level& level, const Rows<D>& rows) {
    for (int d = 0; d < D; ++d) stride[d] = rows.stride(d);
    for (int d = 0; d < D; ++d) inverse[d] = level.inverseSpacing(d);
  }
};

/// The fluxes through the lower face of place `i` across an axis.
template <int D>
State<D> fluxAt(const Diffusion& diffusion, const typename Rows<D>::Pointers& w, const Spacing<D>& by, int axis,
                std::ptrdiff_t i) {
  const std::ptrdiff_t below = i - by.stride[axis];
  State<D> flux{};
  double others = 0;
  const double* normal = w[kVelocity(axis)];
  const double along = (normal[i] - normal[below]) * by.inverse[axis];
  for (int k = 0; k < D; ++k) {
    if (k == axis) continue;
    const double* v = w[kVelocity(k)];
    const std::ptrdiff_t next = by.stride[k];
    const auto slope = [&](const double* of) {
      return 0.25 * by.inverse[k] * ((of[i + next] - of[i - next]) + (of[below + next] - of[below - next]));
    };
    others += slope(v);
    flux[kVelocity(k)] = -diffusion.viscosity * ((v[i] - v[below]) * by.inverse[axis] + slope(normal));
  }
  flux[kVelocity(axis)] = -diffusion.viscosity * (2 * along - 2.0 / 3 * (along + others));
  double energy = -diffusion.conductivity * (w[kTemperature][i] - w[kTemperature][below]) * by.inverse[axis];
  for (int k = 0; k < D; ++k) energy += flux[kVelocity(k)] * 0.5 * (w[kVelocity(k)][i] + w[kVelocity(k)][below]);
  flux[kPressure<D>] = energy;
  return flux;
}

/// Keeps those of the fluxes across an axis that are at the rim of the level.
template <int D>
void keepDiffused(const DiffusionRims<D>& rims, const Box& faces, int axis, Rows<D>& flux) {
  rims.momentum.template forEachFaceIn<D>(faces, axis, [&](const Index<D>& face, Vec<D>& through) {
    for (int d = 0; d < D; ++d) through[d] += *flux.at(face)[kVelocity(d)];
  });
  rims.energy.template forEachFaceIn<D>(
      faces, axis, [&](const Index<D>& face, double& through) { through += *flux.at(face)[kPressure<D>]; });
}

}  // namespace

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
    for (std::ptrdiff_t i = 0; i < count; ++i) store<D>(to, i, fluxAt<D>(diffusion, from, spacing, axis, i));
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
  std::size_t room = 1;
  for (int d = 0; d < D; ++d) room *= std::min(patch.cells().extent(d), kBlock<D>[d]) + 2;
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
