#pragma once

#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/mirrored.hpp"
#include "components/mpm/labels.hpp"

namespace tushar::mpm::gas::paper {

/// What particles of a cell bring to its nodes: mass [kg] and momentum [kg m/s].
template <class Shape>
struct NodeShares {
  std::array<double, Shape::nodes> mass{};
  std::array<Vec<Shape::dimension>, Shape::nodes> momentum;

  NodeShares() { momentum.fill(Vec<Shape::dimension>::Zero()); }
  NodeShares& operator+=(const NodeShares& other) {
    for (std::size_t k = 0; k < mass.size(); ++k) {
      mass[k] += other.mass[k];
      momentum[k] += other.momentum[k];
    }
    return *this;
  }
};

/// m_i = sum_p S_i(x_p) m_p,   v_i = sum_p S_i(x_p) m_p v_p / m_i      (6)-(8) of Tran, Kim & Berzins.
///
/// `mass` [kg] and `velocity` [m/s] come out complete on all nodes of the patch: ghost particles contribute. A node
/// that no particle touches has mass 0 and velocity 0.
template <class Shape, int D = Shape::dimension>
void interpolateParticlesToGrid(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x,
                                ParticleView<const double> particleMass, ParticleView<const Vec<D>> particleVelocity,
                                NodeView<double> mass, NodeView<Vec<D>> velocity) {
  mass.fill(0.0);
  velocity.fill(Vec<D>::Zero());
  forEach<D>(x.cells(), [&](const Index<D>& cell) {
    const CellMiddle<D> middle(patch.level(), cell);
    const auto brought = sumFromBothEnds<NodeShares<Shape>>(x.in(cell), [&](int p, NodeShares<Shape>& sum) {
      const auto s = middle.weights(x[p]);
      for (std::size_t k = 0; k < s.size(); ++k) {
        const double share = s[k] * particleMass[p];
        sum.mass[k] += share;
        sum.momentum[k] += share * particleVelocity[p];
      }
    });
    for (int k = 0; k < Shape::nodes; ++k) {
      const Index<D> node = Shape::node(cell, k);
      if (!mass.box().contains(node)) continue;
      mass[node] += brought.mass[static_cast<std::size_t>(k)];
      velocity[node] += brought.momentum[static_cast<std::size_t>(k)];
    }
  });
  forEach<D>(mass.box(), [&](const Index<D>& node) {
    if (mass[node] > 0) velocity[node] /= mass[node];
  });
}

/// m_i alone: what the mass projection of a state is, for those who look at it.
template <class Shape, int D = Shape::dimension>
void interpolateMassToGrid(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x,
                           ParticleView<const double> particleMass, NodeView<double> mass) {
  mass.fill(0.0);
  forEach<D>(x.cells(), [&](const Index<D>& cell) {
    const CellMiddle<D> middle(patch.level(), cell);
    std::array<double, Shape::nodes> m{};
    for (const int p : x.in(cell)) {
      const auto s = middle.weights(x[p]);
      for (std::size_t k = 0; k < s.size(); ++k) m[k] += s[k] * particleMass[p];
    }
    for (int k = 0; k < Shape::nodes; ++k)
      if (const Index<D> node = Shape::node(cell, k); mass.box().contains(node))
        mass[node] += m[static_cast<std::size_t>(k)];
  });
}

}  // namespace tushar::mpm::gas::paper
