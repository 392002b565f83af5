#pragma once

#include <vector>

#include "components/mpm/solid/contact/friction.hpp"
#include "components/mpm/solid/contact/meeting_bodies.hpp"
#include "components/mpm/solid/contact/plane_friction.hpp"
#include "components/mpm/solid/contact/present.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/node_record.hpp"

namespace tushar::mpm::solid {

/// Which materials a plane may belong to, and which one is preferred.
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

  /// The index of the material with the most mass of those that meet at a node, the first one if others have as much,
  /// or of the rigid one; -1 if fewer than two meet. `present` are the indices of the materials that have mass there.
  template <int D>
  int leader(const std::vector<NodeView<const NodeRecord>>& records, std::span<const std::size_t> present,
             const Index<D>& node) const {
    double total = 0, most = 0, mostOfRigid = 1e-90;
    for (const std::size_t m : present) total += records[m][node][lane::mass];
    int meeting = 0, heaviest = -1, rigid = -1;
    for (const std::size_t m : present) {
      const double mass = records[m][node][lane::mass];
      if (!mayLead[m]) continue;
      if (isRigid[m] && mass > mostOfRigid) {
        mostOfRigid = mass;
        rigid = static_cast<int>(m);
      }
      if (mass <= 1e-8 * total || mass <= 1e-16) continue;
      ++meeting;
      if (mass <= (1 + tieTolerance) * most) continue;
      most = mass;
      heaviest = static_cast<int>(m);
    }
    if (meeting < 2) return -1;
    return rigid >= 0 ? rigid : heaviest;
  }
};

/// The nodes of a patch at which bodies meet, in lexicographic order.
template <int D>
struct MeetingNodes {
  Box box;
  std::vector<int> number;  ///< for each node of the box, its index in the lists below, or -1
  std::vector<Index<D>> node;
  std::vector<int> leader;  ///< index of the material to which the plane belongs
  std::vector<std::vector<SidedParticle<D>>> particles;

  /// `present` are the indices of the materials that have records.
  MeetingNodes(const Box& nodes, const std::vector<Material>& materials, const std::vector<Contact>& contacts,
               const std::vector<std::size_t>& present, const RowsOfNodes& rows,
               const std::vector<NodeView<const NodeRecord>>& records);
  /// The index of a node in the lists; -1 if no bodies meet there.
  int operator[](const Index<D>& at) const { return box.contains(at) ? number[place(at)] : -1; }

 private:
  std::size_t place(const Index<D>& at) const {
    Index3 whole = box.lower;
    for (int d = 0; d < D; ++d) whole[d] = at[d];
    return box.offset(whole);
  }
};

/// The normal at the k-th of these nodes: 0 unless there are particles on both sides. It never points through a
/// symmetry plane.
template <int D>
Vec<D> normalAt(const Patch& patch, const MeetingNodes<D>& nodes, std::size_t k);

}  // namespace tushar::mpm::solid
