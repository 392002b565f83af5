#pragma once

#include "components/euler/tasks/advance_block.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpmice/tasks/measure_exchange.hpp"
#include "components/mpmice/tasks/wall_force.hpp"

namespace tushar::mpmice {

/// Views of the effects of bodies on the gas in a step: by their walls, and by changes of free volumes and faces.
template <int D>
struct BodiesInStep {
  KnownWalls<D> walls;
  CellView<const double> newFree;
  CellView<const Vec<D>> swept, sweptBy;

  static BodiesInStep from(auto& take, bool isViscous) {
    return {.walls = KnownWalls<D>::from(take, 0, isViscous),
            .newFree = take(requiresNew(c::unfilledVolume, 3)),
            .swept = take(requiresNew(c::swept<D>, 2)),
            .sweptBy = take(requiresNew(c::sweptBy<D>, 2))};
  }
};

/// What the gas of a cell gives to walls in a step, per cell volume.
template <int D>
struct Given {
  Vec<D> impulse = Vec<D>::Zero();  ///< impulse per volume of the cell [N s/m³]
  double work = 0;                  ///< work per volume of the cell [J/m³]
};

/// The smallest fraction of its gas that a donor keeps, so that round-off makes no amount negative.
inline constexpr double roundOffOfShares = 1e-12;
/// The volume that follows walls, per cell volume, below which it is round-off. Below the second number, none follows
/// into a cell without gas: it would bring a trace of gas to one of two mirrored cells, and none to the other.
inline constexpr double roundOffOfSweeps = 1e-15, roundOffOfEdges = 1e-12;
/// The volume, per cell volume, of gases in a full cell, in which they keep their fractions.
inline constexpr double hardlyRoom = 1e-200;

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
      if (room < leastFreeVolume) volume = share * std::max(room, hardlyRoom);
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
        const bool flows = !space_.isAtSide(cell, d, side) && mayFlow(face, d);
        if (!(wall > 0) && !flows) continue;
        if (wall > 0) push(cell, d, side, wall, held, given);
        if (flows) flow(cell, d, side, held, masses);
      }
    }
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
    const double by = step_.sweptBy[above][axis];
    const double shift =
        by == c::notSwept ? nodes_.speedsAt(above, axis).after * dt_ * level_.inverseSpacing(axis) : by;
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
    if (isClosedPore(receiver)) return;
    std::optional<Gift> gas = isFull(donor) ? passedBy(donor, axis) : givenBy(donor, receiver);
    if (!gas) return;
    if (isFull(receiver) && !space_.isEmpty(donor))
      gas->share *= passingAt(receiver).accepted(static_cast<std::size_t>(axis), step_.newFree[receiver]);
    if (!(gas->share > 0)) return;
    if (masses.below)
      (side == 0 ? *masses.below : *masses.above)[cell][axis] +=
          up * gas->share * gas->of.u[euler::kDensity] * level_.spacing(axis) / dt_;
    const double volume = (side == 0 ? up : -up) * gas->share;
    held.density[cell] += volume * gas->of.u[euler::kDensity];
    for (int d = 0; d < D; ++d) held.momentum[cell][d] += volume * gas->of.u[euler::kVelocity(d)];
    held.totalEnergy[cell] += volume * gas->of.u[euler::kPressure<D>];
    const bool isVacuum = space_.isVacuum(cell), isClosed = step_.newFree[cell] < leastFreeVolume;
    for (std::size_t k = 0; k < held.shares.size(); ++k) {
      held.masses[k][cell] += volume * gas->of.masses[k];
      if (!isClosed)
        held.shares[k][cell] += volume * (gas->of.shares[k] - (isVacuum ? 0 : cells_.held.shares[k][cell]));
    }
  }

  /// What a donor gives: its gas, and the fraction of the requested volume that it can give.
  struct Gift {
    Parcel<D> of;
    double share = 1;
  };

  /// Whether bodies fill a cell at the start of a step, or leave only a hole without gas.
  bool isFull(const Index<D>& cell) const { return cells_.free[cell] < narrowFreeVolume && space_.isEmpty(cell); }

  /// The volumes, per cell volume, that follow walls into and out of a cell that bodies fill, along each axis, and what
  /// it passes on. It passes on only gas that flows in along other axes, as where a hole moves around an edge. So no
  /// gas passes straight through a body whose boxes do not move exactly as its walls do.
  struct Passing {
    using PerAxis = std::array<double, D>;
    PerAxis in{}, out{};
    std::array<PerAxis, D> through{};  ///< volume that flows in along the first axis and out along the second

    /// Divides what flows out among the axes along which gas flows in, in proportion to what these bring.
    void divide() {
      for (std::size_t d = 0; d < D; ++d) {
        double across = 0;
        for (std::size_t e = 0; e < D; ++e) across += e == d ? 0 : in[e];
        for (std::size_t e = 0; e < D; ++e)
          if (e != d && across > 0) through[e][d] = std::min(1.0, out[d] / across) * in[e];
      }
      for (std::size_t e = 0; e < D; ++e)
        if (const double most = passedFrom(e); most > in[e])
          for (double& volume : through[e]) volume *= in[e] / most;
    }
    double passedFrom(std::size_t axis) const {
      double sum = 0;
      for (const double volume : through[axis]) sum += volume;
      return sum;
    }
    double passedTo(std::size_t axis) const {
      double sum = 0;
      for (const PerAxis& from : through) sum += from[axis];
      return sum;
    }
    /// The fraction of what flows in along an axis that is passed on, or that has room in the cell.
    double accepted(std::size_t axis, double room) const {
      double rest = 0;
      for (std::size_t e = 0; e < D; ++e) rest += in[e] - passedFrom(e);
      const double passed = passedFrom(axis), kept = rest > room ? std::max(0.0, room) / rest : 1;
      return (passed + kept * (in[axis] - passed)) / in[axis];
    }
  };
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
    if (isClosedPore(cell)) return volumes;  // it receives nothing, so it has nothing to pass on
    forEachFollowing(cell, [&](int axis, const Index<D>& neighbour, double volume) {
      const auto d = static_cast<std::size_t>(axis);
      if (volume < 0)
        volumes.out[d] -= volume;
      else if (!space_.isEmpty(neighbour))
        volumes.in[d] += volume;
    });
    volumes.divide();
    return volumes;
  }
  /// What a cell that bodies fill passes on along an axis; it keeps a little, so that round-off leaves nothing
  /// negative.
  std::optional<Gift> passedBy(const Index<D>& cell, int axis) const {
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
    return Gift{mean, (1 - roundOffOfShares) * passed / volumes.out[d]};
  }

  /// What a donor can give. A donor with gas that is mostly free, or one that will be merged with such a neighbour,
  /// gives all that is requested; if it has too little, the neighbour supplies the rest. Any other donor gives gas of
  /// the requested density, but at most all that it has.
  std::optional<Gift> givenBy(const Index<D>& donor, const Index<D>& receiver) const {
    const std::optional<Parcel<D>> wanted = stateOf(donor, receiver);
    if (!wanted) return std::nullopt;
    if (isBesideRoom(donor)) return Gift{*wanted};
    const double mass = cells_.held.density[donor];
    if (!(mass > 0)) return std::nullopt;
    return Gift{cells_.contentOf(donor, wanted->u[euler::kDensity] / mass), mass / std::max(mass, massAskedOf(donor))};
  }
  /// The mass that a donor would give through all its faces [kg/m³]. It is an upper estimate: it includes closed pores,
  /// which receive none.
  double massAskedOf(const Index<D>& donor) const {
    double mass = 0;
    forEachFollowing(donor, [&](int, const Index<D>& neighbour, double volume) {
      const std::optional<Parcel<D>> gas = volume < 0 ? stateOf(donor, neighbour) : std::nullopt;
      if (gas) mass -= volume * gas->u[euler::kDensity];
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
    if (!space_.isEmpty(receiver)) return mixed(room, donor, receiver);
    if (room > 0) return cells_.parcel(donor);
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
  /// `part` times the state of the cell `of`, plus 1 - `part` times the state of the cell `rest`.
  Parcel<D> mixed(double part, const Index<D>& of, const Index<D>& rest) const {
    Parcel<D> sum;
    if (part > 0) sum.add(cells_.parcel(of), part);
    sum.add(cells_.parcel(rest), 1 - part);
    return sum;
  }

  /// Whether a cell is a hole in a body: it has little free volume, and no cell up to two cells away is mostly free.
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
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Box kept_;  ///< the cells for whose lower faces followingUp keeps its results
  mutable std::array<std::vector<double>, D> following_;  ///< these results along each axis, or `unknown`
};

}  // namespace tushar::mpmice
