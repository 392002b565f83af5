#include "components/mpm/solid/explicit/tasks/remove_lost.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>

#include "core/data/vanished.hpp"

namespace tushar::mpm::solid {

template <int D>
bool BetweenPlanes<D>::areBetweenInnerPlanes(const Index<D>& from, const Vec<D>* x, int count) const {
  return std::all_of(x, x + count, [&](const Vec<D>& one) { return innerPlanes(from, one).count == 0; });
}

template <int D>
grid::PassedSides BetweenPlanes<D>::innerPlanes(const Index<D>& from, const Vec<D>& x) const {
  grid::PassedSides planes;
  if (!x.allFinite()) return planes;
  const Index<D> to = grid::withUpperSides<D>(*severalBoxes, from, x, severalBoxes->cellOf<D>(x));
  const grid::PassedSides passed = grid::passedSides<D>(*severalBoxes, from, to);
  planes.arePastEdge = passed.arePastEdge;
  for (const grid::PassedSides::Side& one : passed)
    if (severalBoxes->isSymmetry(one.axis, one.side, material)) planes.add(one);
  return planes;
}

template struct BetweenPlanes<1>;
template struct BetweenPlanes<2>;
template struct BetweenPlanes<3>;

namespace {

/// The error for the first particle of a cell whose wave speed is undefined: its velocity is not a number, it is
/// inverted, or the step deforms it too much.
template <int D>
NumericalError withoutWaveSpeed(const Level& level, const StateUpdate<D>& u, const Index<D>& cell,
                                const data::ParticleRange& range) {
  const auto isSound = [&](int p) { return u.velocity[p].allFinite() && u.deformation[p].determinant() > 0; };
  int p = range.first;
  while (p + 1 < range.last && isSound(p)) ++p;
  const Vec3 x = level.expandPoint<D>(u.x[p]);
  if (u.deformation[p] == -Matrix3::Identity())
    return {fmt::format("the step deforms the particle at ({:g}, {:g}, {:g}) m so much that nodes next to it must have "
                        "moved farther than a cell",
                        x[0], x[1], x[2]),
            "", "p.deformationMeasure", level.cellNumber<D>(cell)};
  return {fmt::format("the wave speed of the particle at ({:g}, {:g}, {:g}) m is not a number: det F is {:g}, the "
                      "particle's speed {:g} m/s",
                      x[0], x[1], x[2], u.deformation[p].determinant(), u.velocity[p].norm()),
          "", "p.deformationMeasure", level.cellNumber<D>(cell)};
}

/// Marks a particle as removed, and gives it the state at the start of the step, so that later tasks of the step can
/// still read it.
template <int D>
void removeParticle(const StateUpdate<D>& u, int p) {
  (*u.newX)[p][0] = data::removed;
  u.deformation[p] = u.oldDeformation[p];
  if (u.volume) (*u.volume)[p] = (*u.oldVolume)[p];
  if (u.stress) (*u.stress)[p] = (*u.oldStress)[p];
  if (u.state) std::copy_n(valuesOf(u.oldState) + p * u.stateSize, u.stateSize, valuesOf(u.state) + p * u.stateSize);
  if (u.viscosity) (*u.viscosity)[p] = 0;
  if (u.strainEnergy) (*u.strainEnergy)[p] = 0;
  if (u.temperatureChange) (*u.temperatureChange)[p] = 0;
  if (u.velocityGradient) (*u.velocityGradient)[p].setZero();
}

/// How far beyond a symmetry plane a particle may drift in a step [cells].
constexpr double mostDrift = 0.1;

/// Does the same as putBack for planes at inner sides of a level of several boxes. A particle that has passed through
/// both walls of a re-entrant edge is behind both; it is put back through the nearer one.
template <int D>
void putBackThroughInnerPlanes(const Level& level, const Index<D>& from, const BetweenPlanes<D>& space, Vec<D>& x) {
  const grid::PassedSides passed = space.innerPlanes(from, x);
  const auto position = [&](const grid::PassedSides::Side& one) { return level.nodePosition(one.axis, one.plane); };
  const auto depth = [&](const grid::PassedSides::Side& one) {
    return std::abs(x[one.axis] - position(one)) * level.inverseSpacing(one.axis);
  };
  const auto isNearer = [&](const auto& a, const auto& b) { return depth(a) < depth(b); };
  const auto reflect = [&](const grid::PassedSides::Side& one) {
    if (depth(one) <= mostDrift) x[one.axis] = 2 * position(one) - x[one.axis];
  };
  if (passed.arePastEdge && passed.count > 0)
    reflect(*std::min_element(passed.begin(), passed.end(), isNearer));
  else
    std::for_each(passed.begin(), passed.end(), reflect);
}

/// Puts a particle that has drifted a little through symmetry planes back, at the same distance in front of them.
/// Returns whether it is between the planes then. The mean velocity of the corners of a skewed CPDI domain need not
/// vanish on a plane, though that of the nodes does; as a mirrored body would send an image the other way, the particle
/// is not lost. Its velocity and F, which the image would have mirrored, stay as they are.
template <int D>
bool putBack(const Level& level, const Index<D>& from, const BetweenPlanes<D>& space, Vec<D>& x) {
  for (int d = 0; d < D; ++d) {
    const double most = mostDrift * level.spacing(d);
    if (x[d] < space.lower[d] && x[d] >= space.lower[d] - most) x[d] = 2 * space.lower[d] - x[d];
    if (x[d] > space.upper[d] && x[d] <= space.upper[d] + most) x[d] = 2 * space.upper[d] - x[d];
  }
  if (space.severalBoxes) putBackThroughInnerPlanes<D>(level, from, space, x);
  return space.contains(from, x);
}

}  // namespace

template <int D>
CrossingRate<D> withoutLost(const Level& level, const StateUpdate<D>& u, const Index<D>& cell,
                            const data::ParticleRange& range, const CrossingRate<D>& none,
                            const BetweenPlanes<D>& space, const double* waveSpeed) {
  CrossingRate<D> rate = none;
  for (int k = 0; k < range.size(); ++k) {
    const int p = range.first + k;
    const bool isInverted = u.deformation[p].determinant() <= 0;
    if (!isInverted && (!u.newX || putBack<D>(level, cell, space, (*u.newX)[p])))
      rate.add(waveSpeed[k], u.velocity[p]);
    else if (u.newX)
      removeParticle<D>(u, p);
    else
      throw withoutWaveSpeed<D>(level, u, cell, range);
  }
  if (!rate.isKnown()) throw withoutWaveSpeed<D>(level, u, cell, range);
  return rate;
}

template CrossingRate<1> withoutLost(const Level&, const StateUpdate<1>&, const Index<1>&, const data::ParticleRange&,
                                     const CrossingRate<1>&, const BetweenPlanes<1>&, const double*);
template CrossingRate<2> withoutLost(const Level&, const StateUpdate<2>&, const Index<2>&, const data::ParticleRange&,
                                     const CrossingRate<2>&, const BetweenPlanes<2>&, const double*);
template CrossingRate<3> withoutLost(const Level&, const StateUpdate<3>&, const Index<3>&, const data::ParticleRange&,
                                     const CrossingRate<3>&, const BetweenPlanes<3>&, const double*);

}  // namespace tushar::mpm::solid
