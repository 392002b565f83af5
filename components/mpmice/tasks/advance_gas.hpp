#pragma once

#include "components/mpmice/vacuum_flux.hpp"
#include "components/mpmice/wall_exchange.hpp"

namespace tushar::mpmice {

/// Views of the state after a step, before small cells are merged with others.
template <int D>
struct UnsharedGas {
  euler::MixtureViews<D, double> held;  ///< for several gases, the volumes in place of the volume fractions
  euler::RimFluxes<D> rims = {};        ///< fluxes through the rim of the level

  static UnsharedGas from(auto& take, std::size_t gases, bool keepsMasses) {
    const auto ofEach = [&](const auto& labels) {
      return viewsOfGases(take, gases, [&](std::size_t k) { return computes(labels[k]); });
    };
    euler::RimFluxes<D> rims{.mass = take(keepsFlux(c::unsharedDensity)),
                             .momentum = take(keepsFlux(c::unsharedMomentum<D>)),
                             .energy = take(keepsFlux(c::unsharedEnergy)),
                             .masses = euler::FaceMasses<D>::from(take, keepsMasses)};
    for (std::size_t k = 0; k < gases; ++k)
      rims.gases.push_back({take(keepsFlux(c::unsharedMass[k])), take(keepsFlux(c::unsharedVolume[k]))});
    return {.held = {{take(computes(c::unsharedDensity)), take(computes(c::unsharedMomentum<D>)),
                      take(computes(c::unsharedEnergy))},
                     ofEach(c::unsharedMass),
                     ofEach(c::unsharedVolume)},
            .rims = std::move(rims)};
  }
};

/// Views of what a step of the gas computes.
template <int D>
struct OutcomeOfStep {
  UnsharedGas<D> fresh;
  OfferedExchange<D> offered;

