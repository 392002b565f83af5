#pragma once

#include "components/euler/tasks/advance_block.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpmice/bodies_in_step.hpp"
#include "components/mpmice/passing_gas.hpp"
#include "components/mpmice/tasks/measure_exchange.hpp"

namespace tushar::mpmice {

/// Computes the exchange of the gas with walls in a step.
template <int D>
class WallExchange {
 public:
  /// `time` is the start of the step [s], for conditions that vary in time.
  WallExchange(const Level& level, const Settings& settings, const GasInCells<D>& cells, const BodiesInStep<D>& bodies,
               const typename BodiesAtNodes<D>::Records& records, double time, double dt)
      : level_(level),
        settings_(settings),
        gas_(settings.gas.gas),
        rules_(euler::ghostRulesOf<D>(level, settings.gas.gas, settings.gases, time)),
        cells_(cells),
        space_(level, settings, cells),
        step_(bodies),
        nodes_(level, records),
        dt_(dt) {}

  /// Measures the open fractions of all faces near bodies at once, and keeps what follows walls through these faces,
  /// for tasks that ask for it often.
  void measure(const NearBodies<D>& near) {
    space_.measure(near);
    kept_ = step_.sweptBy.box().intersect(near.rows());
    for (auto& ofAxis : following_) ofAxis.assign(kept_.size(), unknown);
  }

  const Level& level() const { return level_; }
  const euler::Gas& gas() const { return gas_; }
  /// The rules for ghost states beyond the sides of the grid.
  const euler::GhostRules<D>& rules() const { return rules_; }
  const FreeSpace<D>& space() const { return space_; }
  /// Whether gas flows into cells that bodies leave empty.
  bool fillsVacuum() const { return settings_.fillsVacuum(); }
  /// Open fraction of the lower face of a cell. The cell may be just beyond an upper side of the grid.
  double openShareOf(const NearBodies<D>& near, const Index<D>& cell, int axis) const {
    if (!near(cell)) return 1;
    const bool isUpperSide = !level_.isPeriodic(axis) && cell[axis] == level_.cells().upper[axis];
    return isUpperSide ? space_.aperture(cell - Index<D>::unit(axis), axis, 1) : space_.aperture(cell, axis, 0);
  }

  /// Converts the volume fractions of several gases into volumes, which fill the free volume after the step. In full
  /// cells, and in holes without flow, they remain in proportion: no gas gets what is the round-off of others.
  void fillRoom(const Index<D>& cell, const euler::MixtureViews<D, double>& held) const {
    const double room = step_.newFree[cell];
    for (std::size_t k = 0; k < held.shares.size(); ++k) {
      const double share = cells_.held.shares[k][cell];
      double& volume = held.shares[k][cell];
      volume = room < narrowFreeVolume ? share * room + (volume - share) : volume + share * (room - 1);
      if (staysFull(cell)) volume = share * std::max(room, hardlyRoom);
    }
  }

  /// Expands the volumes of several gases that flowed into a cell without gas, so that they fill it.
  void fillVacuum(const Index<D>& cell, const std::vector<CellView<double>>& volumes) const {
    double sum = 0;
    for (const auto& ofGas : volumes) sum += ofGas[cell];
    for (std::size_t k = 0; k < volumes.size(); ++k)
      volumes[k][cell] = step_.newFree[cell] * (sum > 0 ? volumes[k][cell] / sum : k == 0 ? 1.0 : 0.0);
  }

  /// Adds to the content of a cell the effect of the walls at its faces, and the gas that flows in behind moving walls.
  /// Returns what the gas gives to the walls. Adds the mass of that gas to the masses through faces.
  Given<D> addTo(const Index<D>& cell, const euler::MixtureViews<D, double>& held,
                 const euler::FaceMasses<D>& masses) const {
    Given<D> given;
    if (step_.walls.friction && !(*step_.walls.friction)[cell].isZero(0)) drag(cell, held, given);
    for (int d = 0; d < D; ++d) {
      const Index<D> above = cell + Index<D>::unit(d);
      if (space_.isOpen(cell, d) && space_.isOpen(above, d) && step_.swept[cell][d] == 0 && step_.swept[above][d] == 0)
        continue;
      const OpenFaces faces = space_.faces(cell, d);
      for (int side = 0; side < 2; ++side) {
        const Index<D> face = side == 0 ? cell : above;
        const double wall = faces.wall(side);
        const bool isAtSide = space_.isAtSide(cell, d, side);
        if (wall > 0) push(cell, d, side, wall, held, given);
        if (isAtSide)
          flowThroughSide(cell, d, side, held, masses);
        else if (mayFlow(face, d))
          flow(cell, d, side, held, masses);
      }
    }
    if (isHoleAtSide(cell))
      equalize(cell, cells_.contentOf(cell, step_.newFree[cell] / roomBefore(cell)), held, masses);
    else if (step_.leaving && step_.newFree[cell] < leastFreeVolume && isOverdrawnAtSide<D>(level_, gas_, held, cell))
      equalize(cell, {}, held, masses);
    return given;
  }

