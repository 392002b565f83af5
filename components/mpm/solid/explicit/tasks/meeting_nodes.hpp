#pragma once

#include <vector>

#include "components/mpm/solid/contact/plane_friction.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/node_record.hpp"

namespace tushar::mpm::solid {

/// The nodes of a patch at which bodies meet, in their order.
template <int D>
struct MeetingNodes {
  Box box;
  std::vector<int> number;  ///< for each node of the box, its index among those that follow, or -1
  std::vector<Index<D>> node;
  std::vector<int> leader;  ///< the material that the plane belongs to
  std::vector<std::vector<SidedParticle<D>>> particles;

  MeetingNodes(const Box& nodes, const std::vector<Material>& materials, const std::vector<Contact>& contacts,
               const std::vector<NodeView<const NodeRecord>>& records);
  /// The index of a node, or -1.
  int operator[](const Index<D>& at) const { return box.contains(at) ? number[place(at)] : -1; }

 private:
  std::size_t place(const Index<D>& at) const {
    Index3 whole = box.lower;
    for (int d = 0; d < D; ++d) whole[d] = at[d];
    return box.offset(whole);
  }
};

/// The normal at the k-th of the nodes: 0 unless there are particles on both sides. None points through a symmetry
/// plane.
template <int D>
Vec<D> normalAt(const Patch& patch, const MeetingNodes<D>& nodes, std::size_t k);

}  // namespace tushar::mpm::solid