  static OutcomeOfStep from(auto& take, std::size_t gases, bool keepsMasses) {
    UnsharedGas<D> fresh = UnsharedGas<D>::from(take, gases, keepsMasses);
    return {.fresh = std::move(fresh), .offered = OfferedExchange<D>::from(take)};
  }
};

/// Computes rho, v, p of the gas in the cells of `w`. Cells without gas get an arbitrary gas at rest; it has no fluxes,
/// because the faces of these cells are closed, or those of flowIntoVacuum.
template <int D, class G>
void recoverGas(const G& gas, const Level& level, const GasInCells<D>& cells, const NearBodies<D>& near,
                euler::Rows<D, euler::kGases<G>>& w) {
  constexpr int K = euler::kGases<G>;
  euler::recover<D>(gas, level, w.box(), cells.held, w);
  near.forEachIn(level.clipCells(w.box()), [&](const Index<D>& cell) {
    if (!(cells.free[cell] < 1) && !cells.isEmpty(cell)) return;
    euler::State<D, K> state{};
    state[euler::kDensity] = 1;
    state[euler::kPressure<D>] = 1;
    if constexpr (K > 1) state[euler::kMass<D>(0)] = state[euler::kShare<D, K>(0)] = 1;
    if (!cells.isEmpty(cell)) state = cells.primitive(gas, cell);
    euler::store<D>(w.at(cell), 0, state);
  });
}

/// Makes the state constant in each cell that has a body in it or next to it, and in the images of such cells outside
/// the grid.
template <int D, int K>
void flattenAtBodies(const Level& level, const Box& box, const GasInCells<D>& cells, const NearBodies<D>& near,
                     euler::Work<D, K>& work) {
  const Box known = level.clipCells(box.grown(1, D));
  const auto hasBody = [&](const Index<D>& cell) { return known.contains(cell) && cells.hasBody(cell); };
  near.forEachActingIn(box, [&](const Index<D>& cell) {
    Index<D> source = cell;
    for (int d = 0; d < D; ++d) source[d] = std::clamp(cell[d], known.lower[d], known.upper[d] - 1);
    bool isPlain = !hasBody(source);
    for (int d = 0; d < D && isPlain; ++d)
      isPlain = !hasBody(source - Index<D>::unit(d)) && !hasBody(source + Index<D>::unit(d));
    if (isPlain) return;
    const euler::State<D, K> w = euler::load<D>(work.w.at(cell), 0);
    for (std::size_t d = 0; d < work.lower.size(); ++d) {
      euler::store<D>(work.lower[d].at(cell), 0, w);
      euler::store<D>(work.upper[d].at(cell), 0, w);
    }
  });
}

/// Multiplies the fluxes through the lower faces of the cells of `faces` by the open fractions of these faces.
template <int D, int K>
void closeFaces(const Level& level, const FreeSpace<D>& space, const NearBodies<D>& near, const Box& faces, int axis,
                euler::Rows<D, K>& flux) {
  const bool periodic = level.isPeriodic(axis);
  near.forEachIn(faces, [&](const Index<D>& cell) {
    const bool isUpperSide = !periodic && cell[axis] == level.cells().upper[axis];
    const double open = isUpperSide       ? space.aperture(cell - Index<D>::unit(axis), axis, 1)
                        : near.acts(cell) ? space.aperture(cell, axis, 0)
                                          : 0.0;
    if (open == 1) return;
    const typename euler::Rows<D, K>::Pointers f = flux.at(cell);
    for (double* number : f) *number = open > 0 ? open * *number : 0.0;
  });
}

/// Stores the mass that flows upwards along an axis through the lower faces of a block's cells, relative to the bodies,
/// per cell volume.
template <int D, int K>
void keepMassFlow(const WallExchange<D>& exchange, const NearBodies<D>& near, const Box& block, int axis, double ratio,
                  const euler::Rows<D, K>& flux, const CellView<Vec<D>>& flow) {
  near.forEachActingIn(block, [&](const Index<D>& cell) {
    if (exchange.space().isAtSide(cell, axis, 0)) return;
    flow[cell][axis] = ratio * flux.number(cell, euler::kDensity) - exchange.carriedThrough(cell, axis);
  });
}

/// Adds the fluxes along an axis through the open parts of a block's faces.
template <int D, class Flux, class Shape, int Axis, class G>
void sweepOpen(const G& gas, const WallExchange<D>& exchange, const NearBodies<D>& near, const Level& level,
               const Box& block, double ratio, const euler::MixtureViews<D, const double>& old,
               euler::Work<D, euler::kGases<G>>& work, const UnsharedGas<D>& fresh,
               const std::optional<CellView<Vec<D>>>& flow) {
  Box faces = block;
  ++faces.upper[Axis];
  euler::computeFluxes<D, Flux, Shape, Axis>(gas, faces, work, work.flux);
  if (exchange.fillsVacuum()) flowIntoVacuum<D, Axis>(gas, exchange.space(), near, faces, work.w, work.flux);
  closeFaces<D>(level, exchange.space(), near, faces, Axis, work.flux);
  euler::keepAtRim<D>(fresh.rims, faces, Axis, work.flux);
  fresh.rims.masses.keep(block, Axis, work.flux);
  euler::addFluxes<D, Axis>(ratio, block, old, work.flux, fresh.held, euler::areBlended(gas));
  if constexpr (constexpr int K = euler::kGases<G>; K > 1)
    if (exchange.fillsVacuum())
      addToVacuum<D, Axis, K>(exchange.space(), near, block, ratio, work.flux, fresh.held.shares);
  if (flow) keepMassFlow<D>(exchange, near, block, Axis, ratio, work.flux, *flow);
}

/// Adds the forces of walls to the gas of a block, and the power of the gas on these walls to `power`.
template <int D>
void addWalls(const WallExchange<D>& exchange, const NearBodies<D>& near, const Box& block, double perStep,
              const UnsharedGas<D>& fresh, const OfferedExchange<D>& offered, Sum& power) {
  if (!fresh.held.shares.empty())
    near.forEachIn(block, [&](const Index<D>& cell) {
      if (!near.acts(cell) || !exchange.space().isVacuum(cell)) exchange.fillRoom(cell, fresh.held);
    });
  near.forEachActingIn(block, [&](const Index<D>& cell) {
    const Given<D> given = exchange.addTo(cell, fresh.held, fresh.rims.masses);
    if (given.work != 0) power.add(given.work * perStep);
    if (exchange.space().isVacuum(cell)) exchange.fillVacuum(cell, fresh.held.shares);
    if (offered.impulse) (*offered.impulse)[cell] = given.impulse;
    if (offered.work) (*offered.work)[cell] = given.work;
  });
}

/// Throws NumericalError for an unphysical state of the gas away from bodies.
template <int D>
void refuseFarGas(const Patch& patch, const Settings& settings, const NearBodies<D>& near, const GasInCells<D>& cells,
                  const euler::MixtureViews<D, double>& fresh) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (near(cell)) return;
    const euler::Gas gas = lawAt<D>(settings, fresh, 1, cell);
    if (!euler::canBe<D>(gas, &fresh.density[cell], fresh.momentum[cell].data(), &fresh.totalEnergy[cell], 1))
      euler::refuseState<D, double>(patch.level(), gas, cell, fresh, settings.gases.empty() ? &cells.held : nullptr);
  });
}

