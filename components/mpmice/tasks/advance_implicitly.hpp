#pragma once

#include "components/euler/tasks/add_gravity.hpp"
#include "components/ice/pushed_gas.hpp"
#include "components/ice/tasks/advance_implicitly.hpp"
#include "components/mpmice/tasks/add_diffusion.hpp"
#include "components/mpmice/tasks/advance_gas.hpp"
#include "components/mpmice/tasks/solve_pressure.hpp"

namespace tushar::mpmice {

/// Views of the gas before a step, and of its change of pressure.
template <int D>
struct GasInStep {
  GasInCells<D> cells;
  GasAlone<D> alone;
  CellView<const double> change;

  static GasInStep from(auto& take, bool endsAtPlane) {
    return {
        .cells = GasInCells<D>::from(take, readsOld, {.state = 2, .mass = 3, .room = 3, .endsAtPlane = endsAtPlane}),
        .alone = GasAlone<D>::from(take, 2),
        .change = take(requiresNew(c::pressureChange, 2))};
  }
};

/// Adds the fluxes of an implicit step along an axis through the open fractions of a block's faces, and gravity along
/// this axis in cells that are not `beside` bodies. Returns the largest fraction of a cell that flows through a face.
template <int D, int Axis>
double sweepImplicitly(const WallExchange<D>& exchange, const NearBodies<D>& near, const NearBodies<D>& beside,
                       const Level& level, const Box& block, double dt, const GasInCells<D>& cells,
                       ice::ImplicitStep<D>& step, const UnsharedGas<D>& fresh,
                       const std::optional<CellView<Vec<D>>>& flow) {
  Box faces = block;
  ++faces.upper[Axis];
  const auto open = [&](const Index<D>& face) { return exchange.openShareOf(near, face, Axis); };
  const double most = near.anyIn(faces) ? step.computeFluxes(faces, Axis, open) : step.computeFluxes(faces, Axis);
  const double ratio = dt / level.spacing(Axis);
  euler::addFluxes<D, Axis>(ratio, block, cells.held, step.flux(), fresh.held);
  fresh.rims.masses.keep(block, Axis, step.flux());
  if (flow) keepMassFlow<D>(exchange, near, block, Axis, ratio, step.flux(), *flow);
  step.addGravity(block, Axis, fresh.held, [&](const Index<D>& cell) { return !beside(cell); });
  return most;
}

/// Performs one step of the gas, given the pressure at its end. Away from bodies, it is a step of `ice`. At bodies,
/// fluxes pass through the open fractions of faces; walls exert pressure and move as in an explicit step. Mass,
/// momentum and energy are conserved for any pressure.
template <int D>
void advanceImplicitly(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                       double time, double dt, const GasInStep<D>& before, const BodiesInStep<D>& bodies,
                       const typename BodiesAtNodes<D>::Records& records, const OutcomeOfStep<D>& outcome, Sum& power) {
  const UnsharedGas<D>& fresh = outcome.fresh;
  const OfferedExchange<D>& offered = outcome.offered;
  const Level& level = patch.level();
  const GasInCells<D>& cells = before.cells;
  const NearBodies<D> near(patch.cells().grown(2, D), nearLayers, cells.free, cells.held.density);
  // Gravity acts by another formula there, so round-off must not decide which cells these are.
  const NearBodies<D> beside(patch.cells(), nearLayers, cells.free, cells.held.density, wholeFreeVolume);
  const WallExchange<D> exchange(level, settings, cells, bodies, records, time, dt);
  const Vec<D> gravity = level.reduce<D>(settings.gravity);
  offered.clear();
  double most = 0;
  ice::ImplicitStep<D> step(level, settings.gas, *settings.implicit, exchange.rules(),
                            euler::largestBlock<D>(patch.cells()), dt, flatAtBodies<D>(patch, cells));
  euler::forEachBlock<D>(patch.cells(), [&](const Box& block) {
    step.hold(block, before.alone.state, before.change);
    const auto sweep = [&]<int Axis>() {
      most = std::max(most, sweepImplicitly<D, Axis>(exchange, near, beside, level, block, dt, cells, step, fresh,
                                                     offered.massFlow));
    };
    sweep.template operator()<0>();
    if constexpr (D > 1) sweep.template operator()<1>();
    if constexpr (D > 2) sweep.template operator()<2>();
    beside.forEachIn(block, [&](const Index<D>& cell) {
      if (!gravity.isZero(0) && !cells.isEmpty(cell))
        euler::fall<D>(gravity, cells.held.density[cell], dt, fresh.held.momentum[cell], fresh.held.totalEnergy[cell]);
    });
    addWalls<D>(exchange, near, block, level.cellVolume() / dt, fresh, offered, power);
  });
  refuseFarGas<D>(patch, settings, near, cells, fresh.held);
  ice::refuseCrossing(most, dt);
}

/// Computes dt = cfl / s as in `ice`, with the greatest rate s of ice::PushedGas. The acceleration a_d follows from the
/// pressure of the gas itself. `diffusionAt(cell, density, speed of sound, d)` is the rate of diffusion along an axis
/// [1/s] in a cell that the gas fills.
template <int D, class DiffusionAt>
void limitImplicitStepWith(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, Minimum& dt,
                           DiffusionAt&& diffusionAt) {
  const Level& level = patch.level();
  const ice::IceSettings& implicit = *settings.implicit;
  const euler::Gas& gas = settings.gas.gas;
  const NearBodies<D> near(patch.cells(), nearLayers, cells.free, cells.held.density);
  const FreeSpace<D> space(level, settings, cells);
  const Vec<D> gravity = level.reduce<D>(settings.gravity);
  const euler::CrossingRate<D> crossing(settings.gas.courant);
  const std::size_t p = euler::kPressure<D>;
  const Box around = level.clipCells(patch.cells().grown(1, D));
  euler::Rows<D> gasAlone(around.size());
  gasAlone.hold(around);
  forEach<D>(around, [&](const Index<D>& cell) {
    if (!cells.isEmpty(cell)) euler::store<D>(gasAlone.at(cell), 0, cells.primitive(gas, cell));
  });
  double greatest = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    const euler::State<D> w = gasAlone.state(cell);
    const double rho = w[euler::kDensity], stiff = w[p] + gas.pInfinity;
    if (!(stiff > 0)) refuseGas<D>(level, gas, cell, cells.free[cell], rho, stiff);
    const double c = std::sqrt(gas.soundSpeedSquared(rho, w[p])), sound = implicit.soundSpeedKnob * c;
    const double layer = std::min(1.0, layerOf(cells.free[cell]));
    ice::PushedGas<D> crossed;
    for (int d = 0; d < D; ++d) {
      const double perWidth = level.inverseSpacing(d);
      crossed.flow[d] = (std::abs(w[euler::kVelocity(d)]) + sound) * perWidth;
      crossed.diffusion[d] = diffusionAt(cell, rho, c, d) / (layer * layer);
      double most = 0;
      for (const int side : {0, 1}) {
        if (space.isAtSide(cell, d, side) || (near(cell) && !(space.aperture(cell, d, side) > 0))) continue;
        const Index<D> next = side == 0 ? cell - Index<D>::unit(d) : cell + Index<D>::unit(d);
        const double other = gasAlone.number(next, p);
        const double rise = (side == 0 ? w[p] - other : other - w[p]) * perWidth;
        most = std::max(most, std::abs(gravity[d] - 2 * rise / (rho + gasAlone.number(next, euler::kDensity))));
      }
      crossed.push[d] = perWidth * most;
    }
    greatest = std::max(greatest, crossed.rate(crossing));
  });
  if (greatest > 0) dt.add(settings.gas.courant.number / greatest, "CFL");
}

