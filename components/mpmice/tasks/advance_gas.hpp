#pragma once

#include "components/euler/tasks/advance_patch.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpmice/tasks/measure_exchange.hpp"
#include "components/mpmice/tasks/wall_force.hpp"

namespace tushar::mpmice {

/// The effect of the bodies on the gas in a step: walls, and how free volume and faces changed.
template <int D>
struct BodiesInStep {
  KnownWalls<D> walls;
  CellView<const double> newFree;
  CellView<const Vec<D>> swept;

  static BodiesInStep from(auto& take, bool isViscous) {
    return {.walls = KnownWalls<D>::from(take, 0, isViscous),
            .newFree = take(requiresNew(c::unfilledVolume, 3)),
            .swept = take(requiresNew(c::swept<D>, 1))};
  }
};

/// The state after a step, before small cells share theirs.
template <int D>
struct UnsharedGas {
  euler::MixtureViews<D, double> held;  ///< of several gases the volumes, in place of the shares

  static UnsharedGas from(auto& take, std::size_t gases) {
    const auto ofEach = [&](const auto& labels) {
      return viewsOfGases(take, gases, [&](std::size_t k) { return computes(labels[k]); });
    };
    return {.held = {{take(computes(c::unsharedDensity)), take(computes(c::unsharedMomentum<D>)),
                      take(computes(c::unsharedEnergy))},
                     ofEach(c::unsharedMass),
                     ofEach(c::unsharedVolume)}};
  }
};

/// What the gas of a cell gives to walls in a step, per volume of the cell.
template <int D>
struct Given {
  Vec<D> impulse = Vec<D>::Zero();  ///< N s/m³
  double work = 0;                  ///< J/m³
};

/// The exchange of the gas with walls in a step.
template <int D>
class WallExchange {
 public:
  WallExchange(const Level& level, const Settings& settings, const GasInCells<D>& cells, const BodiesInStep<D>& bodies,
               const typename BodiesAtNodes<D>::Records& records, double dt)
      : level_(level),
        settings_(settings),
        gas_(settings.gas.gas),
        rules_(euler::ghostRules<D>(level, settings.gas.gas)),
        cells_(cells),
        space_(level, settings, cells),
        step_(bodies),
        nodes_(level, records),
        dt_(dt) {}

  const Level& level() const { return level_; }
  const euler::Gas& gas() const { return gas_; }
  /// Rules for ghost states beyond the sides of the grid.
  const euler::GhostRules<D>& rules() const { return rules_; }
  const FreeSpace<D>& space() const { return space_; }
  /// Open share of the lower face of a cell, which may lie beyond an upper side of the grid.
  double openShareOf(const NearBodies<D>& near, const Index<D>& cell, int axis) const {
    if (!near(cell)) return 1;
    const bool isUpperSide = !level_.isPeriodic(axis) && cell[axis] == level_.cells().upper[axis];
    return isUpperSide ? space_.aperture(cell - Index<D>::unit(axis), axis, 1) : space_.aperture(cell, axis, 0);
  }

  /// Adds to the content of a cell what walls at its faces push, and what gas flows in behind walls that move. Returns
  /// what the gas gives to the walls.
  Given<D> addTo(const Index<D>& cell, const euler::MixtureViews<D, double>& held) const {
    Given<D> given;
    fillRoom(cell, held);
    if (step_.walls.friction && !(*step_.walls.friction)[cell].isZero(0)) drag(cell, held, given);
    for (int d = 0; d < D; ++d) {
      const OpenFaces faces = space_.faces(cell, d);
      for (int side = 0; side < 2; ++side) {
        const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(d);
        const double wall = faces.wall(side);
        const bool flows = !space_.isAtSide(cell, d, side) && mayFlow(face, d);
        if (!(wall > 0) && !flows) continue;
        const Vec<D> after = nodes_.velocityAt(face, d, mpm::solid::lane::velocity);
        if (wall > 0) push(cell, d, side, wall, after, held, given);
        if (flows) flow(cell, d, side, after[d], held);
      }
    }
    return given;
  }

