#include "components/mpm/solid/explicit/tasks/meeting_nodes.hpp"

#include "core/grid/nodes_of_sides.hpp"

namespace tushar::mpm::solid {

template <int D>
MeetingNodes<D>::MeetingNodes(const Box& nodes, const std::vector<Material>& materials,
                              const std::vector<Contact>& contacts, const std::vector<std::size_t>& present,
                              const RowsOfNodes& rows, const std::vector<NodeView<const NodeRecord>>& records)
    : box(nodes), number(nodes.size(), -1) {
  const Precedence precedence(materials, contacts);
  const MeetingBodies<D> meeting(nodes, present, rows, records);
  meeting.forEachNode([&](const Index<D>& at, std::span<const std::size_t> bodies) {
    const int first = precedence.leader<D>(records, bodies, at);
    if (first < 0) return;
    number[place(at)] = static_cast<int>(node.size());
    node.push_back(at);
    leader.push_back(first);
  });
  particles.resize(node.size());
}

template <int D>
Vec<D> normalAt(const Patch& patch, const MeetingNodes<D>& nodes, std::size_t k) {
  const auto& around = nodes.particles[k];
  const auto others = std::count_if(around.begin(), around.end(), [](const auto& one) { return one.isOther; });
  if (others == 0 || others == static_cast<std::ptrdiff_t>(around.size())) return Vec<D>::Zero();
  Vec<D> normal = separatingNormal<D>(around, patch.level().cellWidth(0));
  const int material = nodes.leader[k];
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (grid::mayTouchSide(patch, d, side) && patch.level().isSymmetry(d, side, material) &&
          grid::isOnSide<D>(patch, d, side, nodes.node[k]))
        normal[d] = 0;
  const double length = normal.norm();
  return length > 0 ? Vec<D>(normal / length) : normal;
}

template struct MeetingNodes<1>;
template struct MeetingNodes<2>;
template struct MeetingNodes<3>;
template Vec<1> normalAt(const Patch&, const MeetingNodes<1>&, std::size_t);
template Vec<2> normalAt(const Patch&, const MeetingNodes<2>&, std::size_t);
template Vec<3> normalAt(const Patch&, const MeetingNodes<3>&, std::size_t);

}  // namespace tushar::mpm::solid
