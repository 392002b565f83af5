#pragma once

#include "components/mpm/conserving/footprint.hpp"
#include "components/mpm/conserving/labels.hpp"
#include "components/mpm/conserving/scheme.hpp"
#include "components/mpm/materials/gas.hpp"
#include "components/mpm/tasks/symmetry.hpp"

namespace tushar::mpm::conserving {

/// The velocity of a particle as a field about its centre.
template <int D>
typename Footprint<D>::template Field<D - 1> fieldOf(const Vec<D>& velocity, const Modes<D>& modes) {
  typename Footprint<D>::template Field<D - 1> field;
  field[0] = velocity;
  for (std::size_t a = 1; a < field.size(); ++a) field[a] = modes.col(static_cast<int>(a) - 1);
  return field;
}

/// m_i = sum w m,   v_i = sum w m u(x_i) / m_i on the patch's nodes,   M_c = sum o m,   IE_c = sum o m e in its cells;
/// w and o as in Footprint, u the velocity of the particle's modes. Symmetry planes: no normal velocity.
/// `visitPart(cell, volume)` is told of each part of a box that lies in a cell of the patch.
template <int D, class Visit>
void gatherOnGrid(const Patch& patch, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> edges,
                  ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
                  ParticleView<const Modes<D>> modes, ParticleView<const double> internalEnergy,
                  NodeView<double> nodeMass, NodeView<Vec<D>> nodeVelocity, CellView<double> cellMass,
                  CellView<double> cellInternalEnergy, Visit&& visitPart) {
  const Level& level = patch.level();
  nodeMass.fill(0);
  nodeVelocity.fill(Vec<D>::Zero());
  cellMass.fill(0);
  cellInternalEnergy.fill(0);
  forEach<D>(x.cells(), [&](const Index<D>& cell) {
    for (const int p : x.in(cell)) {
      const Footprint<D> footprint(level, cell, x[p], edges[p]);
      const double m = mass[p], energy = m * internalEnergy[p], volume = edges[p].prod();
      footprint.forEachCell(cellMass.box(), [&](const Index<D>& c, double part) {
        cellMass[c] += part * m;
        cellInternalEnergy[c] += part * energy;
        visitPart(c, part * volume);
      });
      footprint.forEachNode(nodeMass.box(), fieldOf<D>(velocity[p], modes[p]),
                            [&](const Index<D>& node, double w, const Vec<D>& u) {
                              nodeMass[node] += w * m;
                              nodeVelocity[node] += w * m * u;
                            });
    }
  });
  forEach<D>(nodeMass.box(), [&](const Index<D>& node) {
    if (nodeMass[node] > 0) nodeVelocity[node] /= nodeMass[node];
  });
  stopAtSymmetryPlanes<D>(patch, nodeVelocity);
}

/// gatherOnGrid alone.
template <int D>
void interpolateParticlesToGrid(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x,
                                ParticleView<const Vec<D>> edges, ParticleView<const double> mass,
                                ParticleView<const Vec<D>> velocity, ParticleView<const Modes<D>> modes,
                                ParticleView<const double> internalEnergy, NodeView<double> nodeMass,
                                NodeView<Vec<D>> nodeVelocity, CellView<double> cellMass,
                                CellView<double> cellInternalEnergy) {
  gatherOnGrid<D>(patch, x, edges, mass, velocity, modes, internalEnergy, nodeMass, nodeVelocity, cellMass,
                  cellInternalEnergy, [](const Index<D>&, double) {});
}

/// gatherOnGrid, and the volume of the boxes in each cell over the cell's own: 1 where they tile the gas.
template <int D>
void interpolateAndMeasureFill(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x,
                               ParticleView<const Vec<D>> edges, ParticleView<const double> mass,
                               ParticleView<const Vec<D>> velocity, ParticleView<const Modes<D>> modes,
                               ParticleView<const double> internalEnergy, NodeView<double> nodeMass,
                               NodeView<Vec<D>> nodeVelocity, CellView<double> cellMass,
                               CellView<double> cellInternalEnergy, CellView<double> fill, Maximum& greatest) {
  double inverse = 1;
  for (int d = 0; d < D; ++d) inverse *= patch.level().inverseSpacing(d);
  fill.fill(0);
  gatherOnGrid<D>(patch, x, edges, mass, velocity, modes, internalEnergy, nodeMass, nodeVelocity, cellMass,
                  cellInternalEnergy, [&](const Index<D>& cell, double volume) { fill[cell] += volume * inverse; });
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { greatest.add(fill[cell]); });
}