/// Computes dt as in limitImplicitStepWith, with the diffusion 2 nu / h_d², where nu is the largest diffusivity.
template <int D>
void limitImplicitStep(const Patch& patch, const Settings& settings, const GasInCells<D>& cells,
                       double diffusivityAtStart, Minimum& dt) {
  const euler::Diffusion& diffusion = settings.implicit->diffusion;
  const DiffusivityBound bound(patch.level(), diffusivityAtStart);
  limitImplicitStepWith<D>(patch, settings, cells, dt, [&](const Index<D>&, double density, double sound, int d) {
    if (!diffusion.acts()) return 0.0;
    const double perWidth = patch.level().inverseSpacing(d);
    return 2 * std::min(diffusion.greatest(settings.gas.gas, density), bound.at(sound)) * (perWidth * perWidth);
  });
}

/// Computes dt as in limitImplicitStepWith, with the diffusion (nu_below + nu_above) / h_d² of varying coefficients.
template <int D>
void limitVaryingImplicitStep(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, double time,
                              double diffusivityAtStart, Minimum& dt) {
  const euler::GhostRules<D> rules = euler::diffusionRules<D>(patch.level(), settings.gas.gas, time);
  euler::Diffuser<D> diffuser = boundedDiffuser<D>(patch, settings, rules);
  euler::Rows<D> rates =
      euler::ratesOfDiffusion<D>(patch, diffuser, diffusingGas<D>(patch.level(), settings, cells, diffusivityAtStart));
  limitImplicitStepWith<D>(patch, settings, cells, dt, [&](const Index<D>& cell, double, double, int d) {
    return rates.number(cell, euler::kVelocity(d));
  });
}

}  // namespace tushar::mpmice