  /// Mass of gas that goes up through the open share of a cell's lower face, over a cell's volume, if it moves with the
  /// bodies there.
  double carriedThrough(const Index<D>& cell, int axis) const {
    const double open = space_.aperture(cell, axis, 0);
    if (!(open > 0)) return 0;
    const double velocity = nodes_.velocityAt(cell, axis, mpm::solid::lane::velocity)[axis];
    const Index<D> donor = velocity > 0 ? cell - Index<D>::unit(axis) : cell;
    const double density = cells_.held.density[donor] / cells_.free[donor];
    return open * density * velocity * dt_ * level_.inverseSpacing(axis);
  }

 private:
  /// Of several gases, makes volumes of shares: those of the gas in the cell fill the room that it has after the step.
  void fillRoom(const Index<D>& cell, const euler::MixtureViews<D, double>& held) const {
    for (std::size_t k = 0; k < held.shares.size(); ++k)
      held.shares[k][cell] += cells_.held.shares[k][cell] * (step_.newFree[cell] - 1);
  }

  /// Momentum and work of a wall: its pressure, at the mean of its velocities before and after the step.
  void push(const Index<D>& cell, int axis, int side, double wall, const Vec<D>& after,
            const euler::StateViews<D, double>& held, Given<D>& given) const {
    const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(axis);
    const Vec<D> before = nodes_.velocityAt(face, axis, mpm::solid::lane::before);
    const double pressure = side == 0 ? step_.walls.below[cell][axis] : step_.walls.above[cell][axis];
    const double impulse = (side == 0 ? wall : -wall) * pressure * dt_ * level_.inverseSpacing(axis);
    held.momentum[cell][axis] += impulse;
    const double work = impulse * (0.5 * (before[axis] + after[axis]));
    held.totalEnergy[cell] += work;
    given.impulse[axis] -= impulse;
    given.work -= work;
  }

  /// Friction, and its work at the mean of the walls' velocities before and after the step.
  void drag(const Index<D>& cell, const euler::StateViews<D, double>& held, Given<D>& given) const {
    const CellFriction<D> weights = frictionWeights<D>(level_, settings_, cells_, space_, nodes_, cell);
    for (int a = 0; a < D; ++a)
      for (int side = 0; side < 2; ++side) {
        const double share = weights.share(a, side);
        if (!(share > 0)) continue;
        const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(a);
        const Vec<D> twice = nodes_.velocityAt(face, a, mpm::solid::lane::before) +
                             nodes_.velocityAt(face, a, mpm::solid::lane::velocity);
        const Vec<D> impulse = dt_ * share * (*step_.walls.friction)[cell];
        const double work = 0.5 * impulse.dot(twice);
        held.momentum[cell] += impulse;
        held.totalEnergy[cell] += work;
        given.impulse -= impulse;
        given.work -= work;
      }
  }

  /// Whether bodies are at the face below a cell, or went through it.
  bool mayFlow(const Index<D>& face, int axis) const {
    const Index<D> below = face - Index<D>::unit(axis);
    return cells_.free[face] < 1 || cells_.free[below] < 1 || step_.swept[face][axis] != 0;
  }

