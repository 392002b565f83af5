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

  /// For apic, the sum of y = v + dt a [m/s]. Otherwise the sums of g phi_a, where g is the change of the velocity.
  std::array<LanesVec<D>, apic ? 1 : 1 << (Axis + 1)> moments;
  std::array<FaceVelocity, Axis + 1> lower, upper;  ///< velocities of the faces normal to each axis
  /// Means of v + faceTime dt a over the nodes [m/s], of its components along the axes behind `Axis`; for apic, the
  /// first moment is the same.
  std::array<Lanes, apic ? 0 : D - 1 - Axis> moving;
  Lanes slip;    ///< beta (2 - beta) |r|² / 2 [J/kg]; for apic, twice this
  Lanes square;  ///< |y|² or |g|² [J/kg]

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

/// The terms of a node in the sums over a row, without the weights of other axes.
template <int D, class Scheme>
struct AtNode {
  using Fields = MotionOf<D, Scheme>;
  static constexpr bool apic = Scheme::transfer == Transfer::apic;

  LanesVec<D> later;  ///< y or g
  Lanes slip, square;

  [[gnu::always_inline]] AtNode(const RowReader<D>& read, int k, const Lanes& arm,
                                const typename Footprint<D>::template Field<0>& field) {
    later = read.vector(Fields::later, k);
    square = read(Fields::square, k);
    if constexpr (!Scheme::relaxes) return;
    LanesVec<D> r;
    for (int d = 0; d < D; ++d)
      r[d] = multiplyAdd(arm, field[1][d], field[0][d]) - read(static_cast<std::size_t>(d), k);
    slip = squareOf<D>(r);
    if constexpr (!apic) {
      const Lanes lost = -read(Fields::beta, k);
      for (int d = 0; d < D; ++d) later[d] = multiplyAdd(lost, r[d], later[d]);
      square = squareOf<D>(later);
      slip *= read(Fields::slip, k);
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
  using Fields = MotionOf<D, Scheme>;
  const AtNode<D, Scheme> node(read, static_cast<int>(k), span.arm[k], field);
  const auto add = [](Lanes & to, const Lanes& factor, const Lanes& value) __attribute__((always_inline)) {
    if constexpr (isFirst)
      to = factor * value;
    else
      to = multiplyAdd(factor, value, to);
  };
  const Lanes w = span.weight[k];
  for (int d = 0; d < D; ++d) {
    add(sum.moments[0][d], w, node.later[d]);
    if constexpr (!apic) add(sum.moments[1][d], span.lever[k], node.later[d]);
  }
  for (std::size_t part = 0; part < sum.lower[0].size(); ++part) {
    const Lanes moving = apic ? node.later[static_cast<int>(part)] : read(Fields::moving, static_cast<int>(k));
    add(sum.lower[0][part], span.atLower[k], moving);
    add(sum.upper[0][part], span.atUpper[k], moving);
  }
  for (std::size_t d = 0; d < sum.moving.size(); ++d)
    add(sum.moving[d], w, read(Fields::moving + d + 1, static_cast<int>(k)));
  if constexpr (Scheme::relaxes) add(sum.slip, w, node.slip);
  add(sum.square, w, node.square);
}

/// Adds the sums over a row to those over a plane, or the sums over a plane to those over the footprint; the first ones
/// of either side begin the sums.
template <int D, class Scheme, int Axis, bool isFirst>
[[gnu::always_inline]] inline void addSlice(const Span<Footprint<D>::overhang>& span, std::size_t k,
                                            const Gathered<D, Scheme, Axis - 1>& slice,
                                            Gathered<D, Scheme, Axis>& sum) {
  constexpr std::size_t half = std::size_t{1} << Axis;
  const Lanes w = span.weight[k];
  const auto add = [](Lanes & to, const Lanes& factor, const Lanes& value) __attribute__((always_inline)) {
    if constexpr (isFirst)
      to = factor * value;
    else
      to = multiplyAdd(factor, value, to);
  };
  for (std::size_t a = 0; a < slice.moments.size(); ++a)
    for (int d = 0; d < D; ++d) {
      add(sum.moments[a][d], w, slice.moments[a][d]);
      if constexpr (Scheme::transfer != Transfer::apic)
        add(sum.moments[a + half][d], span.lever[k], slice.moments[a][d]);
    }
  for (std::size_t part = 0; part < sum.lower[0].size(); ++part) {
    for (std::size_t d = 0; d < Axis; ++d) {
      add(sum.lower[d][part], w, slice.lower[d][part]);
      add(sum.upper[d][part], w, slice.upper[d][part]);
    }
    add(sum.lower[Axis][part], span.atLower[k], slice.ofNextFace(static_cast<int>(part)));
    add(sum.upper[Axis][part], span.atUpper[k], slice.ofNextFace(static_cast<int>(part)));
  }
  for (std::size_t d = 0; d < sum.moving.size(); ++d) add(sum.moving[d], w, slice.moving[d + 1]);
  if constexpr (Scheme::relaxes) add(sum.slip, w, slice.slip);
  add(sum.square, w, slice.square);
}

/// Adds the sums over the nodes on one side of the middle of an axis to those on the other side.
template <int D, class Scheme, int Axis>
[[gnu::always_inline]] inline void addSide(const Gathered<D, Scheme, Axis>& side, Gathered<D, Scheme, Axis>& sum) {
  for (std::size_t a = 0; a < sum.moments.size(); ++a)
    for (int d = 0; d < D; ++d) sum.moments[a][d] += side.moments[a][d];
  for (std::size_t d = 0; d <= Axis; ++d)
    for (std::size_t part = 0; part < sum.lower[0].size(); ++part) {
      sum.lower[d][part] += side.lower[d][part];
      sum.upper[d][part] += side.upper[d][part];
    }
  for (std::size_t d = 0; d < sum.moving.size(); ++d) sum.moving[d] += side.moving[d];
  if constexpr (Scheme::relaxes) sum.slip += side.slip;
  sum.square += side.square;
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
  addSide<D, Scheme, 0>(side, sum);
}

/// Sums over the nodes of the footprint, or of a plane or row of it. On either side of the middle of an axis, they are
/// added from the inside out, so that the mirror image has the same sum.
template <int D, class Scheme, int Axis, class Row>
[[gnu::always_inline]] inline void gatherFromNodes(Row extent, const Footprint<D>& footprint, Index<D>& at,
                                                   const Reader<D, MotionOf<D, Scheme>>& read,
                                                   const typename Footprint<D>::template Field<Axis>& field,
                                                   Gathered<D, Scheme, Axis>& sum) {
  const auto& span = footprint.along[Axis];
  if constexpr (Axis == 0) {
    gatherFromRow<D, Scheme>(extent, span, read.row(at), field, sum);
  } else {
    std::array<Gathered<D, Scheme, Axis>, 2> sides;
    for (const int side : {0, 1}) {  // a loop, because the code would be twice as long without
      Gathered<D, Scheme, Axis>& onSide = sides[static_cast<std::size_t>(side)];
      const int first = span.below + side;
      for (at[Axis] = first; at[Axis] >= 0 && at[Axis] < span.nodes(); at[Axis] += 2 * side - 1) {
        const std::size_t k = static_cast<std::size_t>(at[Axis]);
        Gathered<D, Scheme, Axis - 1> slice;
        gatherFromNodes<D, Scheme, Axis - 1>(extent, footprint, at, read,
                                             Footprint<D>::template slice<Axis>(field, span.arm[k]), slice);
        if (at[Axis] == first)
          addSlice<D, Scheme, Axis, true>(span, k, slice, onSide);
        else
          addSlice<D, Scheme, Axis, false>(span, k, slice, onSide);
      }
    }
    sum = sides[0];
    addSide<D, Scheme, Axis>(sides[1], sum);
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
          sum = multiplyAdd(part * span.part[static_cast<std::size_t>(k)], row(Fields::work, k), sum);
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

/// (E1) and (E2) of updateParticles: the new velocities of a batch.
template <int D, class Scheme>
struct NewVelocity {
  LanesVec<D> mean;
  LanesModes<D> modes;
  Lanes affine;    ///< the new K_A
  Lanes rest = 0;  ///< kinetic energy about the mean that is not part of it

  /// `v` and `u` are the old mean and modes.
  [[gnu::always_inline]] NewVelocity(const Footprint<D>& footprint, const Gathered<D, Scheme, D - 1>& taken,
                                     const LanesVec<D>& v, const LanesModes<D>& u) {
    const LanesVec<D> gain = taken.moments[0];
    if constexpr (Scheme::transfer == Transfer::apic) {
      for (int d = 0; d < D; ++d) mean[d] = gain[d] + 0;  // never -0
      modes = LanesModes<D>::Zero();
      for (std::size_t d = 0; d < D; ++d)
        for (std::size_t part = 0; part < D; ++part)
          modes(static_cast<int>(part), gradientColumn(static_cast<int>(d))) =
              ((taken.upper[d][part] + 0) - (taken.lower[d][part] + 0)) * footprint.along[d].perLength;
      affine = max(0.0, 0.5 * (taken.square - mean.squaredNorm()));
    } else {
      mean = v + gain;
      const LanesVec<D> inertia = footprint.inertia();
      const auto inverse = productsOver(LanesVec<D>(inertia.cwiseInverse()));
      Lanes all = taken.square - squareOf<D>(gain);
      for (std::size_t a = 1; a < taken.moments.size(); ++a) {
        all -= inverse[a] * squareOf<D>(taken.moments[a]);
        for (int d = 0; d < D; ++d) {
          const int column = static_cast<int>(a) - 1;
          modes(d, column) = multiplyAdd(inverse[a], taken.moments[a][d], u(d, column)) + 0;
        }
      }
      affine = modalEnergy<D>(modes, inertia);
      rest = max(0.0, 0.5 * all);
    }
  }
};

/// Updates the particles of a batch.
template <int D, class Scheme>
[[gnu::always_inline]] inline void updateBatch(const Level& level, const CellsOf<D>& grid, const Batch<D>& batch,
                                               const MotionOf<D, Scheme>& motion, const ParticleUpdate<D>& update,
                                               double dt, Minimum& factor) {
  constexpr Computes<SpanValues::all> values;
  Footprint<D> footprint(grid, batch, load(update.x, batch), load(update.edges, batch), values, OnlyEnds());
  const LanesModes<D> u = load(update.modes, batch);
  const LanesVec<D> v = load(update.velocity, batch);
  const Reader<D, MotionOf<D, Scheme>> read(motion, footprint);
  Gathered<D, Scheme, D - 1> taken;
  Lanes done;
  footprint.weighRows(
      grid, values, [&](auto extent) __attribute__((always_inline)) {
        Index<D> at;
        gatherFromNodes<D, Scheme, D - 1>(extent, footprint, at, read, fieldOf<D>(v, u), taken);
        done = workOn(extent, footprint, read);
      });
  LanesVec<D> centre, size;
  for (std::size_t d = 0; d < D; ++d) {
    const auto& span = footprint.along[d];
    const int axis = static_cast<int>(d);
    const Lanes lower = span.lower + dt * taken.normal(axis, taken.lower[d]);
    const Lanes upper = span.upper + dt * taken.normal(axis, taken.upper[d]);
    centre[axis] = 0.5 * (lower + upper);
    size[axis] = upper - lower;
    limitEdges(batch, span.length(), size[axis], Footprint<D>::longest * level.spacing(axis), factor);
  }
  const NewVelocity<D, Scheme> fresh(footprint, taken, v, u);
  const Lanes energy = load(update.internalEnergy, batch) * (1 + done) + load(update.affineEnergy, batch) -
                       modalEnergy<D>(u, footprint.inertia()) + taken.slipEnergy() + fresh.rest;
  limitCooling(batch, done, energy, factor);
  store(centre, update.newX, batch);
  store(size, update.newEdges, batch);
  store(fresh.mean, update.newVelocity, batch);
  store(fresh.modes, update.newModes, batch);
  store(fresh.affine, update.newAffineEnergy, batch);
  store(energy, update.newInternalEnergy, batch);
}

/// Updates the particles of the cells in a box.
template <int D, class Scheme>
void updateAll(const Box& cells, const CellsOf<D>& grid, const Level& level, const ParticleUpdate<D>& update,
               const MotionOf<D, Scheme>& motion, double dt, Minimum& factor) {
  forEachBatch<D>(
      cells, update.x, [&](const Batch<D>& batch) __attribute__((always_inline)) {
        updateBatch<D, Scheme>(level, grid, batch, motion, update, dt, factor);
      });
}

/// Updates particles from node velocities v, accelerations a and relaxations beta, and from the work f on cells.
///
/// With z = u(x_i), r = z - v_i, g = dt a_i - beta r, and means over the box, sum of w_i, the grid replaces z by y = z
/// + g (apic: beta = 1, so that y = v_i + dt a_i):
///   (E1) new modes  u_a + <g phi_a> / I_a;  apic: <y>, and the gradient is the difference of <y> over opposite faces
///   (E2) new affine energy  K_A = 1/2 sum over a of I_a |u_a|²;  apic: (<|y|²> - |u_0|²) / 2
///   (E3) new e = e (1 + sum o_c f_c) + K_A,old - K_old + <beta (2 - beta) |r|²> / 2 + R
/// so that the kinetic energy that a transfer loses becomes heat. R is the kinetic energy that the new modes cannot
/// represent, (<|g|²> - sum over all a of |<g phi_a>|² / I_a) / 2; apic: 0. Because the phi_a are orthogonal, <phi_a
/// phi_b> = 0, modes that represent z exactly need no sums over z. Each face moves with the mean of its normal velocity
/// v + dt a / 2 (apic: v + dt a). A step that limitEdges or limitCooling refuses is repeated with `factor` times dt.
template <int D, class Scheme>
void updateParticles(const Patch& patch, const Gas&, const ParticleUpdate<D>& update, double dt, Minimum& factor) {
  const CellsOf<D> grid(patch.level());
  MotionOf<D, Scheme> motion(patch, update, dt);
  Box slab = patch.cells();
  const int first = slab.lower[D - 1], last = D == 1 ? first : slab.upper[D - 1] - 1;
  for (int at = first; at <= last; ++at) {
    motion.moveTo(at);
    if constexpr (D > 1) {
      slab.lower[D - 1] = at;
      slab.upper[D - 1] = at + 1;
    }
    if constexpr (Scheme::transfer == Transfer::affineFlip)
      if (!motion.relaxes()) {
        updateAll<D, Smooth<Scheme>>(slab, grid, patch.level(), update, motion, dt, factor);
        continue;
      }
    updateAll<D, Scheme>(slab, grid, patch.level(), update, motion, dt, factor);
  }
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