/// What a particle takes from the nodes on a line (Axis = 0), a plane, or all of its footprint (Axis = D - 1): sums
/// with the weights along these axes; (E1)-(E3) of updateParticles.
template <int D, int Axis>
struct Gathered {
  std::array<Vec<D>, (1 << (Axis + 1))> moments;  ///< y phi_a
  std::array<Vec<D>, Axis + 1> lower, upper;      ///< velocity with which the faces across each axis move, m/s
  Vec<D> moving = Vec<D>::Zero();                 ///< the same velocity over all of it
  double slipEnergy = 0;                          ///< beta (2 - beta) |r|² / 2, J/kg
  double square = 0;                              ///< |y|², J/kg

  Gathered() {
    moments.fill(Vec<D>::Zero());
    lower.fill(Vec<D>::Zero());
    upper.fill(Vec<D>::Zero());
  }
};

/// The node fields that particles are updated from.
template <int D>
struct NodeMotion {
  NodeView<const Vec<D>> velocity, acceleration;
  NodeView<const double> relaxation;
  double dt;
};

/// Adds a node of a line.
template <int D, class Scheme>
[[gnu::always_inline]] inline void addNode(const Footprint<D>& footprint, std::size_t k, const Index<D>& node, const NodeMotion<D>& motion,
             const Vec<D>& field, Gathered<D, 0>& sum) {
  const auto& span = footprint.along[0];
  const double w = span.weight[k];
  const Vec<D> v = motion.velocity[node], dv = motion.dt * motion.acceleration[node], r = field - v;
  const Vec<D> moving = v + Scheme::faceTime * dv;
  const double beta = Scheme::transfer == Transfer::apic ? 1.0 : motion.relaxation[node];
  const Vec<D> y = v + dv + (1 - beta) * r, wy = w * y;
  sum.moments[0] += wy;
  sum.moments[1] += span.arm[k] * wy;
  sum.lower[0] += span.atLower[k] * moving;
  sum.upper[0] += span.atUpper[k] * moving;
  sum.moving += w * moving;
  sum.slipEnergy += w * (0.5 * beta * (2 - beta)) * r.squaredNorm();
  sum.square += wy.dot(y);
}

/// Adds a line to a plane, or a plane to the footprint.
template <int D, int Axis>
[[gnu::always_inline]] inline void addSlice(const Footprint<D>& footprint, std::size_t k, const Gathered<D, Axis - 1>& slice,
              Gathered<D, Axis>& sum) {
  constexpr std::size_t half = std::size_t{1} << Axis;
  const auto& span = footprint.along[Axis];
  const double w = span.weight[k];
  for (std::size_t a = 0; a < half; ++a) {
    sum.moments[a] += w * slice.moments[a];
    sum.moments[a + half] += w * span.arm[k] * slice.moments[a];
  }
  for (std::size_t d = 0; d < Axis; ++d) {
    sum.lower[d] += w * slice.lower[d];
    sum.upper[d] += w * slice.upper[d];
  }
  sum.lower[Axis] += span.atLower[k] * slice.moving;
  sum.upper[Axis] += span.atUpper[k] * slice.moving;
  sum.moving += w * slice.moving;
  sum.slipEnergy += w * slice.slipEnergy;
  sum.square += w * slice.square;
}

