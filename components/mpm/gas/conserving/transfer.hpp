#pragma once

#include "components/mpm/gas/conserving/footprint.hpp"
#include "components/mpm/gas/conserving/grid_sums.hpp"
#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/conserving/scheme.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/symmetry_planes.hpp"

namespace tushar::mpm::gas::conserving {

/// The velocities in the boxes of particles, as multilinear fields about the centres of the boxes.
template <int D>
typename Footprint<D>::template Field<D - 1> fieldOf(const LanesVec<D>& velocity, const LanesModes<D>& modes) {
  typename Footprint<D>::template Field<D - 1> field;
  field[0] = velocity;
  for (std::size_t a = 1; a < field.size(); ++a) field[a] = modes.col(static_cast<int>(a) - 1);
  return field;
}

/// Sums over boxes: mass and momentum at nodes; mass, internal energy and, if `Fills`, volume in cells.
template <int D, bool Fills>
struct Gathering {
  using Nodes = GridSums<D, 1 + D, 1>;
  using Cells = GridSums<D, Fills ? 3 : 2, 0>;

  Nodes nodes;
  Cells cells;

  explicit Gathering(const Box& around) : nodes(around), cells(around) {}

  void add(const Footprint<D>& footprint, const Lanes& mass, const Lanes& energy, const Lanes& volume,
           const typename Footprint<D>::template Field<D - 1>& velocity) {
    typename Cells::Brought parts;
    footprint.forEachPart([&](const Index<D>& k, const Lanes& part) {
      const std::size_t place = Footprint<D>::number(k);
      parts[0][place] = part * mass;
      parts[1][place] = part * energy;
      if constexpr (Fills) parts[2][place] = part * volume;
    });
    cells.add(footprint, parts);
    typename Nodes::Brought brought;
    footprint.forEachWeight(velocity, [&](const Index<D>& k, const Lanes& w, const LanesVec<D>& u) {
      const std::size_t place = Footprint<D>::number(k);
      brought[0][place] = w * mass;
      for (std::size_t d = 0; d < D; ++d) brought[d + 1][place] = brought[0][place] * u[static_cast<int>(d)];
    });
    nodes.add(footprint, brought);
  }
  void finish() {
    nodes.finish();
    cells.finish();
  }
};

/// Views of particles, and of the grid state that is gathered from them.
template <int D>
struct ParticlesToGrid {
  ParticleView<const Vec<D>> x, edges;
  ParticleView<const double> mass;
  ParticleView<const Vec<D>> velocity;
  ParticleView<const Modes<D>> modes;
  ParticleView<const double> internalEnergy;
  NodeView<double> nodeMass;
  NodeView<Vec<D>> nodeVelocity;
  CellView<double> cellMass, cellInternalEnergy;

  static ParticlesToGrid from(auto& take) {
    constexpr int reach = Footprint<D>::reach;
    return {.x = take(requiresNew(p::x<D>, reach)),
            .edges = take(requiresNew(p::edges<D>, reach)),
            .mass = take(requiresNew(p::mass, reach)),
            .velocity = take(requiresNew(p::velocity<D>, reach)),
            .modes = take(requiresNew(p::modes<D>, reach)),
            .internalEnergy = take(requiresNew(p::internalEnergy, reach)),
            .nodeMass = take(computes(g::mass)),
            .nodeVelocity = take(computes(g::velocity<D>)),
            .cellMass = take(computes(c::mass)),
            .cellInternalEnergy = take(computes(c::internalEnergy))};
  }
};

/// Computes m_i = sum w m,   v_i = sum w m u(x_i) / m_i on the patch's nodes,   M_c = sum o m,   IE_c = sum o m e in
/// its cells;
/// w and o as in Footprint, u the velocity of the particle's modes. Symmetry planes: no normal velocity.
/// If `Fills`, calls `visitFill(cell, volume)` with the volume of the boxes in each cell.
template <int D, bool Fills, class Visit>
void gatherOnGrid(const Patch& patch, const ParticlesToGrid<D>& t, Visit&& visitFill) {
  Gathering<D, Fills> sums(t.x.cells());
  forEachBatch<D>(t.x.cells(), t.x, [&](const Batch<D>& batch) {
    const LanesVec<D> size = load(t.edges, batch);
    const Footprint<D> footprint(patch.level(), batch, load(t.x, batch), size);
    const Lanes m = batch.only(load(t.mass, batch));
    sums.add(footprint, m, m * load(t.internalEnergy, batch), batch.only(size.prod()),
             fieldOf<D>(load(t.velocity, batch), load(t.modes, batch)));
  });
  sums.finish();
  forEach<D>(t.cellMass.box(), [&](const Index<D>& cell) {
    t.cellMass[cell] = sums.cells.at(0, cell);
    t.cellInternalEnergy[cell] = sums.cells.at(1, cell);
    if constexpr (Fills) visitFill(cell, sums.cells.at(2, cell));
  });
  forEach<D>(t.nodeMass.box(), [&](const Index<D>& node) {
    const double m = sums.nodes.at(0, node), inverse = m > 0 ? 1 / m : 0;
    t.nodeMass[node] = m;
    for (std::size_t d = 0; d < D; ++d)
      t.nodeVelocity[node][static_cast<int>(d)] = inverse * sums.nodes.at(d + 1, node);
  });
  stopAtSymmetryPlanes<D>(patch, t.nodeVelocity);
}

/// Gathers the particles on the grid: the task that only calls gatherOnGrid.
template <int D>
void interpolateParticlesToGrid(const Patch& patch, const Gas&, const ParticlesToGrid<D>& transfer) {
  gatherOnGrid<D, false>(patch, transfer, [](const Index<D>&, double) {});
}

/// Calls gatherOnGrid, and computes the fraction of each cell that boxes fill, which is 1 if they tile the cell.
template <int D>
void interpolateAndMeasureFill(const Patch& patch, const Gas&, const ParticlesToGrid<D>& transfer,
                               CellView<double> fill, Maximum& greatest) {
  double inverse = 1;
  for (int d = 0; d < D; ++d) inverse *= patch.level().inverseSpacing(d);
  gatherOnGrid<D, true>(patch, transfer, [&](const Index<D>& cell, double volume) {
    fill[cell] = volume * inverse;
    greatest.add(fill[cell]);
  });
}

/// Sums in (E1)-(E3) of updateParticles over the nodes on a line (Axis = 0), in a plane, or in the whole footprint
/// (Axis = D - 1), with the weights along these axes.
template <int D, class Scheme, int Axis>
struct Gathered {
  static constexpr bool apic = Scheme::transfer == Transfer::apic;
  /// The velocity of a face [m/s]; without apic, only its normal component.
  using FaceVelocity = std::conditional_t<apic, LanesVec<D>, Lanes>;

