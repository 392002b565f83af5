#pragma once

#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/mirrored.hpp"
#include "components/mpm/labels.hpp"

namespace tushar::mpm::gas::paper {

/// The values of a node variable at the nodes of a cell, and what a particle in the cell makes of them.
template <class Shape, int D = Shape::dimension>
struct CellNodes {
  std::array<Vec<D>, Shape::nodes> values;

  CellNodes(NodeView<const Vec<D>> field, const Index<D>& cell) {
    for (int k = 0; k < Shape::nodes; ++k) values[static_cast<std::size_t>(k)] = field[Shape::node(cell, k)];
  }
  /// sum_i S_i f_i
  Vec<D> at(const std::array<double, Shape::nodes>& s) const {
    Vec<D> sum = s[0] * values[0];
    for (std::size_t k = 1; k < s.size(); ++k) sum += s[k] * values[k];
    return sum;
  }
  /// Divergence in the middle of the cell.
  double divergence(const Level& level) const {
    double sum = 0;
    for (int k = 0; k < Shape::nodes; ++k)
      for (int d = 0; d < D; ++d) sum += values[static_cast<std::size_t>(k)][d] * Shape::centreGradient(level, k, d);
    return sum;
  }
};

/// v_p += dt sum_i S_i a_i,   x_p += dt sum_i S_i v*_i                                  (12)-(13)
/// eps_p -= (p_p / rho_p) d dt,   rho_p *= 1 - d dt,   d = div v* in the particle's cell   (14)-(15)
/// of Tran, Kim & Berzins, with S at the old position and p, rho of the old state. Only the patch's own particles.
template <class Shape, int D = Shape::dimension>
void updateParticles(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> velocity,
                     ParticleView<const double> density, ParticleView<const double> internalEnergy,
                     ParticleView<const double> pressure, NodeView<const Vec<D>> acceleration,
                     NodeView<const Vec<D>> velocityStar, double dt, ParticleView<Vec<D>> newX,
                     ParticleView<Vec<D>> newVelocity, ParticleView<double> newDensity,
                     ParticleView<double> newInternalEnergy, ParticleView<double> divergence) {
  forEach<D>(x.cells(), [&](const Index<D>& cell) {
    const data::ParticleRange particles = x.in(cell);
    if (particles.empty()) return;
    const CellMiddle<D> middle(patch.level(), cell);
    const CellNodes<Shape> a(acceleration, cell), v(velocityStar, cell);
    const double d = v.divergence(patch.level());
    for (const int p : particles) {
      const auto s = middle.weights(x[p]);
      newVelocity[p] = velocity[p] + dt * a.at(s);
      newX[p] = x[p] + dt * v.at(s);
      divergence[p] = d;
    }
  });
  for (int p = 0; p < x.owned(); ++p) {
    newInternalEnergy[p] = internalEnergy[p] - pressure[p] / density[p] * divergence[p] * dt;
    newDensity[p] = density[p] * (1.0 - divergence[p] * dt);
  }
}

/// The same with total energy conserved to round-off, for particles of constant mass.
///
/// The work of the pressure of a cell, -P_c V_c div(v½) dt with v½ = v* - a dt/2, goes to its particles in proportion
/// to p_p times their volume m_p / rho_p; the kinetic energy that (12) loses, dt²/2 (sum_i S_i a_i² - |sum_i S_i a_i|²)
/// per mass and never negative, becomes heat. Density follows (15).
template <class Shape, int D = Shape::dimension>
void updateParticlesConserving(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x,
                               ParticleView<const Vec<D>> velocity, ParticleView<const double> mass,
                               ParticleView<const double> density, ParticleView<const double> internalEnergy,
                               ParticleView<const double> pressure, NodeView<const Vec<D>> acceleration,
                               NodeView<const Vec<D>> velocityStar, double dt, ParticleView<Vec<D>> newX,
                               ParticleView<Vec<D>> newVelocity, ParticleView<double> newDensity,
                               ParticleView<double> newInternalEnergy, ParticleView<double> divergence) {
  const Level& level = patch.level();
  forEach<D>(x.cells(), [&](const Index<D>& cell) {
    const data::ParticleRange particles = x.in(cell);
    if (particles.empty()) return;
    const auto volume = sumFromBothEnds<double>(particles, [&](int p, double& part) { part += mass[p] / density[p]; });
    const CellMiddle<D> middle(level, cell);
    const CellNodes<Shape> a(acceleration, cell), v(velocityStar, cell);
    const double d = v.divergence(level), halfway = d - 0.5 * dt * a.divergence(level);
    const double workShare = halfway * dt * level.cellVolume() / volume;
    for (const int p : particles) {
      const auto s = middle.weights(x[p]);
      const Vec<D> ap = a.at(s);
      double squares = 0;
      for (std::size_t k = 0; k < s.size(); ++k) squares += s[k] * a.values[k].squaredNorm();
      newVelocity[p] = velocity[p] + dt * ap;
      newX[p] = x[p] + dt * v.at(s);
      newInternalEnergy[p] =
          internalEnergy[p] - pressure[p] / density[p] * workShare + 0.5 * dt * dt * (squares - ap.squaredNorm());
      newDensity[p] = density[p] * (1.0 - d * dt);
      divergence[p] = d;
    }
  });
}

}  // namespace tushar::mpm::gas::paper
