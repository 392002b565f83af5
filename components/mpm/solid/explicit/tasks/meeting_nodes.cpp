#include "components/mpm/solid/explicit/tasks/meeting_nodes.hpp"

namespace tushar::mpm::solid {

namespace {

/// The materials to which a plane may belong, and the preferred one.
struct Precedence {
  std::vector<bool> mayLead, isRigid;

  Precedence(const std::vector<Material>& materials, const std::vector<Contact>& contacts) {
    for (const Material& material : materials) {
      mayLead.push_back(material.mayLeadContact);
      isRigid.push_back(material.isRigid);
    }
    for (const Contact& contact : contacts) {
      const std::size_t master = contact.master;
      if (contact.type == Contact::Type::specified) mayLead[master] = false;
      if (contact.type == Contact::Type::specifiedFriction) isRigid[master] = true;
    }
  }

  /// The material with the most mass of those that meet at a node, or the rigid one; -1 if fewer than two meet.
  template <int D>
  int leader(const std::vector<NodeView<const NodeRecord>>& records, const Index<D>& node) const {
    double total = 0, most = 0, mostOfRigid = 1e-90;
    for (const auto& record : records) total += record[node][lane::mass];
    int meeting = 0, heaviest = -1, rigid = -1;
    for (std::size_t m = 0; m < records.size(); ++m) {
      const double mass = records[m][node][lane::mass];
      if (!mayLead[m]) continue;
      if (isRigid[m] && mass > mostOfRigid) {
        mostOfRigid = mass;
        rigid = static_cast<int>(m);
      }
      if (mass <= 1e-8 * total || mass <= 1e-16) continue;
      ++meeting;
      if (mass <= most) continue;
      most = mass;
      heaviest = static_cast<int>(m);
    }
    if (meeting < 2) return -1;
    return rigid >= 0 ? rigid : heaviest;
  }
};

}  // namespace

template <int D>
MeetingNodes<D>::MeetingNodes(const Box& nodes, const std::vector<Material>& materials,
                              const std::vector<Contact>& contacts,
                              const std::vector<NodeView<const NodeRecord>>& records)
    : box(nodes), number(nodes.size(), -1) {
  const Precedence precedence(materials, contacts);
  forEach<D>(box, [&](const Index<D>& at) {
    const int first = precedence.leader<D>(records, at);
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
      if (patch.isAtBoundary(d, side) && patch.level().isSymmetry(d, side, material) &&
          patch.faceNodes(d, side).template contains<D>(nodes.node[k]))
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