  std::array<LanesVec<D>, apic ? 1 : 1 << (Axis + 1)> moments;  ///< sums of y phi_a; for apic, only the first one
  std::array<FaceVelocity, Axis + 1> lower, upper;              ///< velocities of the faces normal to each axis
  LanesVec<D> moving = LanesVec<D>::Zero();                     ///< mean of v + faceTime dt a over the nodes [m/s]
  Lanes slipEnergy = 0;                                         ///< beta (2 - beta) |r|² / 2 [J/kg]
  Lanes square = 0;                                             ///< |y|² [J/kg]

  Gathered() {
    moments.fill(LanesVec<D>::Zero());
    for (int d = 0; d <= Axis; ++d) lower[static_cast<std::size_t>(d)] = ofFace(d, LanesVec<D>::Zero());
    upper = lower;
  }
  static FaceVelocity ofFace(int axis, const LanesVec<D>& velocity) {
    if constexpr (apic)
      return velocity;
    else
      return velocity[axis];
  }
  static Lanes normal(int axis, const FaceVelocity& velocity) {
    if constexpr (apic)
      return velocity[axis];
    else
      return velocity;
  }
  Gathered& operator+=(const Gathered& other) {
    for (std::size_t a = 0; a < moments.size(); ++a) moments[a] += other.moments[a];
    for (std::size_t d = 0; d < lower.size(); ++d) {
      lower[d] += other.lower[d];
      upper[d] += other.upper[d];
    }
    moving += other.moving;
    slipEnergy += other.slipEnergy;
    square += other.square;
    return *this;
  }
};

/// Grid fields from which particles are updated: at nodes, the components of v, v + dt a and v + faceTime dt a, and 1 -
/// beta and beta (2 - beta) / 2; in cells, f.
template <int D>
struct Motion : GridFields<D, 3 * D + 3> {
  static constexpr std::size_t accelerated = D, moving = 2 * D, kept = 3 * D, slip = kept + 1, work = kept + 2;
  using GridFields<D, 3 * D + 3>::GridFields;
};

/// Views of the variables that updateParticles reads and writes.
template <int D>
struct ParticleUpdate {
  // Particles at the start of the step.
  ParticleView<const Vec<D>> x, edges, velocity;
  ParticleView<const Modes<D>> modes;
  ParticleView<const double> internalEnergy, affineEnergy;
  // The grid.
  NodeView<const Vec<D>> nodeVelocity, acceleration;
  NodeView<const double> relaxation;
  CellView<const double> work;
  // Particles at the end of the step.
  ParticleView<Vec<D>> newX, newEdges, newVelocity;
  ParticleView<Modes<D>> newModes;
  ParticleView<double> newInternalEnergy, newAffineEnergy;

