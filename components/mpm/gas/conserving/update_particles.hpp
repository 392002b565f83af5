#pragma once

#include "components/mpm/gas/conserving/motion.hpp"
#include "components/mpm/gas/material.hpp"

namespace tushar::mpm::gas::conserving {

/// Sums in (E1)-(E3) of updateParticles over the nodes on a line (Axis = 0), in a plane, or in the whole footprint
/// (Axis = D - 1), with the weights along these axes.
template <int D, class Scheme, int Axis>
struct Gathered {
  static constexpr bool apic = Scheme::transfer == Transfer::apic;
  static constexpr int faceParts = apic ? D : 1;
  /// The velocity of a face [m/s]; without apic, only its normal component.
  using FaceVelocity = std::array<Lanes, faceParts>;

  std::array<LanesVec<D>, apic ? 1 : 1 << (Axis + 1)> moments;  ///< sums of y phi_a; for apic, only the first one
  std::array<FaceVelocity, Axis + 1> lower, upper;              ///< velocities of the faces normal to each axis
  /// Means of v + faceTime dt a over the nodes [m/s], of its components along the axes behind `Axis`; for apic, the
  /// first moment is the same.
  std::array<Lanes, apic ? 0 : D - 1 - Axis> moving;
  Lanes slip;    ///< beta (2 - beta) |r|² / 2 [J/kg]; for apic, twice this
  Lanes square;  ///< |y|² [J/kg]

  static Lanes normal(int axis, const FaceVelocity& velocity) { return velocity[apic ? axis : 0]; }
  /// Part of the mean velocity with which the faces move that are normal to the axis behind `Axis`.
  [[gnu::always_inline]] const Lanes& ofNextFace(int part) const {
    if constexpr (apic)
      return moments[0][part];
    else
      return moving[0];
  }
  Lanes slipEnergy() const { return !Scheme::relaxes ? 0 : apic ? 0.5 * slip : slip; }
};

/// The sum over the nodes of an axis, in the order of Span::sumOverNodes; `term(k)` is the term of node k.
template <int Below, int Cells, class Term>
[[gnu::always_inline]] inline Lanes sumOfTerms(Extent<Below, Cells>, Term&& term) {
  Lanes lowerSide = term(std::size_t{Below}), upperSide = term(std::size_t{Below + 1});
#pragma GCC unroll 8
  for (std::size_t k = Below; k > 0; --k) lowerSide += term(k - 1);
#pragma GCC unroll 8
  for (std::size_t k = Below + 2; k <= Cells; ++k) upperSide += term(k);
  return lowerSide + upperSide;
}

/// The terms of a node in the sums over a row, without the weights of other axes.
template <int D, class Scheme>
struct AtNode {
  using Fields = MotionOf<D, Scheme>;
  static constexpr bool apic = Scheme::transfer == Transfer::apic;

  LanesVec<D> y, moving;
  Lanes slip, square;

