#include "components/mpm/solid/explicit/tasks/friction.hpp"

#include "core/grid/nodes_of_sides.hpp"

namespace tushar::mpm::solid {

template <int D>
void mirrorSurface(const Patch& patch, const Material& material, NodeView<SurfaceRecord> surface) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (grid::mayTouchSide(patch, d, side) && patch.level().isSymmetry(d, side, material.index))
        grid::forEachBoxOnSide(patch, d, side, [&](const Box& nodes) {
          forEach<D>(nodes, [&](const Index<D>& node) {
            surface[node].numbers()[d] = 0;
            surface[node].numbers()[3] *= 2;
          });
        });
}

template void mirrorSurface<1>(const Patch&, const Material&, NodeView<SurfaceRecord>);
template void mirrorSurface<2>(const Patch&, const Material&, NodeView<SurfaceRecord>);
template void mirrorSurface<3>(const Patch&, const Material&, NodeView<SurfaceRecord>);

}  // namespace tushar::mpm::solid
