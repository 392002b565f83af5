#include "components/mpm/solid/explicit/tasks/friction.hpp"

namespace tushar::mpm::solid {

template <int D>
void mirrorSurface(const Patch& patch, const Material& material, NodeView<Vec<D>> massGradient,
                   NodeView<double> volume) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (patch.isAtBoundary(d, side) && patch.level().isSymmetry(d, side, material.index))
        forEach<D>(patch.faceNodes(d, side), [&](const Index<D>& node) {
          massGradient[node][d] = 0;
          volume[node] *= 2;
        });
}

template void mirrorSurface(const Patch&, const Material&, NodeView<Vec<1>>, NodeView<double>);
template void mirrorSurface(const Patch&, const Material&, NodeView<Vec<2>>, NodeView<double>);
template void mirrorSurface(const Patch&, const Material&, NodeView<Vec<3>>, NodeView<double>);

}  // namespace tushar::mpm::solid