template <int D, class Scheme, int Axis>
[[gnu::always_inline]] inline Gathered<D, Axis> gatherFromNodes(const Footprint<D>& footprint, Index<D> node, const NodeMotion<D>& motion,
                                  const typename Footprint<D>::template Field<Axis>& field) {
  Gathered<D, Axis> sum;
  const auto& span = footprint.along[Axis];
  for (int k = 0; k < span.nodes(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    node[Axis] = span.first + k;
    if constexpr (Axis == 0)
      addNode<D, Scheme>(footprint, at, node, motion, field[0] + span.arm[at] * field[1], sum);
    else
      addSlice<D, Axis>(footprint, at,
                        gatherFromNodes<D, Scheme, Axis - 1>(footprint, node, motion,
                                                             Footprint<D>::template slice<Axis>(field, span.arm[at])),
                        sum);
  }
  return sum;
}

/// Asks for a smaller time step where a box would shrink to less than .4 of its length or become longer than `most`.
inline void limitEdge(double before, double after, double most, Minimum& factor) {
  if (!(after > 0.4 * before)) factor.add(0.5 * before / (before - after), "compression");
  if (!(after < most)) factor.add(0.9 * (most - before) / (after - before), "stretch");
}

/// Asks for a smaller time step where work would take more than .8 of the internal energy, or the new one be negative.
inline void limitCooling(double work, double energy, Minimum& factor) {
  if (!(work > -0.8)) factor.add(-0.7 / work, "cooling");
  if (!(energy >= 0)) factor.add(0.5, "cooling");
}

/// Particles after a step, from node velocities v, accelerations a and relaxations beta, and the work f of cells.
///
/// With z = u(x_i), r = z - v_i, y = z - beta r + dt a_i (apic: beta = 1, so that y = v_i + dt a_i), and means over the
/// box, sum of w_i:
///   (E1) new modes  u_a = <y phi_a> / I_a;  apic: the gradient is the difference of <y> over opposite faces
///   (E2) new affine energy  K_A = 1/2 sum over a of I_a |u_a|²;  apic: (<|y|²> - |u_0|²) / 2
///   (E3) new e = e (1 + sum o_c f_c) + K_A,old - K_old + <beta (2 - beta) |r|²> / 2 + (<|y|²> - |u_0|²) / 2 - K_A
/// so that the kinetic energy that a transfer loses becomes heat. Each face moves with the mean of its normal velocity
/// v + dt a / 2 (apic: v + dt a). A step that limitEdge or limitCooling refuse is to be repeated with `factor` times dt.
template <int D, class Scheme>
void updateParticles(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> edges,
                     ParticleView<const Vec<D>> velocity, ParticleView<const Modes<D>> modes,
                     ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy,
                     NodeView<const Vec<D>> nodeVelocity, NodeView<const Vec<D>> acceleration,
                     NodeView<const double> relaxation, CellView<const double> work, double dt,
                     ParticleView<Vec<D>> newX, ParticleView<Vec<D>> newEdges, ParticleView<Vec<D>> newVelocity,
                     ParticleView<Modes<D>> newModes, ParticleView<double> newInternalEnergy,
                     ParticleView<double> newAffineEnergy, Minimum& factor) {
  constexpr bool apic = Scheme::transfer == Transfer::apic;
  const NodeMotion<D> motion{nodeVelocity, acceleration, relaxation, dt};
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    for (const int p : x.in(cell)) {
      const Footprint<D> footprint(patch.level(), cell, x[p], edges[p]);
      const Modes<D> u = modes[p];
      const auto taken = gatherFromNodes<D, Scheme, D - 1>(footprint, cell, motion, fieldOf<D>(velocity[p], u));
      double done = 0;
      footprint.forEachCell(work.box(), [&](const Index<D>& c, double part) { done += part * work[c]; });

      const Vec<D> mean = taken.moments[0], inertia = footprint.inertia();
      Modes<D> fresh = Modes<D>::Zero();
      for (std::size_t d = 0; d < D; ++d) {
        const auto& span = footprint.along[d];
        const int axis = static_cast<int>(d);
        const double lower = span.lower + dt * taken.lower[d][axis], upper = span.upper + dt * taken.upper[d][axis];
        newX[p][axis] = 0.5 * (lower + upper);
        newEdges[p][axis] = upper - lower;
        limitEdge(span.length(), upper - lower, Footprint<D>::longest * patch.level().spacing(axis), factor);
        if constexpr (apic) fresh.col(gradientColumn(axis)) = (taken.upper[d] - taken.lower[d]) / span.length();
      }
      if constexpr (!apic)
        for (int a = 1; a < (1 << D); ++a)
          fresh.col(a - 1) = taken.moments[static_cast<std::size_t>(a)] / productOver(a, inertia);
      const double within = std::max(0.0, 0.5 * (taken.square - mean.squaredNorm()));
      const double affine = apic ? within : std::min(within, modalEnergy<D>(fresh, inertia));
      newVelocity[p] = mean;
      newModes[p] = fresh;
      newAffineEnergy[p] = affine;
      newInternalEnergy[p] = internalEnergy[p] * (1 + done) + affineEnergy[p] - modalEnergy<D>(u, inertia) +
                             taken.slipEnergy + (within - affine);
      limitCooling(done, newInternalEnergy[p], factor);
    }
  });
}

}  // namespace tushar::mpm::conserving