  static ParticleUpdate from(auto& take) {
    constexpr int overhang = Footprint<D>::overhang;
    return {.x = take(requiresOld(p::x<D>)),
            .edges = take(requiresOld(p::edges<D>)),
            .velocity = take(requiresOld(p::velocity<D>)),
            .modes = take(requiresOld(p::modes<D>)),
            .internalEnergy = take(requiresOld(p::internalEnergy)),
            .affineEnergy = take(requiresOld(p::affineEnergy)),
            .nodeVelocity = take(requiresOld(g::velocity<D>, overhang)),
            .acceleration = take(requiresNew(g::acceleration<D>, overhang)),
            .relaxation = take(requiresNew(g::relaxation, overhang)),
            .work = take(requiresNew(c::work, overhang)),
            .newX = take(computes(p::x<D>)),
            .newEdges = take(computes(p::edges<D>)),
            .newVelocity = take(computes(p::velocity<D>)),
            .newModes = take(computes(p::modes<D>)),
            .newInternalEnergy = take(computes(p::internalEnergy)),
            .newAffineEnergy = take(computes(p::affineEnergy))};
  }
};

template <int D, class Scheme>
Motion<D> motionOn(const Patch& patch, const ParticleUpdate<D>& update, double dt) {
  Motion<D> motion(patch.cells());
  forEach<D>(update.nodeVelocity.box(), [&](const Index<D>& node) {
    for (std::size_t d = 0; d < D; ++d) {
      const double v = update.nodeVelocity[node][static_cast<int>(d)];
      const double dv = dt * update.acceleration[node][static_cast<int>(d)];
      motion.at(d, node) = v;
      motion.at(Motion<D>::accelerated + d, node) = v + dv;
      motion.at(Motion<D>::moving + d, node) = v + Scheme::faceTime * dv;
    }
    const double beta = Scheme::transfer == Transfer::apic ? 1.0 : update.relaxation[node];
    motion.at(Motion<D>::kept, node) = 1 - beta;
    motion.at(Motion<D>::slip, node) = 0.5 * beta * (2 - beta);
  });
  motion.copy(Motion<D>::work, update.work);
  return motion;
}

/// Reads the grid fields near a batch.
template <int D>
struct Reader {
  const Motion<D>& motion;
  Index<D> first;

