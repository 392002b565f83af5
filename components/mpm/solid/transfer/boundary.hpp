#pragma once

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// Ensures that nothing moves through a symmetry plane, and that no force acts across it, on the nodes of the view's
/// box: both vectors of a record have no normal component there, and the nodes outside mirror those inside.
template <int D>
void setSymmetry(const Patch& patch, int material, const data::TouchedRows& rows, NodeView<NodeRecord> record) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      if (!patch.isAtBoundary(d, side) || !patch.level().isSymmetry(d, side, material)) continue;
      const int face = side == 0 ? patch.cells().lower[d] : patch.cells().upper[d];
      const auto at = [&](const Index3& node) -> NodeRecord& { return record.values()[record.stored().offset(node)]; };
      rows.forEachRow(patch.faceNodes(d, side).intersect(record.box()), [&](Index3 node, int end) {
        for (; node[0] < end; ++node[0]) at(node)[lane::velocity + d] = at(node)[lane::force + d] = 0;
      });
      rows.forEachRow(patch.nodesBeyond(d, side).intersect(record.box()), [&](Index3 node, int end) {
        for (; node[0] < end; ++node[0]) {
          Index3 image = node;
          image[d] = 2 * face - node[d];
          NodeRecord value = at(image);
          value[lane::velocity + d] = -value[lane::velocity + d];
          value[lane::force + d] = -value[lane::force + d];
          at(node) = value;
        }
      });
    }
}

/// Sets a given velocity on a face, and on the nodes beyond it that are near particles.
template <int D>
void setVelocity(const Patch& patch, int material, const data::TouchedRows& rows, NodeView<NodeRecord> record) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      if (!patch.isAtBoundary(d, side)) continue;
      const auto given = patch.level().boundary(d, side, boundary::velocity, material);
      if (!given || !given->isDirichlet()) continue;
      const Vec<D> value = patch.level().reduce<D>(given->value);
      for (const Box& nodes : {patch.faceNodes(d, side), patch.nodesBeyond(d, side)})
        rows.forEachRow(nodes, [&](const Index3& first, int end) {
          NodeRecord* node = record.values() + record.stored().offset(first);
          for (int k = first[0]; k < end; ++k, ++node) setLanes<D>(*node, lane::velocity, value);
        });
    }
}

}  // namespace tushar::mpm::solid