  /// The mass of gas, per cell volume, that would flow up through the open fraction of the lower face of a cell if the
  /// gas moved with the bodies at this face.
  double carriedThrough(const Index<D>& cell, int axis) const {
    const double open = space_.aperture(cell, axis, 0);
    if (!(open > 0)) return 0;
    const double velocity = nodes_.velocityAt(cell, axis, mpm::solid::lane::velocity)[axis];
    const Index<D> donor = velocity > 0 ? cell - Index<D>::unit(axis) : cell;
    const double density = cells_.held.density[donor] / cells_.free[donor];
    return open * density * velocity * dt_ * level_.inverseSpacing(axis);
  }

 private:
  /// Adds the momentum of a wall's pressure, and its work at the mean of the wall's velocities before and after the
  /// step.
  void push(const Index<D>& cell, int axis, int side, double wall, const euler::StateViews<D, double>& held,
            Given<D>& given) const {
    const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(axis);
    const auto [before, after] = nodes_.speedsAt(face, axis);
    const double pressure = side == 0 ? step_.walls.below[cell][axis] : step_.walls.above[cell][axis];
    const double impulse = (side == 0 ? wall : -wall) * pressure * dt_ * level_.inverseSpacing(axis);
    held.momentum[cell][axis] += impulse;
    const double work = impulse * (0.5 * (before + after));
    held.totalEnergy[cell] += work;
    given.impulse[axis] -= impulse;
    given.work -= work;
  }

  /// Adds the momentum of friction, and its work at the mean of the walls' velocities before and after the step.
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

  /// Whether there are bodies at the lower face of a cell, or bodies have passed through it in the step.
  bool mayFlow(const Index<D>& face, int axis) const {
    const Index<D> below = face - Index<D>::unit(axis);
    return cells_.free[face] < 1 || cells_.free[below] < 1 || step_.swept[face][axis] != 0;
  }

  /// The volume of gas, per cell volume, that follows walls up through the lower face of a cell. It is the volume that
  /// the covered fraction of the face would sweep, minus the volume that bodies swept; where bodies overlap, each has
  /// swept what it covers. Walls move with the bodies that move through the face; if none does, with the velocity of
  /// the nodes.
  double followingUp(const Index<D>& above, int axis) const {
    if (!kept_.contains(above)) return findFollowingUp(above, axis);
    double& kept = following_[static_cast<std::size_t>(axis)][offsetIn<D>(kept_, above)];
    if (std::isnan(kept)) kept = findFollowingUp(above, axis);
    return kept;
  }
  double findFollowingUp(const Index<D>& above, int axis) const {
    const double covered = std::max(1 - space_.aperture(above, axis, 0), nodes_.coverageAt(above, axis));
    const double shift = step_.shiftAt(
        above, axis, [&] { return nodes_.speedsAt(above, axis).after * dt_ * level_.inverseSpacing(axis); });
    const double up = covered * shift - step_.swept[above][axis];
    const bool isIntoEmpty = space_.isEmpty(up > 0 ? above : above - Index<D>::unit(axis));
    return std::abs(up) > (isIntoEmpty ? roundOffOfEdges : roundOffOfSweeps) ? up : 0;
  }

