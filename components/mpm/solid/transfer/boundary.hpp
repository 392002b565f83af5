#pragma once

#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// On the nodes of the view's box, ensures that nothing moves through a symmetry plane and that no force acts normal to
/// it: on the plane, both vectors of a record have no normal component, and the nodes outside mirror those inside.
template <int D>
void setSymmetry(const Patch& patch, int material, const data::TouchedRows& rows, NodeView<NodeRecord> record);

/// Sets a given velocity on a face, and on the nodes beyond it that are near particles.
template <int D>
void setVelocity(const Patch& patch, int material, const data::TouchedRows& rows, NodeView<NodeRecord> record);

}  // namespace tushar::mpm::solid
