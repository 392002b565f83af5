#include "components/mpm/solid/tasks/heat.hpp"

#include "components/mpm/boundary_labels.hpp"
#include "core/grid/nodes_of_sides.hpp"

namespace tushar::mpm::solid {

template <int D>
void setTemperature(const Patch& patch, int material, NodeView<double> field) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      if (!grid::mayTouchSide(patch, d, side)) continue;
      const auto given = patch.level().boundary(d, side, boundary::temperature, material);
      if (!given) continue;
      const Index<D> inwards = side == 0 ? Index<D>::unit(d) : Index<D>{} - Index<D>::unit(d);
      const double value = given->value, drop = value * patch.level().spacing(d);
      const auto set = [&](const Box& nodes) {
        forEach<D>(nodes, [&](const Index<D>& node) {
          field[node] = given->isDirichlet() ? value : field[node + inwards] - drop;
        });
      };
      grid::forEachBoxOnSide(patch, d, side, set);
      grid::forEachBoxBeyond(patch, d, side, [&](const Box& nodes, int) { set(nodes); });
    }
}

template void setTemperature<1>(const Patch&, int, NodeView<double>);
template void setTemperature<2>(const Patch&, int, NodeView<double>);
template void setTemperature<3>(const Patch&, int, NodeView<double>);

}  // namespace tushar::mpm::solid