  /// Gas follows a wall that draws back, and makes way for one that comes, with all it holds: what the covered share of
  /// the face would sweep less what bodies swept.
  void flow(const Index<D>& cell, int axis, int side, double wallVelocity,
            const euler::MixtureViews<D, double>& held) const {
    const Index<D> above = side == 0 ? cell : cell + Index<D>::unit(axis), below = above - Index<D>::unit(axis);
    const double up = (1 - space_.aperture(above, axis, 0)) * wallVelocity * dt_ * level_.inverseSpacing(axis) -
                      step_.swept[above][axis];
    if (up == 0) return;
    const Index<D>&donor = up > 0 ? below : above, &receiver = up > 0 ? above : below;
    if (isClosedPore(receiver)) return;
    const std::optional<Parcel<D>> gas = stateOf(donor, receiver);
    if (!gas) return;
    const double volume = side == 0 ? up : -up;
    held.density[cell] += volume * gas->u[euler::kDensity];
    for (int d = 0; d < D; ++d) held.momentum[cell][d] += volume * gas->u[euler::kVelocity(d)];
    held.totalEnergy[cell] += volume * gas->u[euler::kPressure<D>];
    for (std::size_t k = 0; k < held.shares.size(); ++k) {
      held.masses[k][cell] += volume * gas->masses[k];
      held.shares[k][cell] += volume * (gas->shares[k] - cells_.held.shares[k][cell]);
    }
  }

  /// The state of the donor's gas; if it has none, that of the receiver; if that has none either, the mean around the
  /// donor.
  std::optional<Parcel<D>> stateOf(const Index<D>& donor, const Index<D>& receiver) const {
    if (!space_.isEmpty(donor)) return cells_.parcel(donor);
    if (!space_.isEmpty(receiver)) return cells_.parcel(receiver);
    Parcel<D> sum;
    int count = 0;
    for (int d = 0; d < D; ++d)
      for (int side = 0; side < 2; ++side) {
        if (space_.isAtSide(donor, d, side)) continue;
        const Index<D> next = side == 0 ? donor - Index<D>::unit(d) : donor + Index<D>::unit(d);
        if (space_.isEmpty(next)) continue;
        sum.add(cells_.parcel(next), 1);
        ++count;
      }
    if (count == 0) return std::nullopt;
    Parcel<D> mean;
    mean.add(sum, 1.0 / count);
    return mean;
  }

  /// A hole in a body: hardly free, and no cell within two that is free for the most part.
  bool isClosedPore(const Index<D>& cell) const {
    if (!(step_.newFree[cell] < narrowFreeVolume)) return false;
    bool closed = true;
    forEach<D>(level_.clipCells(cellsAround<D>(cell, 2)),
               [&](const Index<D>& at) { closed &= !(step_.newFree[at] > smallFreeVolume); });
    return closed;
  }