  [[gnu::always_inline]] AtNode(const RowReader<D>& read, int k, const Lanes& arm,
                                const typename Footprint<D>::template Field<0>& field) {
    LanesVec<D> r;
    for (int d = 0; d < D; ++d) r[d] = field[0][d] + arm * field[1][d];
    r -= read.vector(0, k);
    y = read.vector(Fields::accelerated, k);
    if constexpr (apic) {
      moving = y;
      slip = r.squaredNorm();
    } else {
      moving = read.vector(Fields::moving, k);
      const Lanes kept = Scheme::relaxes ? read(Fields::kept, k) : Lanes(1);
      for (int d = 0; d < D; ++d) y[d] += Scheme::relaxes ? kept * r[d] : r[d];
      if constexpr (Scheme::relaxes) slip = r.squaredNorm();
    }
  }
};

/// Adds the node k of a row to its sums; the first node of either side begins its sums.
template <int D, class Scheme, bool isFirst>
[[gnu::always_inline]] inline void addNode(const Span<Footprint<D>::overhang>& span, std::size_t k,
                                           const RowReader<D>& read,
                                           const typename Footprint<D>::template Field<0>& field,
                                           Gathered<D, Scheme, 0>& sum) {
  constexpr bool apic = Scheme::transfer == Transfer::apic;
  const AtNode<D, Scheme> node(read, static_cast<int>(k), span.arm[k], field);
  const auto add = [](Lanes & to, const Lanes& term) __attribute__((always_inline)) {
    if constexpr (isFirst)
      to = term;
    else
      to += term;
  };
  const Lanes w = span.weight[k];
  LanesVec<D> wy;
  for (int d = 0; d < D; ++d) {
    wy[d] = w * node.y[d];
    add(sum.moments[0][d], wy[d]);
    if constexpr (!apic) add(sum.moments[1][d], span.arm[k] * wy[d]);
  }
  for (std::size_t d = 0; d < sum.moving.size(); ++d) add(sum.moving[d], w * node.moving[static_cast<int>(d) + 1]);
  for (std::size_t part = 0; part < sum.lower[0].size(); ++part) {
    const Lanes moving = node.moving[static_cast<int>(part)];
    add(sum.lower[0][part], span.atLower[k] * moving);
    add(sum.upper[0][part], span.atUpper[k] * moving);
  }
  if constexpr (apic)
    add(sum.slip, w * node.slip);
  else if constexpr (Scheme::relaxes)
    add(sum.slip, w * read(MotionOf<D, Scheme>::slip, static_cast<int>(k)) * node.slip);
  add(sum.square, wy.dot(node.y));
}

/// Combines the sums over rows to those over a plane, or the sums over planes to those over the footprint.
template <int D, class Scheme, int Axis, class Along>
[[gnu::always_inline]] inline void combine(Along extent, const Span<Footprint<D>::overhang>& span,
                                           const Gathered<D, Scheme, Axis - 1>* slices,
                                           Gathered<D, Scheme, Axis>& sum) {
  constexpr std::size_t half = std::size_t{1} << Axis;
  const auto weighted = [&](const auto& of) __attribute__((always_inline)) {
    return sumOfTerms(
        extent, [&](std::size_t k) __attribute__((always_inline)) { return span.weight[k] * of(slices[k]); });
  };
  for (std::size_t a = 0; a < slices->moments.size(); ++a)
    for (int d = 0; d < D; ++d) {
      sum.moments[a][d] = weighted([&](const auto& slice) { return slice.moments[a][d]; });
      if constexpr (Scheme::transfer != Transfer::apic)
        sum.moments[a + half][d] = sumOfTerms(
            extent, [&](std::size_t k) __attribute__((always_inline)) {
              return span.weight[k] * span.arm[k] * slices[k].moments[a][d];
            });
    }
  for (std::size_t part = 0; part < sum.lower[0].size(); ++part) {
    for (std::size_t d = 0; d < Axis; ++d) {
      sum.lower[d][part] = weighted([&](const auto& slice) { return slice.lower[d][part]; });
      sum.upper[d][part] = weighted([&](const auto& slice) { return slice.upper[d][part]; });
    }
    const int at = static_cast<int>(part);
    sum.lower[Axis][part] = sumOfTerms(
        extent, [&](std::size_t k)
                    __attribute__((always_inline)) { return span.atLower[k] * slices[k].ofNextFace(at); });
    sum.upper[Axis][part] = sumOfTerms(
        extent, [&](std::size_t k)
                    __attribute__((always_inline)) { return span.atUpper[k] * slices[k].ofNextFace(at); });
  }
  for (std::size_t d = 0; d < sum.moving.size(); ++d)
    sum.moving[d] = weighted([&](const auto& slice) { return slice.moving[d + 1]; });
  if constexpr (Scheme::relaxes) sum.slip = weighted([](const auto& slice) { return slice.slip; });
  sum.square = weighted([](const auto& slice) { return slice.square; });
}

/// Sums over a row of nodes.
template <int D, class Scheme, int Below, int Cells>
[[gnu::always_inline]] inline void gatherFromRow(Extent<Below, Cells>, const Span<Footprint<D>::overhang>& span,
                                                 const RowReader<D>& row,
                                                 const typename Footprint<D>::template Field<0>& field,
                                                 Gathered<D, Scheme, 0>& sum) {
  Gathered<D, Scheme, 0> side;
  addNode<D, Scheme, true>(span, Below, row, field, sum);
#pragma GCC unroll 8
  for (std::size_t k = Below; k > 0; --k) addNode<D, Scheme, false>(span, k - 1, row, field, sum);
  addNode<D, Scheme, true>(span, Below + 1, row, field, side);
#pragma GCC unroll 8
  for (std::size_t k = Below + 2; k <= Cells; ++k) addNode<D, Scheme, false>(span, k, row, field, side);
  for (std::size_t a = 0; a < sum.moments.size(); ++a)
    for (int d = 0; d < D; ++d) sum.moments[a][d] += side.moments[a][d];
  for (std::size_t part = 0; part < sum.lower[0].size(); ++part) {
    sum.lower[0][part] += side.lower[0][part];
    sum.upper[0][part] += side.upper[0][part];
  }
  for (std::size_t d = 0; d < sum.moving.size(); ++d) sum.moving[d] += side.moving[d];
  if constexpr (Scheme::relaxes) sum.slip += side.slip;
  sum.square += side.square;
}

template <int D, class Scheme, int Axis, class Row>
[[gnu::always_inline]] inline void gatherFromNodes(Row extent, const Footprint<D>& footprint, Index<D>& at,
                                                   const Reader<D, MotionOf<D, Scheme>>& read,
                                                   const typename Footprint<D>::template Field<Axis>& field,
                                                   Gathered<D, Scheme, Axis>& sum) {
  const auto& span = footprint.along[Axis];
  if constexpr (Axis == 0) {
    gatherFromRow<D, Scheme>(extent, span, read.row(at), field, sum);
  } else {
    std::array<Gathered<D, Scheme, Axis - 1>, Footprint<D>::most + 1> slices;
    for (at[Axis] = 0; at[Axis] < span.nodes(); ++at[Axis]) {
      const std::size_t k = static_cast<std::size_t>(at[Axis]);
      gatherFromNodes<D, Scheme, Axis - 1>(extent, footprint, at, read,
                                           Footprint<D>::template slice<Axis>(field, span.arm[k]), slices[k]);
    }
    footprint.template withExtentAlong<Axis>([&](auto along) __attribute__((always_inline)) {
      combine<D, Scheme, Axis>(along, span, slices.data(), sum);
    });
  }
}

/// Computes the sum of o_c f_c over the cells of the footprint: the relative change of internal energy by work.
template <int D, class Fields, class Row>
[[gnu::always_inline]] inline Lanes workOn(Row extent, const Footprint<D>& footprint, const Reader<D, Fields>& read) {
  return footprint.sumOverRowsOfCells([&](const Index<D>& at, const Lanes& part) __attribute__((always_inline)) {
    const auto& span = footprint.along[0];
    const RowReader<D> row = read.row(at);
    return span.sumOverCells(
        extent, [&](int k, Lanes& sum) __attribute__((always_inline)) {
          sum += part * span.part[static_cast<std::size_t>(k)] * row(Fields::work, k);
        });
  });
}

/// Requires a smaller time step if a box would shrink below 0.4 of its length or become longer than `most`.
template <int D>
[[gnu::always_inline]] inline void limitEdges(const Batch<D>& batch, const Lanes& before, const Lanes& after,
                                              double most, Minimum& factor) {
  if (batch.holds((after > 0.4 * before) & (after < most))) return;
  for (int lane = 0; lane < Lanes::count; ++lane) {
    if (batch.used[lane] == 0) continue;
    const double length = before[lane], change = after[lane] - length;
    if (!(after[lane] > 0.4 * length)) factor.add(-0.5 * length / change, "compression");
    if (!(after[lane] < most)) factor.add(0.9 * (most - length) / change, "stretch");
  }
}

/// Requires a smaller time step if the work would use more than 0.8 of the internal energy, or make it negative.
template <int D>
[[gnu::always_inline]] inline void limitCooling(const Batch<D>& batch, const Lanes& work, const Lanes& energy,
                                                Minimum& factor) {
  if (batch.holds((work > -0.8) & (energy >= 0))) return;
  for (int lane = 0; lane < Lanes::count; ++lane) {
    if (batch.used[lane] == 0) continue;
    if (!(work[lane] > -0.8)) factor.add(-0.7 / work[lane], "cooling");
    if (!(energy[lane] >= 0)) factor.add(0.5, "cooling");
  }
}

/// Updates the particles of a batch, whose footprints have the given extent along the first axis.
template <int D, class Scheme, class Row>
[[gnu::always_inline]] inline void updateBatch(Row extent, const Level& level, const Batch<D>& batch,
                                               const Footprint<D>& footprint, const MotionOf<D, Scheme>& motion,
                                               const ParticleUpdate<D>& update, double dt, Minimum& factor) {
  constexpr bool apic = Scheme::transfer == Transfer::apic;
  const LanesModes<D> u = load(update.modes, batch);
  const Reader<D, MotionOf<D, Scheme>> read(motion, footprint);
  Index<D> at;
  Gathered<D, Scheme, D - 1> taken;
  gatherFromNodes<D, Scheme, D - 1>(extent, footprint, at, read, fieldOf<D>(load(update.velocity, batch), u), taken);
  const LanesVec<D> inertia = footprint.inertia();
  const auto products = productsOver(inertia);
  LanesModes<D> fresh = LanesModes<D>::Zero();
  LanesVec<D> mean, centre, size;
  for (int d = 0; d < D; ++d) mean[d] = taken.moments[0][d] + 0;  // never -0
  for (std::size_t d = 0; d < D; ++d) {
    const auto& span = footprint.along[d];
    const int axis = static_cast<int>(d);
    const Lanes lower = span.lower + dt * taken.normal(axis, taken.lower[d]);
    const Lanes upper = span.upper + dt * taken.normal(axis, taken.upper[d]);
    centre[axis] = 0.5 * (lower + upper);
    size[axis] = upper - lower;
    limitEdges(batch, span.length(), size[axis], Footprint<D>::longest * level.spacing(axis), factor);
    if constexpr (apic)
      for (std::size_t part = 0; part < D; ++part)
        fresh(static_cast<int>(part), gradientColumn(axis)) =
            ((taken.upper[d][part] + 0) - (taken.lower[d][part] + 0)) / span.length();
  }
  for (std::size_t a = 1; a < taken.moments.size(); ++a)
    for (int d = 0; d < D; ++d) fresh(d, static_cast<int>(a) - 1) = (taken.moments[a][d] + 0) / products[a];
  const Lanes within = max(0.0, 0.5 * (taken.square - mean.squaredNorm()));
  const Lanes affine = apic ? within : min(within, modalEnergy<D>(fresh, inertia));
  store(centre, update.newX, batch);
  store(size, update.newEdges, batch);
  store(mean, update.newVelocity, batch);
  store(fresh, update.newModes, batch);
  store(affine, update.newAffineEnergy, batch);
  const Lanes done = workOn(extent, footprint, read);
  const Lanes energy = load(update.internalEnergy, batch) * (1 + done) + load(update.affineEnergy, batch) -
                       modalEnergy<D>(u, inertia) + taken.slipEnergy() + (within - affine);
  limitCooling(batch, done, energy, factor);
  store(energy, update.newInternalEnergy, batch);
}

template <int D, class Scheme>
void updateAll(const Patch& patch, const ParticleUpdate<D>& update, const MotionOf<D, Scheme>& motion, double dt,
               Minimum& factor) {
  const CellsOf<D> grid(patch.level());
  forEachBatch<D>(
      patch.cells(), update.x, [&](const Batch<D>& batch) __attribute__((always_inline)) {
        const Footprint<D> footprint(grid, batch, load(update.x, batch), load(update.edges, batch));
        footprint.withExtentOfRows([&](auto extent) __attribute__((always_inline)) {
          updateBatch<D, Scheme>(extent, patch.level(), batch, footprint, motion, update, dt, factor);
        });
      });
}

/// Updates particles from node velocities v, accelerations a and relaxations beta, and from the work f on cells.
///
/// With z = u(x_i), r = z - v_i, y = z - beta r + dt a_i (apic: beta = 1, so that y = v_i + dt a_i), and means over the
/// box, sum of w_i:
///   (E1) new modes  u_a = <y phi_a> / I_a;  apic: the gradient is the difference of <y> over opposite faces
///   (E2) new affine energy  K_A = 1/2 sum over a of I_a |u_a|²;  apic: (<|y|²> - |u_0|²) / 2
///   (E3) new e = e (1 + sum o_c f_c) + K_A,old - K_old + <beta (2 - beta) |r|²> / 2 + (<|y|²> - |u_0|²) / 2 - K_A
/// so that the kinetic energy that a transfer loses becomes heat. Each face moves with the mean of its normal velocity
/// v + dt a / 2 (apic: v + dt a). A step that limitEdges or limitCooling refuses is repeated with `factor` times dt.
template <int D, class Scheme>
void updateParticles(const Patch& patch, const Gas&, const ParticleUpdate<D>& update, double dt, Minimum& factor) {
  const MotionOf<D, Scheme> motion(patch, update, dt);
  if constexpr (Scheme::transfer == Transfer::affineFlip)
    if (!motion.relaxes) return updateAll<D, Smooth<Scheme>>(patch, update, motion, dt, factor);
  updateAll<D, Scheme>(patch, update, motion, dt, factor);
}

// In update_particles.cpp, so that the kernels are compiled beside the other tasks.
extern template void updateParticles<1, Apic>(const Patch&, const Gas&, const ParticleUpdate<1>&, double, Minimum&);
extern template void updateParticles<1, AffineFlip>(const Patch&, const Gas&, const ParticleUpdate<1>&, double,
                                                    Minimum&);
extern template void updateParticles<2, Apic>(const Patch&, const Gas&, const ParticleUpdate<2>&, double, Minimum&);
extern template void updateParticles<2, AffineFlip>(const Patch&, const Gas&, const ParticleUpdate<2>&, double,
                                                    Minimum&);
extern template void updateParticles<3, Apic>(const Patch&, const Gas&, const ParticleUpdate<3>&, double, Minimum&);
extern template void updateParticles<3, AffineFlip>(const Patch&, const Gas&, const ParticleUpdate<3>&, double,
                                                    Minimum&);

}  // namespace tushar::mpm::gas::conserving