  /// Adds the gas that follows a receding wall or is displaced by an approaching one, with its mass, momentum and
  /// energy.
  void flow(const Index<D>& cell, int axis, int side, const euler::MixtureViews<D, double>& held,
            const euler::FaceMasses<D>& masses) const {
    const Index<D> above = side == 0 ? cell : cell + Index<D>::unit(axis), below = above - Index<D>::unit(axis);
    const double up = followingUp(above, axis);
    if (up == 0) return;
    const Index<D>&donor = up > 0 ? below : above, &receiver = up > 0 ? above : below;
    const bool isIntoHole = isHoleAtSide(receiver);
    if (!isIntoHole && step_.isClosedPore(level_, receiver)) return;
    std::optional<Gift<D>> gas = isHoleAtSide(donor) ? Gift<D>{cells_.contentOf(donor, 1 / roomBefore(donor))}
                                 : isFull(donor)     ? passedBy(donor, axis)
                                                     : givenBy(donor, receiver);
    if (!gas) return;
    if (!isIntoHole && isFull(receiver) && !space_.isEmpty(donor))
      gas->share *= passingAt(receiver).accepted(static_cast<std::size_t>(axis), step_.newFree[receiver]);
    if (gas->share > 0) give(cell, axis, side, (side == 0 ? up : -up) * gas->share, gas->of, held, masses);
  }
  /// Adds a volume of gas, per cell volume, that enters a cell through one of its faces.
  void give(const Index<D>& cell, int axis, int side, double volume, const Parcel<D>& gas,
            const euler::MixtureViews<D, double>& held, const euler::FaceMasses<D>& masses) const {
    if (masses.below)
      (side == 0 ? *masses.below : *masses.above)[cell][axis] +=
          (side == 0 ? volume : -volume) * gas.u[euler::kDensity] * level_.spacing(axis) / dt_;
    held.density[cell] += volume * gas.u[euler::kDensity];
    for (int d = 0; d < D; ++d) held.momentum[cell][d] += volume * gas.u[euler::kVelocity(d)];
    held.totalEnergy[cell] += volume * gas.u[euler::kPressure<D>];
    const bool isVacuum = space_.isVacuum(cell), isClosed = staysFull(cell);
    for (std::size_t k = 0; k < held.shares.size(); ++k) {
      held.masses[k][cell] += volume * gas.masses[k];
      if (!isClosed) held.shares[k][cell] += volume * (gas.shares[k] - (isVacuum ? 0 : cells_.held.shares[k][cell]));
    }
  }

  /// The volume of gas, per cell volume, that follows bodies out of the grid through an open side; see followingUp. It
  /// is negative for gas that comes in.
  double followingOut(const Index<D>& cell, int axis, int side) const {
    if (!step_.leaving || !space_.isAtSide(cell, axis, side) || level_.cells().extent(axis) < 2) return 0;
    const bool isFree = !(cells_.free[cell] < 1) && (*step_.leaving)[cell][axis] == 0;
    if (isFree || !isOpenSide<D>(level_, gas_, cell, axis, side)) return 0;
    const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(axis);
    const double shift = nodes_.speedsAt(face, axis).after * dt_ * level_.inverseSpacing(axis);
    const double out = (1 - roomOf(cells_.free[cell])) * (side == 0 ? -shift : shift) - (*step_.leaving)[cell][axis];
    return std::abs(out) > roundOffOfEdges ? out : 0;
  }
  /// Calls `visit(axis, out)` for the sides through which gas follows bodies out of a cell, with the volume.
  template <class Visit>
  void forEachLeaving(const Index<D>& cell, Visit&& visit) const {
    for (std::size_t d = 0; d < D; ++d)
      for (const int side : {0, 1})
        if (const double out = followingOut(cell, static_cast<int>(d), side); out != 0) visit(d, out);
  }
  /// Lets gas that follows bodies out of the grid leave a cell. Gas that comes in has the state of the cell.
  void flowThroughSide(const Index<D>& cell, int axis, int side, const euler::MixtureViews<D, double>& held,
                       const euler::FaceMasses<D>& masses) const {
    const double out = followingOut(cell, axis, side);
    if (out == 0 || (out < 0 && step_.isClosedPore(level_, cell)) || isHoleAtSide(cell)) return;
    const bool full = isFull(cell);
    std::optional<Gift<D>> gas = out > 0 ? full ? passedBy(cell, axis) : givenBy(cell, cell) : std::nullopt;
    if (const auto own = out < 0 ? stateOf(cell, cell) : std::nullopt)
      gas = Gift<D>{*own, full ? passingAt(cell).accepted(static_cast<std::size_t>(axis), step_.newFree[cell]) : 1};
    if (gas && gas->share > 0) give(cell, axis, side, -out * gas->share, gas->of, held, masses);
  }
  /// Whether a cell is a hole with a trace of gas at an open side. It is open to what is beyond, so it gives and takes
  /// what follows walls.
  bool isHoleAtSide(const Index<D>& cell) const {
    if (!step_.leaving || !isFull(cell) || !(cells_.held.density[cell] > 0)) return false;
    return openSideAt<D>(level_, gas_, cell).isOne() && roomBefore(cell) > leastFreeVolume;
  }
  /// The volume of a hole at the start of the step, per cell volume.
  double roomBefore(const Index<D>& cell) const {
    double room = step_.newFree[cell];
    forEachFollowing(cell, [&](int, const Index<D>&, double volume) { room -= volume; });
    forEachLeaving(cell, [&](std::size_t, double out) { room += out; });
    return room;
  }
  /// Lets gas pass between a cell and what is beyond the side of the grid, so that the cell contains what is `kept`.
  void equalize(const Index<D>& cell, const Parcel<D>& kept, const euler::MixtureViews<D, double>& held,
                const euler::FaceMasses<D>& masses) const {
    const WayOut way = openSideAt<D>(level_, gas_, cell);
    if (masses.below)
      (way.direction < 0 ? *masses.below : *masses.above)[cell][way.axis] +=
          way.direction * (held.density[cell] - kept.u[euler::kDensity]) * level_.spacing(way.axis) / dt_;
    held.density[cell] = kept.u[euler::kDensity];
    for (int d = 0; d < D; ++d) held.momentum[cell][d] = kept.u[euler::kVelocity(d)];
    held.totalEnergy[cell] = kept.u[euler::kPressure<D>];
    for (std::size_t k = 0; k < held.shares.size(); ++k) {
      held.masses[k][cell] = kept.masses[k];
      held.shares[k][cell] = cells_.held.shares[k][cell] * std::max(step_.newFree[cell], hardlyRoom);
    }
  }