  const Level& level_;
  const Settings& settings_;
  const euler::Gas& gas_;
  euler::GhostRules<D> rules_;
  const GasInCells<D>& cells_;
  FreeSpace<D> space_;
  const BodiesInStep<D>& step_;
  BodiesAtNodes<D> nodes_;
  double dt_;
};

/// rho, v, p of the gas in the cells of the work's box; where there is none, of some gas that moves nowhere: what flows
/// from there is closed off.
template <int D, class G>
void recoverGas(const G& gas, const Level& level, const GasInCells<D>& cells, const NearBodies<D>& near,
                euler::Rows<D, euler::kGases<G>>& w) {
  constexpr int K = euler::kGases<G>;
  euler::recover<D>(gas, level, cells.held, w);
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

/// Cells with a body in them or beside them are taken as constant, and beyond a side of the grid those that mirror
/// them.
template <int D, int K>
void flattenAtBodies(const Level& level, const Box& box, const GasInCells<D>& cells, const NearBodies<D>& near,
                     euler::Work<D, K>& work) {
  const Box known = level.clipCells(box.grown(1, D));
  const auto hasBody = [&](const Index<D>& cell) {
    return known.contains(cell) && (cells.free[cell] < 1 || cells.isEmpty(cell));
  };
  near.forEachIn(box, [&](const Index<D>& cell) {
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

/// Lets the fluxes through the lower faces of the cells of `faces` pass as far as these are open.
template <int D, int K>
void closeFaces(const Level& level, const FreeSpace<D>& space, const NearBodies<D>& near, const Box& faces, int axis,
                euler::Rows<D, K>& flux) {
  const bool periodic = level.isPeriodic(axis);
  near.forEachIn(faces, [&](const Index<D>& cell) {
    const bool isUpperSide = !periodic && cell[axis] == level.cells().upper[axis];
    const double open =
        isUpperSide ? space.aperture(cell - Index<D>::unit(axis), axis, 1) : space.aperture(cell, axis, 0);
    if (open == 1) return;
    const typename euler::Rows<D, K>::Pointers f = flux.at(cell);
    for (double* number : f) *number = open > 0 ? open * *number : 0.0;
  });
}

/// Keeps the mass that flows up through the lower faces of the cells of a block across an axis, over a cell's volume,
/// past what moves as the bodies at the face do.
template <int D, int K>
void keepMassFlow(const WallExchange<D>& exchange, const NearBodies<D>& near, const Box& block, int axis, double ratio,
                  const euler::Rows<D, K>& flux, const CellView<Vec<D>>& flow) {
  near.forEachIn(block, [&](const Index<D>& cell) {
    if (exchange.space().isAtSide(cell, axis, 0)) return;
    flow[cell][axis] = ratio * flux.number(cell, euler::kDensity) - exchange.carriedThrough(cell, axis);
  });
}

/// The fluxes through the open parts of a block's faces across an axis.
template <int D, class Flux, class Shape, int Axis, class G>
void sweepOpen(const G& gas, const WallExchange<D>& exchange, const NearBodies<D>& near, const Level& level,
               const Box& block, double ratio, const euler::MixtureViews<D, const double>& old,
               euler::Work<D, euler::kGases<G>>& work, const euler::MixtureViews<D, double>& fresh,
               const std::optional<CellView<Vec<D>>>& flow) {
  Box faces = block;
  ++faces.upper[Axis];
  euler::computeFluxes<D, Flux, Shape, Axis>(gas, faces, work);
  closeFaces<D>(level, exchange.space(), near, faces, Axis, work.flux);
  euler::addFluxes<D, Axis>(ratio, block, old, work.flux, fresh);
  if (flow) keepMassFlow<D>(exchange, near, block, Axis, ratio, work.flux, *flow);
}

/// Adds what walls near a block do, and its power.
template <int D>
void addWalls(const WallExchange<D>& exchange, const NearBodies<D>& near, const Box& block, double perStep,
              const euler::MixtureViews<D, double>& fresh, const OfferedExchange<D>& offered, Sum& power) {
  near.forEachIn(block, [&](const Index<D>& cell) {
    const Given<D> given = exchange.addTo(cell, fresh);
    if (given.work != 0) power.add(given.work * perStep);
    if (offered.impulse) (*offered.impulse)[cell] = given.impulse;
    if (offered.work) (*offered.work)[cell] = given.work;
  });
}

/// Throws NumericalError for an impossible state of the gas away from bodies.
template <int D>
void refuseFarGas(const Patch& patch, const Settings& settings, const NearBodies<D>& near, const GasInCells<D>& cells,
                  const euler::MixtureViews<D, double>& fresh) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (near(cell)) return;
    const euler::Gas gas = lawAt<D>(settings, fresh, cell);
    if (!euler::canBe<D>(gas, &fresh.density[cell], fresh.momentum[cell].data(), &fresh.totalEnergy[cell], 1))
      euler::refuseState<D, double>(patch.level(), gas, cell, fresh, settings.gases.empty() ? &cells.held : nullptr);
  });
}

/// Whether the gas of a cell can be; of several gases refuseFarGas looks.
template <int D, class G>
bool canBeIn(const G& gas, const Index<D>& cell, const euler::StateViews<D, double>& fresh) {
  if constexpr (euler::kGases < G >> 1) return false;
  else
    return euler::canBe<D>(gas, &fresh.density[cell], fresh.momentum[cell].data(), &fresh.totalEnergy[cell], 1);
}

/// A step of a block with bodies in it or around: `euler`'s, through open faces alone, and what walls do. Returns
/// whether the gas away from bodies can be; beside them small cells have still to share.
template <int D, class Flux, class Shape, class G>
bool advanceAtBodies(const G& gas, double dt, const Box& block, const GasInCells<D>& cells,
                     const WallExchange<D>& exchange, const NearBodies<D>& near,
                     euler::Work<D, euler::kGases<G>>& work, const euler::MixtureViews<D, double>& fresh,
                     const OfferedExchange<D>& offered, Sum& power) {
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
  forEach<D>(block, [&](const Index<D>& cell) { fine &= near(cell) || canBeIn<D>(gas, cell, fresh); });
  return fine;
}

/// The step of a patch with the law of its gas. Returns whether the gas away from bodies can be.
template <int D, class Flux, class Shape, class G>
bool advanceWith(const G& law, const Patch& patch, double dt, const GasInCells<D>& cells,
                 const WallExchange<D>& exchange, const NearBodies<D>& near, const UnsharedGas<D>& fresh,
                 const OfferedExchange<D>& offered, Sum& power) {
  constexpr int K = euler::kGases<G>;
  const Level& level = patch.level();
  euler::Work<D, K> work(patch.cells(), Shape::reach);
  bool fine = true;
  euler::forEachBlock<D>(patch.cells(), [&](const Box& block) {
    if (near.anyIn(block.grown(1, D))) {
      fine &= advanceAtBodies<D, Flux, Shape>(law, dt, block, cells, exchange, near, work, fresh.held, offered, power);
      return;
    }
    euler::advanceBlock<D, Flux, Shape>(law, level, exchange.rules(), block, dt, cells.held, work, fresh.held, {});
    if constexpr (K > 1)
      fine = false;  // refuseFarGas looks
    else
      fine &= euler::canBe<D>(law, block, fresh.held);
  });
  return fine;
}

/// One step of the gas: that of `euler` where no body is near, to the last bit; at bodies, fluxes go through the open
/// share of faces, walls push by their pressure and do work by the mean of their velocities before and after the step,
/// and gas follows walls that move. Adds the power of the gas on bodies, W. K is the number of gases that share cells.
template <int D, class Flux, class Shape, int K>
void advanceGas(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings, double dt,
                const GasInCells<D>& cells, const BodiesInStep<D>& bodies,
                const typename BodiesAtNodes<D>::Records& records, const UnsharedGas<D>& fresh,
                const OfferedExchange<D>& offered, Sum& power) {
  const euler::Gas& gas = settings.gas.gas;
  const NearBodies<D> near(patch.cells().grown(2, D), nearLayers, cells.free, cells.held.density);
  const WallExchange<D> exchange(patch.level(), settings, cells, bodies, records, dt);
  offered.clear();
  const auto advance = [&](const auto& law) {
    return advanceWith<D, Flux, Shape>(law, patch, dt, cells, exchange, near, fresh, offered, power);
  };
  bool fine = false;
  if constexpr (K > 1)
    fine = advance(euler::mixtureOf<K>(settings.gases));
  else if (gas.law)  // Other laws are looked up cell by cell: they cost more than that themselves.
    fine = advance(gas);
  else
    fine = advance(euler::lawOf<euler::StiffenedGas>(gas));
  if (!fine) refuseFarGas<D>(patch, settings, near, cells, fresh.held);
}

template <int D>
using AdvanceGas = void (*)(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                            double dt, const GasInCells<D>& cells, const BodiesInStep<D>& bodies,
                            const typename BodiesAtNodes<D>::Records& records, const UnsharedGas<D>& fresh,
                            const OfferedExchange<D>& offered, Sum& power);

/// advanceGas for several gases, two or three.
template <int D>
AdvanceGas<D> chooseAdvanceGases(const euler::Method& method, std::size_t gases);

}  // namespace tushar::mpmice
