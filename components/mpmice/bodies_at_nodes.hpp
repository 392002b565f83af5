#pragma once

#include "components/mpm/solid/transfer/node_record.hpp"
#include "components/mpmice/labels.hpp"

namespace tushar::mpmice {

/// Velocities and masses of all solids at nodes, for use at faces. A face distributes forces over the nodes of the
/// cells on both sides of it, in proportion to the masses at these nodes. Velocity, force and work have the same
/// weights, so the losses of the gas equal the gains of the nodes.
template <int D>
class BodiesAtNodes {
 public:
  using Records = std::vector<NodeView<const mpm::solid::NodeRecord>>;

  BodiesAtNodes(const Level& level, const Records& records) : level_(&level), records_(&records) {}

  /// The nodes on the grid that belong to the cells on both sides of a cell's lower face along an axis.
  Box nodesAt(const Index<D>& cell, int axis) const {
    Box nodes{{}, Index3::filled(1)};
    for (int d = 0; d < D; ++d) {
      nodes.lower[d] = d == axis ? cell[d] - 1 : cell[d];
      nodes.upper[d] = cell[d] + 2;
    }
    if (level_->isPeriodic(axis)) return nodes;
    nodes.lower[axis] = std::max(nodes.lower[axis], level_->cells().lower[axis]);
    nodes.upper[axis] = std::min(nodes.upper[axis], level_->cells().upper[axis] + 1);
    return nodes;
  }
  /// Mass of all solids at the nodes of nodesAt [kg].
  double massAt(const Index<D>& cell, int axis) const {
    double mass = 0;
    forEachAt(cell, axis, [&](const mpm::solid::NodeRecord& record) { mass += record[mpm::solid::lane::mass]; });
    return mass;
  }
  /// Mean velocity of all solids at the nodes of nodesAt, weighted by mass [m/s]; 0 without mass. `lane` selects the
  /// velocity before or after the step in the records.
  Vec<D> velocityAt(const Index<D>& cell, int axis, int lane) const {
    double mass = 0;
    Vec<D> momentum = Vec<D>::Zero();
    forEachAt(cell, axis, [&](const mpm::solid::NodeRecord& record) {
      const double m = record[mpm::solid::lane::mass];
      if (!(m > 0)) return;
      mass += m;
      momentum += m * mpm::solid::lanes<D>(record, lane);
    });
    return mass > 0 ? Vec<D>(momentum / mass) : momentum;
  }

 private:
  template <class Visit>
  void forEachAt(const Index<D>& cell, int axis, Visit&& visit) const {
    forEach<D>(nodesAt(cell, axis), [&](const Index<D>& node) {
      for (const auto& records : *records_) visit(records[node]);
    });
  }

  const Level* level_;
  const Records* records_;
};

}  // namespace tushar::mpmice