/// Whether the gas of a row of cells has a possible state. For several gases, refuseFarGas checks it or, if they have
/// laws of their own, closeGases at the end of the step.
template <int D, class G>
bool canBeIn(const G& gas, const Index<D>& first, int count, const euler::StateViews<D, double>& fresh) {
  if constexpr (constexpr int gases = euler::kGases<G>; gases > 1)
    return false;
  else
    return euler::canBe<D>(gas, &fresh.density[first], fresh.momentum[first].data(), &fresh.totalEnergy[first], count);
}

/// Performs a step for a block with bodies in or around it: a step of `euler` through open faces, and the effect of
/// walls. Returns whether the gas away from bodies is possible; near bodies, the state may become possible only when
/// small cells are merged.
template <int D, class Flux, class Shape, class G>
bool advanceAtBodies(const G& gas, double dt, const Box& block, const GasInCells<D>& cells,
                     const WallExchange<D>& exchange, const NearBodies<D>& near, euler::Work<D, euler::kGases<G>>& work,
                     const UnsharedGas<D>& fresh, const OfferedExchange<D>& offered, Sum& power) {
  const Level& level = exchange.level();
  const double perStep = level.cellVolume() / dt;
  work.hold(block.grown(Shape::reach, D));
  recoverGas<D>(gas, level, cells, near, work.w);
  euler::fillBeyondGrid<D>(level, exchange.rules(), work.w);
  euler::predict<D>(gas, level, block.grown(1, D), dt, work, Shape{});
  flattenAtBodies<D>(level, block.grown(1, D), cells, near, work);
  const auto sweep = [&]<int Axis>() {
    sweepOpen<D, Flux, Shape, Axis>(gas, exchange, near, level, block, dt / level.spacing(Axis), cells.held, work,
                                    fresh, offered.massFlow);
  };
  sweep.template operator()<0>();
  if constexpr (D > 1) sweep.template operator()<1>();
  if constexpr (D > 2) sweep.template operator()<2>();
  addWalls<D>(exchange, near, block, perStep, fresh, offered, power);
  bool fine = true;
  near.forEachFarRunIn(block,
                       [&](const Index<D>& first, int count) { fine &= canBeIn<D>(gas, first, count, fresh.held); });
  return fine;
}