  /// Whether bodies fill a cell before and after the step. What they displace from a cell that they only now fill may
  /// be more of one gas than there was, and less of another: the cell then gives the difference to its neighbours.
  bool staysFull(const Index<D>& cell) const {
    return step_.newFree[cell] < leastFreeVolume && cells_.free[cell] < leastFreeVolume;
  }
  /// Whether bodies fill a cell at the start of a step, or leave only a hole without gas.
  bool isFull(const Index<D>& cell) const { return cells_.free[cell] < narrowFreeVolume && space_.isEmpty(cell); }

  using Passing = PassingGas<D>;
  /// Calls `visit(axis, neighbour, volume)` for the faces of a cell through which gas follows walls, with the volume
  /// that flows in, per cell volume; it is negative for gas that flows out.
  template <class Visit>
  void forEachFollowing(const Index<D>& cell, Visit&& visit) const {
    for (int d = 0; d < D; ++d)
      for (int side = 0; side < 2; ++side) {
        const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(d);
        if (space_.isAtSide(cell, d, side) || !mayFlow(face, d)) continue;
        const double up = followingUp(face, d);
        if (up != 0) visit(d, side == 0 ? cell - Index<D>::unit(d) : face, side == 0 ? up : -up);
      }
  }
  Passing passingAt(const Index<D>& cell) const {
    Passing volumes;
    if (step_.isClosedPore(level_, cell)) return volumes;  // it receives nothing, so it has nothing to pass on
    forEachFollowing(cell, [&](int axis, const Index<D>& neighbour, double volume) {
      const auto d = static_cast<std::size_t>(axis);
      if (volume < 0)
        volumes.out[d] -= volume;
      else if (!space_.isEmpty(neighbour))
        volumes.in[d] += volume;
    });
    forEachLeaving(cell, [&](std::size_t d, double out) { (out > 0 ? volumes.out : volumes.in)[d] += std::abs(out); });
    volumes.divide();
    return volumes;
  }
  /// What a cell that bodies fill passes on along an axis; it keeps a little, so that round-off leaves nothing
  /// negative.
  std::optional<Gift<D>> passedBy(const Index<D>& cell, int axis) const {
    const Passing volumes = passingAt(cell);
    const auto d = static_cast<std::size_t>(axis);
    const double passed = volumes.passedTo(d);
    if (!(passed > 0)) return std::nullopt;
    Parcel<D> mean;
    forEachFollowing(cell, [&](int along, const Index<D>& neighbour, double volume) {
      const auto e = static_cast<std::size_t>(along);
      if (volume > 0 && volumes.through[e][d] > 0 && !space_.isEmpty(neighbour))
        mean.add(cells_.parcel(neighbour), volume / volumes.in[e] * volumes.through[e][d] / passed);
    });
    forEachLeaving(cell, [&](std::size_t e, double out) {
      const auto own = out < 0 && volumes.through[e][d] > 0 ? stateOf(cell, cell) : std::nullopt;
      if (own) mean.add(*own, -out / volumes.in[e] * volumes.through[e][d] / passed);
    });
    return Gift<D>{mean, (1 - roundOffOfShares) * passed / volumes.out[d]};
  }

