#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/node_record.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// Adds the force [N] of a body's surroundings to the force in the records of the body's nodes. Nodes away from its
/// particles have no mass, so that no force acts there.
template <int D>
void addSurroundingForce(const Patch&, const Material&, int ghostNodes, ParticleView<const Vec<D>> x,
                         NodeView<const Vec<D>> force, NodeView<NodeRecord> record) {
  forEachTouchedNode<D>(x, ghostNodes, record.box(), [&](const Index<D>& node) {
    NodeRecord& at = record[node];
    for (int d = 0; d < D; ++d) at[lane::force + d] += force[node][d];
  });
}

/// Copies the old T_p to the new one, which the surroundings of the body then change.
inline void keepTemperature(const Patch&, const Material&, ParticleView<const double> old,
                            ParticleView<double> temperature) {
  std::copy_n(old.values(), old.owned(), temperature.values());
}

}  // namespace tushar::mpm::solid