/// Performs a step for a patch with the law of its gas. Returns whether the gas away from bodies is possible.
template <int D, class Flux, class Shape, class G>
bool advanceWith(const G& law, const Patch& patch, double dt, const GasInCells<D>& cells,
                 const WallExchange<D>& exchange, const NearBodies<D>& near, const UnsharedGas<D>& fresh,
                 const OfferedExchange<D>& offered, Sum& power) {
  constexpr int K = euler::kGases<G>;
  const Level& level = patch.level();
  // Kept for the next patch of the thread, as in `euler`.
  thread_local auto work = euler::Work<D, K>::unfilled(patch.cells(), Shape::reach);
  if (work.w.room() < euler::Work<D, K>::roomOf(patch.cells(), Shape::reach))
    work = euler::Work<D, K>::unfilled(patch.cells(), Shape::reach);
  bool fine = true;
  euler::forEachBlock<D>(patch.cells(), [&](const Box& block) {
    if (near.anyIn(block.grown(1, D))) {
      fine &= advanceAtBodies<D, Flux, Shape>(law, dt, block, cells, exchange, near, work, fresh, offered, power);
      return;
    }
    euler::advanceBlock<D, Flux, Shape>(law, level, exchange.rules(), block, dt, cells.held, work, fresh.held,
                                        fresh.rims);
    if constexpr (K > 1)
      fine = false;  // refuseFarGas looks
    else
      fine &= euler::canBe<D>(law, block, fresh.held);
  });
  return fine;
}

/// Throws NumericalError if bodies are so close to cells of a coarser level that these would have walls.
template <int D>
void requireFinest(const Patch& patch, const NearBodies<D>& near) {
  const Level& level = patch.level();
  if (level.number() == level.domain().refinement.levels - 1 || !near.anyIn(patch.cells())) return;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (near(cell))
      throw NumericalError(
          fmt::format("bodies came within {} cells of a cell that is not on the finest level", nearLayers),
          "a larger <Level>, or <adaptive> in <Regridder> of <AMR>", "c.freeVolume", level.cellNumber<D>(cell));
  });
}

/// Performs one step of the gas. Away from bodies, the step is bitwise equal to one of `euler`. At bodies, fluxes pass
/// through the open fractions of faces. Walls exert a pressure, which does work at the mean of their velocities before
/// and after the step, and gas follows moving walls. Adds the power of the gas on bodies [W] to `power`. K is the
/// number of gases that share cells.
template <int D, class Flux, class Shape, int K>
void advanceGas(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings, double time,
                double dt, const GasInCells<D>& cells, const BodiesInStep<D>& bodies,
                const typename BodiesAtNodes<D>::Records& records, const OutcomeOfStep<D>& outcome, Sum& power) {
  const euler::Gas& gas = settings.gas.gas;
  const NearBodies<D> near(patch.cells().grown(2, D), nearLayers, cells.free, cells.held.density);
  WallExchange<D> exchange(patch.level(), settings, cells, bodies, records, time, dt);
  exchange.measure(near);
  requireFinest<D>(patch, near);
  outcome.offered.clear();
  const auto advance = [&](const auto& law) {
    return advanceWith<D, Flux, Shape>(law, patch, dt, cells, exchange, near, outcome.fresh, outcome.offered, power);
  };
  bool fine = false;
  if constexpr (K > 1)
    fine = advance(euler::mixtureOf<K>(settings.gases));
  else if (gas.law)  // Other laws are looked up cell by cell; the look-up costs less than the laws themselves.
    fine = advance(gas);
  else
    fine = advance(euler::lawOf<euler::StiffenedGas>(gas));
  if (!fine && !areBlended(settings)) refuseFarGas<D>(patch, settings, near, cells, outcome.fresh.held);
}

template <int D>
using AdvanceGas = void (*)(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                            double time, double dt, const GasInCells<D>& cells, const BodiesInStep<D>& bodies,
                            const typename BodiesAtNodes<D>::Records& records, const OutcomeOfStep<D>& outcome,
                            Sum& power);

/// The function that advances two or three gases, which is like advanceGas.
template <int D>
AdvanceGas<D> chooseAdvanceGases(const euler::Method& method, std::size_t gases);

}  // namespace tushar::mpmice
