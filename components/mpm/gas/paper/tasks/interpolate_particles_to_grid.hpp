#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/paper/shape_functions.hpp"

namespace tushar::mpm::gas::paper {

/// Adds the contributions of one cell's particles to its nodes: mass of (6) [kg] and momentum of (7) [kg m/s].
template <int D>
struct NodalSums {
  std::array<double, Linear<D>::nodes> mass{};
  std::array<Vec<D>, Linear<D>::nodes> momentum;

  NodalSums() { momentum.fill(Vec<D>::Zero()); }
  NodalSums& operator+=(const NodalSums& other) {
    for (std::size_t k = 0; k < mass.size(); ++k) {
      mass[k] += other.mass[k];
      momentum[k] += other.momentum[k];
    }
    return *this;
  }
};

/// m_i = sum_p S_ip m_p                 (6)
/// P_i = sum_p S_ip m_p v_p             (7)
/// v_i = P_i / m_i                      (8) of Tran, Kim & Berzins, with m_p = rho_p V_p
///
/// `mass` [kg] and `velocity` [m/s] are complete on all nodes of the patch: ghost particles contribute. A node that no
/// particle touches has mass 0 and velocity 0.
template <int D>
void interpolateParticlesToGrid(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x,
                                ParticleView<const double> particleMass, ParticleView<const Vec<D>> particleVelocity,
                                NodeView<double> mass, NodeView<Vec<D>> velocity) {
  mass.fill(0.0);
  velocity.fill(Vec<D>::Zero());  // P_i, until it is divided by m_i
  const CellPlaces<D> places(patch.level());
  forEach<D>(x.cells(), [&](const Index<D>& cell) {
    if (x.in(cell).empty()) return;
    const ShapeFunctions<D> shape(places, cell);
    const auto sums = sumOverParticles<NodalSums<D>>(x.in(cell), [&](int p, NodalSums<D>& sum) {
      const auto s = shape.at(x[p]);
      for (std::size_t k = 0; k < s.size(); ++k) {
        const double m = s[k] * particleMass[p];
        sum.mass[k] += m;
        sum.momentum[k] += m * particleVelocity[p];
      }
    });
    for (int k = 0; k < Linear<D>::nodes; ++k) {
      const Index<D> node = Linear<D>::node(cell, k);
      if (!mass.box().contains(node)) continue;
      mass[node] += sums.mass[k];
      velocity[node] += sums.momentum[k];
    }
  });
  forEach<D>(mass.box(), [&](const Index<D>& node) {
    if (mass[node] > 0) velocity[node] /= mass[node];
  });
}

/// Computes only m_i = sum_p S_ip m_p: the projected mass of a state, which diagnostics compare with exact densities.
template <int D>
void interpolateMassToGrid(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x,
                           ParticleView<const double> particleMass, NodeView<double> mass) {
  mass.fill(0.0);
  const CellPlaces<D> places(patch.level());
  forEach<D>(x.cells(), [&](const Index<D>& cell) {
    const ShapeFunctions<D> shape(places, cell);
    typename Linear<D>::Weights sums{};
    for (const int p : x.in(cell)) {
      const auto s = shape.at(x[p]);
      for (std::size_t k = 0; k < s.size(); ++k) sums[k] += s[k] * particleMass[p];
    }
    for (int k = 0; k < Linear<D>::nodes; ++k)
      if (const Index<D> node = Linear<D>::node(cell, k); mass.box().contains(node)) mass[node] += sums[k];
  });
}

}  // namespace tushar::mpm::gas::paper
