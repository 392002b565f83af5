#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/paper/shape_functions.hpp"

namespace tushar::mpm::gas::paper {

/// A vector field f at the nodes of one cell.
template <int D>
struct CellNodes {
  std::array<Vec<D>, Linear<D>::nodes> values;

  CellNodes(NodeView<const Vec<D>> field, const Index<D>& cell) {
    for (int k = 0; k < Linear<D>::nodes; ++k) values[k] = field[Linear<D>::node(cell, k)];
  }
  /// Interpolates to a particle: sum_i S_ip f_i
  Vec<D> at(const typename Linear<D>::Weights& s) const {
    Vec<D> sum = s[0] * values[0];
    for (std::size_t k = 1; k < s.size(); ++k) sum += s[k] * values[k];
    return sum;
  }
  /// The divergence of f at the centre of the cell: sum_i f_i . grad S_i.
  double divergence(const Level& level) const {
    double sum = 0;
    for (int k = 0; k < Linear<D>::nodes; ++k)
      for (int d = 0; d < D; ++d) sum += values[k][d] * Linear<D>::centreGradient(level, k, d);
    return sum;
  }
};

/// Views of the variables that updateParticles reads and writes.
template <int D>
struct ParticleUpdate {
  // Particles at t_n.
  ParticleView<const Vec<D>> x, velocity;
  std::optional<ParticleView<const double>> mass;  ///< masses, if particles keep their mass
  ParticleView<const double> density, internalEnergy, pressure;
  // The grid.
  NodeView<const Vec<D>> acceleration;  ///< a_i at t_n
  NodeView<const Vec<D>> velocityStar;  ///< v_i at t_n+1
  // Particles at t_n+1.
  ParticleView<Vec<D>> newX, newVelocity;
  ParticleView<double> newDensity, newInternalEnergy;
  ParticleView<double> divergence;  ///< dv/dx of (14)-(15)

  static ParticleUpdate from(auto& take, bool keepsMass) {
    return {.x = take(requiresOld(p::x<D>)),
            .velocity = take(requiresOld(p::velocity<D>)),
            .mass = take(when(keepsMass, requiresOld(p::mass))),
            .density = take(requiresOld(p::density)),
            .internalEnergy = take(requiresOld(p::internalEnergy)),
            .pressure = take(requiresOld(p::pressure)),
            .acceleration = take(requiresNew(g::acceleration<D>)),
            .velocityStar = take(requiresNew(g::velocityStar<D>)),
            .newX = take(computes(p::x<D>)),
            .newVelocity = take(computes(p::velocity<D>)),
            .newDensity = take(computes(p::density)),
            .newInternalEnergy = take(computes(p::internalEnergy)),
            .divergence = take(computes(p::velocityDivergence))};
  }
};

/// v_p += dt sum_i S_ip a_i                                      (12)
/// x_p += dt sum_i S_ip v_i,   v_i of t_n+1                      (13)
/// eps_p -= p_p / rho_p d dt                                     (14)
/// rho_p *= 1 - d dt                                             (15) of Tran, Kim & Berzins
///
/// S_ip, p_p and rho_p are those of t_n; d, dv/dx in the paper, is the divergence of v_i of t_n+1 in the middle of the
/// cell that holds the particle at t_n. Only the patch's own particles are updated.
template <int D>
void updateParticles(const Patch& patch, const Gas&, ParticleUpdate<D> u, double dt) {
  const CellPlaces<D> places(patch.level());
  forEach<D>(u.x.cells(), [&](const Index<D>& cell) {
    const data::ParticleRange particles = u.x.in(cell);
    if (particles.empty()) return;
    const ShapeFunctions<D> shape(places, cell);
    const CellNodes<D> a(u.acceleration, cell), v(u.velocityStar, cell);
    const double d = v.divergence(patch.level());
    for (const int p : particles) {
      const auto s = shape.at(u.x[p]);
      u.newVelocity[p] = u.velocity[p] + dt * a.at(s);
      u.newX[p] = u.x[p] + dt * v.at(s);
      u.divergence[p] = d;
    }
  });
  for (int p = 0; p < u.x.owned(); ++p) {
    u.newInternalEnergy[p] = u.internalEnergy[p] - u.pressure[p] / u.density[p] * u.divergence[p] * dt;
    u.newDensity[p] = u.density[p] * (1.0 - u.divergence[p] * dt);
  }
}

/// Updates particles that keep their mass by (12), (13) and (15), and their energy, instead of by (14), such that total
/// energy is conserved to round-off.
///
/// The work of the pressure of a cell, -P_c V_c div(v_half) dt with v_half = v* - a dt/2, goes to its particles in
/// proportion to p_p times their volume m_p / rho_p; the kinetic energy that (12) loses, dt²/2 (sum_i S_ip a_i² -
/// |sum_i S_ip a_i|²) per mass and never negative, becomes heat.
template <int D>
void updateParticlesConserving(const Patch& patch, const Gas&, ParticleUpdate<D> u, double dt) {
  const Level& level = patch.level();
  const ParticleView<const double> mass = *u.mass;
  const CellPlaces<D> places(level);
  forEach<D>(u.x.cells(), [&](const Index<D>& cell) {
    const data::ParticleRange particles = u.x.in(cell);
    if (particles.empty()) return;
    const auto volume =
        sumOverParticles<double>(particles, [&](int p, double& part) { part += mass[p] / u.density[p]; });
    const ShapeFunctions<D> shape(places, cell);
    const CellNodes<D> a(u.acceleration, cell), v(u.velocityStar, cell);
    const double d = v.divergence(level), halfway = d - 0.5 * dt * a.divergence(level);
    const double workShare = halfway * dt * level.cellVolume() / volume;
    for (const int p : particles) {
      const auto s = shape.at(u.x[p]);
      const Vec<D> ap = a.at(s);
      double squares = 0;
      for (std::size_t k = 0; k < s.size(); ++k) squares += s[k] * a.values[k].squaredNorm();
      u.newVelocity[p] = u.velocity[p] + dt * ap;
      u.newX[p] = u.x[p] + dt * v.at(s);
      u.newInternalEnergy[p] =
          u.internalEnergy[p] - u.pressure[p] / u.density[p] * workShare + 0.5 * dt * dt * (squares - ap.squaredNorm());
      u.newDensity[p] = u.density[p] * (1.0 - d * dt);
      u.divergence[p] = d;
    }
  });
}

}  // namespace tushar::mpm::gas::paper