  /// What a donor can give. A donor with gas that is mostly free, or one that will be merged with such a neighbour,
  /// gives all that is requested; if it has too little, the neighbour supplies the rest. Any other donor gives gas of
  /// the requested density, but at most all that it has.
  std::optional<Gift<D>> givenBy(const Index<D>& donor, const Index<D>& receiver) const {
    const std::optional<Parcel<D>> wanted = stateOf(donor, receiver);
    if (!wanted) return std::nullopt;
    if (isBesideRoom(donor)) return Gift<D>{*wanted};
    const double mass = cells_.held.density[donor];
    if (!(mass > 0)) return std::nullopt;
    return Gift<D>{cells_.contentOf(donor, wanted->u[euler::kDensity] / mass),
                   mass / std::max(mass, massAskedOf(donor))};
  }
  /// The mass that a donor would give through all its faces [kg/m³]. It is an upper estimate: it includes closed pores,
  /// which receive none.
  double massAskedOf(const Index<D>& donor) const {
    double mass = 0;
    forEachFollowing(donor, [&](int, const Index<D>& neighbour, double volume) {
      const std::optional<Parcel<D>> gas = volume < 0 ? stateOf(donor, neighbour) : std::nullopt;
      if (gas) mass -= volume * gas->u[euler::kDensity];
    });
    forEachLeaving(donor, [&](std::size_t, double out) {
      if (out > 0) mass += out * cells_.held.density[donor] / cells_.free[donor];
    });
    return (1 + roundOffOfShares) * mass;
  }
  /// Whether a cell contains gas and is mostly free after the step, or will be merged with such a neighbour, possibly
  /// across a corner. If a mostly free neighbour has no gas, the cell may be merged with that one instead.
  bool isBesideRoom(const Index<D>& cell) const {
    const auto isFree = [&](const Index<D>& at) { return step_.newFree[at] >= smallFreeVolume; };
    const auto hasGas = [&](const Index<D>& at) { return cells_.held.density[at] > 0; };
    if (isFree(cell)) return hasGas(cell);
    bool any = false, all = true;
    forEach<D>(level_.clipCells(cellsAround<D>(cell, 1)), [&](const Index<D>& at) {
      any = any || isFree(at);
      all = all && (!isFree(at) || hasGas(at));
    });
    return any && all;
  }

  /// The state of the gas that a donor gives. It is that of the donor's gas or, if the donor has none, that of the
  /// receiver's gas; if the receiver has none either, it is the mean around the donor. If the donor has almost no free
  /// volume, it is a blend of the donor's and the receiver's.
  std::optional<Parcel<D>> stateOf(const Index<D>& donor, const Index<D>& receiver) const {
    const double room = space_.isEmpty(donor) ? 0 : roomOf(cells_.free[donor]) / cells_.free[donor];
    if (room == 1) return cells_.parcel(donor);
    Parcel<D> sum;
    if (room > 0) sum.add(cells_.parcel(donor), space_.isEmpty(receiver) ? 1 : room);
    if (!space_.isEmpty(receiver)) sum.add(cells_.parcel(receiver), 1 - room);
    if (room > 0 || !space_.isEmpty(receiver)) return sum;
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

  const Level& level_;
  const Settings& settings_;
  const euler::Gas& gas_;
  euler::GhostRules<D> rules_;
  const GasInCells<D>& cells_;
  FreeSpace<D> space_;
  const BodiesInStep<D>& step_;
  BodiesAtNodes<D> nodes_;
  double dt_;
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Box kept_;  ///< the cells for whose lower faces followingUp keeps its results
  mutable std::array<std::vector<double>, D> following_;  ///< these results along each axis, or `unknown`
};

}  // namespace tushar::mpmice
