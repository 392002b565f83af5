#include "components/mpm/solid/transfer/boundary.hpp"

#include "components/mpm/boundary_labels.hpp"
#include "core/grid/nodes_of_sides.hpp"

namespace tushar::mpm::solid {

template <int D>
void setSymmetry(const Patch& patch, int material, const data::TouchedRows& rows, NodeView<NodeRecord> record) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      if (!grid::mayTouchSide(patch, d, side) || !patch.level().isSymmetry(d, side, material)) continue;
      const auto at = [&](const Index3& node) -> NodeRecord& { return record.values()[record.stored().offset(node)]; };
      grid::forEachBoxOnSide(patch, d, side, [&](const Box& nodes) {
        rows.forEachRow(nodes.intersect(record.box()), [&](Index3 node, int end) {
          for (; node[0] < end; ++node[0]) at(node)[lane::velocity + d] = at(node)[lane::force + d] = 0;
        });
      });
      grid::forEachBoxBeyond(patch, d, side, [&](const Box& nodes, int face) {
        rows.forEachRow(nodes.intersect(record.box()), [&](Index3 node, int end) {
          for (; node[0] < end; ++node[0]) {
            Index3 image = node;
            image[d] = 2 * face - node[d];
            NodeRecord value = at(image);
            value[lane::velocity + d] = -value[lane::velocity + d];
            value[lane::force + d] = -value[lane::force + d];
            at(node) = value;
          }
        });
      });
    }
}

template <int D>
void setVelocity(const Patch& patch, int material, const data::TouchedRows& rows, NodeView<NodeRecord> record) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      if (!grid::mayTouchSide(patch, d, side)) continue;
      const auto given = patch.level().boundary(d, side, boundary::velocity, material);
      if (!given || !given->isDirichlet()) continue;
      const Vec<D> value = patch.level().reduce<D>(given->value);
      const auto set = [&](const Box& nodes) {
        rows.forEachRow(nodes, [&](const Index3& first, int end) {
          NodeRecord* node = record.values() + record.stored().offset(first);
          for (int k = first[0]; k < end; ++k, ++node) setLanes<D>(*node, lane::velocity, value);
        });
      };
      grid::forEachBoxOnSide(patch, d, side, set);
      grid::forEachBoxBeyond(patch, d, side, [&](const Box& nodes, int) { set(nodes); });
    }
}

template void setSymmetry<1>(const Patch&, int, const data::TouchedRows&, NodeView<NodeRecord>);
template void setSymmetry<2>(const Patch&, int, const data::TouchedRows&, NodeView<NodeRecord>);
template void setSymmetry<3>(const Patch&, int, const data::TouchedRows&, NodeView<NodeRecord>);
template void setVelocity<1>(const Patch&, int, const data::TouchedRows&, NodeView<NodeRecord>);
template void setVelocity<2>(const Patch&, int, const data::TouchedRows&, NodeView<NodeRecord>);
template void setVelocity<3>(const Patch&, int, const data::TouchedRows&, NodeView<NodeRecord>);

}  // namespace tushar::mpm::solid