  Lanes operator()(std::size_t field, const Index<D>& k) const { return motion.readRow(field, first + k); }
  LanesVec<D> vector(std::size_t field, const Index<D>& k) const {
    LanesVec<D> values;
    for (std::size_t d = 0; d < D; ++d) values[static_cast<int>(d)] = (*this)(field + d, k);
    return values;
  }
};

/// Adds the nodes of a line, one particle per lane.
template <int D, class Scheme>
[[gnu::always_inline]] inline void addNode(const Footprint<D>& footprint, const Index<D>& at, const Reader<D>& read,
                                           const LanesVec<D>& field, Gathered<D, Scheme, 0>& sum) {
  using Sum = Gathered<D, Scheme, 0>;
  const auto& span = footprint.along[0];
  const std::size_t k = at[0];
  const Lanes w = span.weight[k];
  const LanesVec<D> r = field - read.vector(0, at), moving = read.vector(Motion<D>::moving, at);
  const LanesVec<D> y = read.vector(Motion<D>::accelerated, at) + read(Motion<D>::kept, at) * r, wy = w * y;
  sum.moments[0] += wy;
  if constexpr (!Sum::apic) sum.moments[1] += span.arm[k] * wy;
  sum.lower[0] += span.atLower[k] * Sum::ofFace(0, moving);
  sum.upper[0] += span.atUpper[k] * Sum::ofFace(0, moving);
  sum.moving += w * moving;
  sum.slipEnergy += w * read(Motion<D>::slip, at) * r.squaredNorm();
  sum.square += wy.dot(y);
}

/// Adds a line to the sum over a plane, or a plane to the sum over the footprint.
template <int D, class Scheme, int Axis>
[[gnu::always_inline]] inline void addSlice(const Footprint<D>& footprint, std::size_t k,
                                            const Gathered<D, Scheme, Axis - 1>& slice,
                                            Gathered<D, Scheme, Axis>& sum) {
  using Sum = Gathered<D, Scheme, Axis>;
  constexpr std::size_t half = std::size_t{1} << Axis;
  const auto& span = footprint.along[Axis];
  const Lanes w = span.weight[k];
  for (std::size_t a = 0; a < slice.moments.size(); ++a) {
    sum.moments[a] += w * slice.moments[a];
    if constexpr (!Sum::apic) sum.moments[a + half] += w * span.arm[k] * slice.moments[a];
  }
  for (std::size_t d = 0; d < Axis; ++d) {
    sum.lower[d] += w * slice.lower[d];
    sum.upper[d] += w * slice.upper[d];
  }
  sum.lower[Axis] += span.atLower[k] * Sum::ofFace(Axis, slice.moving);
  sum.upper[Axis] += span.atUpper[k] * Sum::ofFace(Axis, slice.moving);
  sum.moving += w * slice.moving;
  sum.slipEnergy += w * slice.slipEnergy;
  sum.square += w * slice.square;
}

template <int D, class Scheme, int Axis>
[[gnu::always_inline]] inline Gathered<D, Scheme, Axis> gatherFromNodes(
    const Footprint<D>& footprint, Index<D>& at, const Reader<D>& read,
    const typename Footprint<D>::template Field<Axis>& field) {
  const auto& span = footprint.along[Axis];
  using Sum = Gathered<D, Scheme, Axis>;
  return span.template sumOverNodes<Sum>([&](int node, Sum& sum) __attribute__((always_inline)) {
    at[Axis] = node;
    const std::size_t k = node;
    if constexpr (Axis == 0)
      addNode<D, Scheme>(footprint, at, read, field[0] + span.arm[k] * field[1], sum);
    else
      addSlice<D, Scheme, Axis>(footprint, k,
                                gatherFromNodes<D, Scheme, Axis - 1>(
                                    footprint, at, read, Footprint<D>::template slice<Axis>(field, span.arm[k])),
                                sum);
  });
}

/// Computes the sum of o_c f_c over the cells of the footprint: the relative change of internal energy by work.
template <int D>
Lanes workOn(const Footprint<D>& footprint, const Reader<D>& read) {
  return footprint.sumOverParts([&](const Index<D>& k, const Lanes& part) { return part * read(Motion<D>::work, k); });
}

/// Requires a smaller time step if a box would shrink below 0.4 of its length or become longer than `most`.
template <int D>
void limitEdges(const Batch<D>& batch, const Lanes& before, const Lanes& after, double most, Minimum& factor) {
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
void limitCooling(const Batch<D>& batch, const Lanes& work, const Lanes& energy, Minimum& factor) {
  if (batch.holds((work > -0.8) & (energy >= 0))) return;
  for (int lane = 0; lane < Lanes::count; ++lane) {
    if (batch.used[lane] == 0) continue;
    if (!(work[lane] > -0.8)) factor.add(-0.7 / work[lane], "cooling");
    if (!(energy[lane] >= 0)) factor.add(0.5, "cooling");
  }
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
  constexpr bool apic = Scheme::transfer == Transfer::apic;
  const Motion<D> motion = motionOn<D, Scheme>(patch, update, dt);
  forEachBatch<D>(patch.cells(), update.x, [&](const Batch<D>& batch) {
    const Footprint<D> footprint(patch.level(), batch, load(update.x, batch), load(update.edges, batch));
    const LanesModes<D> u = load(update.modes, batch);
    const Reader<D> read{motion, footprint.first()};
    Index<D> at;
    const auto taken =
        gatherFromNodes<D, Scheme, D - 1>(footprint, at, read, fieldOf<D>(load(update.velocity, batch), u));
    const LanesVec<D> mean = taken.moments[0], inertia = footprint.inertia();
    const auto products = productsOver(inertia);
    LanesModes<D> fresh = LanesModes<D>::Zero();
    LanesVec<D> centre, size;
    for (std::size_t d = 0; d < D; ++d) {
      const auto& span = footprint.along[d];
      const int axis = static_cast<int>(d);
      const Lanes lower = span.lower + dt * taken.normal(axis, taken.lower[d]);
      const Lanes upper = span.upper + dt * taken.normal(axis, taken.upper[d]);
      centre[axis] = 0.5 * (lower + upper);
      size[axis] = upper - lower;
      limitEdges(batch, span.length(), size[axis], Footprint<D>::longest * patch.level().spacing(axis), factor);
      if constexpr (apic) fresh.col(gradientColumn(axis)) = (taken.upper[d] - taken.lower[d]) / span.length();
    }
    if constexpr (!apic)
      for (std::size_t a = 1; a < taken.moments.size(); ++a)
        fresh.col(static_cast<int>(a) - 1) = taken.moments[a] / products[a];
    const Lanes within = max(0.0, 0.5 * (taken.square - mean.squaredNorm()));
    const Lanes affine = apic ? within : min(within, modalEnergy<D>(fresh, inertia));
    store(centre, update.newX, batch);
    store(size, update.newEdges, batch);
    store(mean, update.newVelocity, batch);
    store(fresh, update.newModes, batch);
    store(affine, update.newAffineEnergy, batch);
    const Lanes done = workOn(footprint, read);
    const Lanes energy = load(update.internalEnergy, batch) * (1 + done) + load(update.affineEnergy, batch) -
                         modalEnergy<D>(u, inertia) + taken.slipEnergy + (within - affine);
    limitCooling(batch, done, energy, factor);
    store(energy, update.newInternalEnergy, batch);
  });
}

}  // namespace tushar::mpm::gas::conserving
