#pragma once

#include "components/mpm/conserving/footprint.hpp"
#include "components/mpm/conserving/labels.hpp"
#include "components/mpm/conserving/scheme.hpp"
#include "components/mpm/materials/gas.hpp"
#include "components/mpm/tasks/symmetry.hpp"

namespace tushar::mpm::conserving {

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
      const Vec<D> mean = m * velocity[p];
      const Modes<D> moment = m * modes[p];
      footprint.forEachNode(nodeMass.box(), [&](const Index<D>& node, double w, const auto& phi) {
        Vec<D> momentum = mean;
        for (int a = 1; a < (1 << D); ++a) momentum += phi[static_cast<std::size_t>(a)] * moment.col(a - 1);
        nodeMass[node] += w * m;
        nodeVelocity[node] += w * momentum;
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

/// What a particle takes from the nodes it touches, means over its box or its faces; (E1)-(E3) of updateParticles.
template <int D>
struct Gathered {
  std::array<Vec<D>, (1 << D)> moments;  ///< y phi_a
  Vec<D> lowerFace = Vec<D>::Zero(), upperFace = Vec<D>::Zero();  ///< normal velocity of the faces, m/s
  Tensor<D> jump = Tensor<D>::Zero();  ///< column d: y on the upper minus y on the lower face across axis d, m/s
  double slipEnergy = 0;               ///< beta (2 - beta) |r|² / 2, J/kg
  double square = 0;                   ///< |y|², J/kg

  Gathered() { moments.fill(Vec<D>::Zero()); }
};

/// Particles after a step, from node velocities v, accelerations a and relaxations beta, and the work f of cells.
///
/// With z = u(x_i), r = z - v_i, y = z - beta r + dt a_i (apic: beta = 1, so that y = v_i + dt a_i), and means over the
/// box, sum of w_i:
///   (E1) new modes  u_a = <y phi_a> / I_a;  apic: the gradient is the difference of <y> over opposite faces
///   (E2) new affine energy  K_A = 1/2 sum over a of I_a |u_a|²;  apic: (<|y|²> - |u_0|²) / 2
///   (E3) new e = e (1 + sum o_c f_c) + K_A,old - K_old + <beta (2 - beta) |r|²> / 2 + (<|y|²> - |u_0|²) / 2 - K_A
/// so that the kinetic energy that a transfer loses becomes heat. Each face moves with the mean of its normal velocity
/// v + dt a / 2 (apic: v + dt a).
template <int D, class Scheme>
void updateParticles(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> edges,
                     ParticleView<const Vec<D>> velocity, ParticleView<const Modes<D>> modes,
                     ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy,
                     NodeView<const Vec<D>> nodeVelocity, NodeView<const Vec<D>> acceleration,
                     NodeView<const double> relaxation, CellView<const double> work, double dt,
                     ParticleView<Vec<D>> newX, ParticleView<Vec<D>> newEdges, ParticleView<Vec<D>> newVelocity,
                     ParticleView<Modes<D>> newModes, ParticleView<double> newInternalEnergy,
                     ParticleView<double> newAffineEnergy) {
  constexpr bool apic = Scheme::transfer == Transfer::apic;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    for (const int p : x.in(cell)) {
      const Footprint<D> footprint(patch.level(), cell, x[p], edges[p]);
      const Vec<D> v0 = velocity[p];
      const Modes<D> u = modes[p];
      Gathered<D> taken;
      footprint.forEachNodeWithFaces([&](const Index<D>& node, const auto& w, const auto& phi) {
        const Vec<D> v = nodeVelocity[node], dv = dt * acceleration[node], moving = v + Scheme::faceTime * dv;
        Vec<D> r = v0 - v;
        for (int a = 1; a < (1 << D); ++a) r += phi[static_cast<std::size_t>(a)] * u.col(a - 1);
        const double beta = apic ? 1.0 : relaxation[node];
        const Vec<D> y = v + dv + (1 - beta) * r;
        taken.slipEnergy += w.mean * 0.5 * beta * (2 - beta) * r.squaredNorm();
        taken.square += w.mean * y.squaredNorm();
        for (std::size_t a = 0; a < (apic ? 1 : 1 << D); ++a) taken.moments[a] += w.mean * phi[a] * y;
        for (int d = 0; d < D; ++d) {
          const auto k = static_cast<std::size_t>(d);
          taken.lowerFace[d] += w.lower[k] * moving[d];
          taken.upperFace[d] += w.upper[k] * moving[d];
          if constexpr (apic) taken.jump.col(d) += (w.upper[k] - w.lower[k]) * y;
        }
      });
      double done = 0;
      footprint.forEachCell(work.box(), [&](const Index<D>& c, double part) { done += part * work[c]; });

      const Vec<D> mean = taken.moments[0], inertia = footprint.inertia();
      Modes<D> fresh = Modes<D>::Zero();
      for (int d = 0; d < D; ++d) {
        const auto& span = footprint.along[static_cast<std::size_t>(d)];
        const double lower = span.lower + dt * taken.lowerFace[d], upper = span.upper + dt * taken.upperFace[d];
        newX[p][d] = 0.5 * (lower + upper);
        newEdges[p][d] = upper - lower;
        if constexpr (apic) fresh.col(gradientColumn(d)) = taken.jump.col(d) / span.length();
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
    }
  });
}

}  // namespace tushar::mpm::conserving
